// 09_sign_of_depth.c - the third column has the other sign, as if z pointed back.
#include "exercises/exercise.h"

#define project_jac solution_project_jac
#include "exercises/solutions/camera.c"
#undef project_jac

void project_jac(const Cam *c, const REAL t[3], REAL J[6]) {
    solution_project_jac(c, t, J);
    J[2] = -J[2], J[5] = -J[5];
}
