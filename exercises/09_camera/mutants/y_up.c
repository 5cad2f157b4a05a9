// y_up.c - y points up, as in OpenGL: here the camera's axes are x right, y down, z forward, and row 0 is the top one.
#include "exercises/exercise.h"

#define project solution_project
#include "exercises/solutions/camera.c"
#undef project

int project(const Cam *c, const REAL p[3], REAL uv[2], REAL *z) {
    int seen = solution_project(c, p, uv, z);
    if (seen) uv[1] = 2 * c->cy - uv[1];
    return seen;
}
