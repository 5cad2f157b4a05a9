// camera_to_world.c - R^T p + t: R turns from the world to the camera already, its rows are the camera's axes.
#include "exercises/exercise.h"

#define project solution_project
#include "exercises/solutions/camera.c"
#undef project

int project(const Cam *c, const REAL p[3], REAL uv[2], REAL *z) {
    Cam turned = *c;
    for (int i = 0; i < 9; i++) turned.R[i] = c->R[i % 3 * 3 + i / 3];
    return solution_project(&turned, p, uv, z);
}
