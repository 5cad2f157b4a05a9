// t_as_position.c - R (p - t): t is not where the camera stands, but where the world's origin stands in the camera; R p + t.
#include "exercises/exercise.h"

#define project solution_project
#include "exercises/solutions/camera.c"
#undef project

int project(const Cam *c, const REAL p[3], REAL uv[2], REAL *z) {
    Cam moved = *c;
    for (int i = 0; i < 3; i++)
        moved.t[i] = -(c->R[3 * i] * c->t[0] + c->R[3 * i + 1] * c->t[1] + c->R[3 * i + 2] * c->t[2]);
    return solution_project(&moved, p, uv, z);
}
