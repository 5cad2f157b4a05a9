// one_focal_length.c - fx is used for v as well: pixels need not be square.
#include "exercises/exercise.h"

#define project solution_project
#include "exercises/solutions/camera.c"
#undef project

int project(const Cam *c, const REAL p[3], REAL uv[2], REAL *z) {
    int seen = solution_project(c, p, uv, z);
    if (seen) uv[1] = (uv[1] - c->cy) * c->fx / c->fy + c->cy;
    return seen;
}
