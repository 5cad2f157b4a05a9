// camera_translation.c - M7: J is taken at c->t, the camera's translation: it belongs to the point, t = R p + c->t, and is another one for each
// splat.
#include "exercises/exercise.h"

#define project_jac solution_project_jac
#include "exercises/solutions/camera.c"
#undef project_jac

void project_jac(const Cam *c, const REAL t[3], REAL J[6]) {
    (void)t;
    solution_project_jac(c, c->t, J);
}
