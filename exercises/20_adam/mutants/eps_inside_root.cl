// eps_inside_root.cl - eps stands beside the root, not in it: sqrt(v + eps) is another, much larger floor than sqrt(v) + eps.

kernel void adam(int n, global REAL *p, global const REAL *g, global REAL *m, global REAL *v, REAL lr, REAL b1, REAL b2,
                 REAL eps, int t) {
    int i = get_global_id(0);
    if (i >= n) return;
    m[i] = b1 * m[i] + (1 - b1) * g[i];
    v[i] = b2 * v[i] + (1 - b2) * g[i] * g[i];
    REAL mean = m[i] / (1 - pown(b1, t)), square = v[i] / (1 - pown(b2, t));
    p[i] -= lr * mean / sqrt(square + eps);
}
