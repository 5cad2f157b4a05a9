// t_from_zero.cl - t is the number of the step and begins at 1; with t - 1 the first correction divides by zero, and later ones lag.

kernel void adam(int n, global REAL *p, global const REAL *g, global REAL *m, global REAL *v, REAL lr, REAL b1, REAL b2,
                 REAL eps, int t) {
    int i = get_global_id(0);
    if (i >= n) return;
    m[i] = b1 * m[i] + (1 - b1) * g[i];
    v[i] = b2 * v[i] + (1 - b2) * g[i] * g[i];
    REAL mean = m[i] / (1 - pown(b1, t - 1)), square = v[i] / (1 - pown(b2, t - 1));
    p[i] -= lr * mean / (sqrt(square) + eps);
}
