// 09_by_one_over_z.c - one division, sums in another order, and J from the ratios x/z and y/z.
#include "exercises/exercise.h"

int project(const Cam *c, const REAL p[3], REAL uv[2], REAL *z) {
    const REAL *R = c->R;
    REAL x = c->t[0] + (R[0] * p[0] + (R[1] * p[1] + R[2] * p[2]));
    REAL y = c->t[1] + (R[3] * p[0] + (R[4] * p[1] + R[5] * p[2]));
    *z = c->t[2] + (R[6] * p[0] + (R[7] * p[1] + R[8] * p[2]));
    if (*z < (REAL)0.2) {
        uv[0] = uv[1] = 0;
        return 0;
    }
    REAL inverse = 1 / *z;
    uv[0] = c->cx + x * inverse * c->fx;
    uv[1] = c->cy + y * inverse * c->fy;
    return 1;
}

void project_jac(const Cam *c, const REAL t[3], REAL J[6]) {
    REAL inverse = 1 / t[2], u = t[0] * inverse, v = t[1] * inverse;
    J[0] = c->fx * inverse, J[1] = 0, J[2] = -J[0] * u;
    J[3] = 0, J[4] = c->fy * inverse, J[5] = -J[4] * v;
}
