// third_row.c - M10: a third row is written: a pixel has two coordinates, so J has two rows. Where code keeps a 3x3 matrix, its third row of
// zeros is no error: depth is no part of the picture.
#include "exercises/exercise.h"

#define project_jac solution_project_jac
#include "exercises/solutions/camera.c"
#undef project_jac

void project_jac(const Cam *c, const REAL t[3], REAL J[6]) {
    solution_project_jac(c, t, J);
    J[6] = J[7] = 0, J[8] = 1;
}
