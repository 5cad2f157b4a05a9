// camera.c - E09, our solution.
#include "exercises/exercise.h"

#define NEAR_DEPTH ((REAL)0.2) // world units

// The division comes after the question whether there is anything to divide by.
int project(const Cam *c, const REAL p[3], REAL uv[2], REAL *z) {
    REAL t[3];
    for (int i = 0; i < 3; i++) t[i] = c->R[3 * i] * p[0] + c->R[3 * i + 1] * p[1] + c->R[3 * i + 2] * p[2] + c->t[i];
    uv[0] = uv[1] = 0;
    *z = t[2];
    if (!(t[2] >= NEAR_DEPTH)) return 0;
    uv[0] = c->fx * t[0] / t[2] + c->cx;
    uv[1] = c->fy * t[1] / t[2] + c->cy;
    return 1;
}

// u = fx x / z + cx: by x it is fx / z, by y nothing, by z -fx x / z^2.
void project_jac(const Cam *c, const REAL t[3], REAL J[6]) {
    REAL x = t[0], y = t[1], z = t[2];
    J[0] = c->fx / z, J[1] = 0, J[2] = -c->fx * x / (z * z);
    J[3] = 0, J[4] = c->fy / z, J[5] = -c->fy * y / (z * z);
}
