// 09_clamped.c - J is taken at a point clamped to 1.3 times the picture's half angle, as splatting does later.
#include "exercises/exercise.h"

#define project_jac solution_project_jac
#include "exercises/solutions/camera.c"
#undef project_jac

void project_jac(const Cam *c, const REAL t[3], REAL J[6]) {
    REAL x_max = (REAL)1.3 * c->width / (2 * c->fx) * t[2], y_max = (REAL)1.3 * c->height / (2 * c->fy) * t[2];
    const REAL near_by[3] = {fmin(fmax(t[0], -x_max), x_max), fmin(fmax(t[1], -y_max), y_max), t[2]};
    solution_project_jac(c, near_by, J);
}
