// race_with_neighbour.cl - each work-item writes the number of its neighbour, which the neighbour reads and writes at the same time.

kernel void adam(int n, global REAL *p, global const REAL *g, global REAL *m, global REAL *v, REAL lr, REAL b1, REAL b2,
                 REAL eps, int t) {
    int i = get_global_id(0);
    if (i >= n) return;
    m[i] = b1 * m[i] + (1 - b1) * g[i];
    v[i] = b2 * v[i] + (1 - b2) * g[i] * g[i];
    REAL mean = m[i] / (1 - pown(b1, t)), square = v[i] / (1 - pown(b2, t));
    int k = i + 1 < n ? i + 1 : i;
    p[k] = p[i] - lr * mean / (sqrt(square) + eps);
}
