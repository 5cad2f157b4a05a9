// adam.cl - E20: one step of Adam. The task: README.md beside this file. REAL is float or double.

// One work-item: one of the n numbers p, with its gradient g and its two moments m and v, which this step updates.
// lr: step size. b1, b2: how much of the old moments stays. eps: keeps the division finite. t: number of this step, 1 is the first.
kernel void adam(int n, global REAL *p, global const REAL *g, global REAL *m, global REAL *v, REAL lr, REAL b1, REAL b2,
                 REAL eps, int t) {
    NOT_STARTED; // delete this line, and write m[i], v[i] and p[i]
}
