// 09_centre_of_picture.c - the principal point is taken to be the middle of the picture.
#include "exercises/exercise.h"

#define project solution_project
#include "exercises/solutions/camera.c"
#undef project

int project(const Cam *c, const REAL p[3], REAL uv[2], REAL *z) {
    Cam centred = *c;
    centred.cx = c->width / 2, centred.cy = c->height / 2;
    return solution_project(&centred, p, uv, z);
}
