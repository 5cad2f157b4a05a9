// 09_by_the_world_point.c - J R: the derivative by the point in the world, not in the camera.
#include "exercises/exercise.h"

#define project_jac solution_project_jac
#include "exercises/solutions/camera.c"
#undef project_jac

void project_jac(const Cam *c, const REAL t[3], REAL J[6]) {
    REAL j[6];
    solution_project_jac(c, t, j);
    for (int i = 0; i < 6; i++)
        J[i] = j[i / 3 * 3] * c->R[i % 3] + j[i / 3 * 3 + 1] * c->R[3 + i % 3] + j[i / 3 * 3 + 2] * c->R[6 + i % 3];
}
