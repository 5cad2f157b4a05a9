// no_bias_correction.cl - the moments begin at zero and are too small in the first steps: m is divided by 1 - b1^t and v by 1 - b2^t.

kernel void adam(int n, global REAL *p, global const REAL *g, global REAL *m, global REAL *v, REAL lr, REAL b1, REAL b2,
                 REAL eps, int t) {
    int i = get_global_id(0);
    if (i >= n) return;
    m[i] = b1 * m[i] + (1 - b1) * g[i];
    v[i] = b2 * v[i] + (1 - b2) * g[i] * g[i];
    REAL mean = m[i], square = v[i];
    p[i] -= lr * mean / (sqrt(square) + eps);
}
