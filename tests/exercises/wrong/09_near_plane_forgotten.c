// 09_near_plane_forgotten.c - everything with z > 0 is seen.
#include "exercises/exercise.h"

#define project solution_project
#include "exercises/solutions/camera.c"
#undef project

int project(const Cam *c, const REAL p[3], REAL uv[2], REAL *z) {
    int seen = solution_project(c, p, uv, z);
    if (seen || !(*z > 0)) return seen;
    REAL x = c->R[0] * p[0] + c->R[1] * p[1] + c->R[2] * p[2] + c->t[0];
    REAL y = c->R[3] * p[0] + c->R[4] * p[1] + c->R[5] * p[2] + c->t[1];
    uv[0] = c->fx * x / *z + c->cx;
    uv[1] = c->fy * y / *z + c->cy;
    return 1;
}
