// half_pixel_less.c - 0.5 is taken off, as if pixel centres stood at whole numbers: pixel (i, j) covers i to i + 1, and its centre is i + 0.5,
// so the formula needs no correction.
#include "exercises/exercise.h"

#define project solution_project
#include "exercises/solutions/camera.c"
#undef project

int project(const Cam *c, const REAL p[3], REAL uv[2], REAL *z) {
    int seen = solution_project(c, p, uv, z);
    if (seen) uv[0] -= (REAL)0.5, uv[1] -= (REAL)0.5;
    return seen;
}
