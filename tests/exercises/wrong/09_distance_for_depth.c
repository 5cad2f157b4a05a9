// 09_distance_for_depth.c - z is the distance to the camera, and not the depth along its axis.
#include "exercises/exercise.h"

#define project solution_project
#include "exercises/solutions/camera.c"
#undef project

int project(const Cam *c, const REAL p[3], REAL uv[2], REAL *z) {
    REAL square = 0;
    int seen = solution_project(c, p, uv, z);
    for (int i = 0; i < 3; i++) {
        REAL t = c->R[3 * i] * p[0] + c->R[3 * i + 1] * p[1] + c->R[3 * i + 2] * p[2] + c->t[i];
        square += t * t;
    }
    *z = sqrt(square);
    return seen;
}
