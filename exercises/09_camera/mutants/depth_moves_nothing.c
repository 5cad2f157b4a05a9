// depth_moves_nothing.c - the third column of J is missing: a point off the axis that comes nearer moves outwards, by -f x / z^2 for each unit
// of z.
#include "exercises/exercise.h"

#define project_jac solution_project_jac
#include "exercises/solutions/camera.c"
#undef project_jac

void project_jac(const Cam *c, const REAL t[3], REAL J[6]) {
    solution_project_jac(c, t, J);
    J[2] = J[5] = 0;
}
