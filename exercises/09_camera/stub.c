// camera.c - E09: from a point in the world to a place in the picture, and how the place moves with the point. The task:
// README.md beside this file.
#include "exercises/exercise.h"

#define NEAR_DEPTH ((REAL)0.2) // world units; what is nearer is not drawn

// Where the world point p falls: uv = u, v in px, and *z, its depth along the camera's axis in world units.
// Returns 1 when z >= NEAR_DEPTH. Otherwise returns 0 with uv = 0, 0: such a point has no place in the picture. *z is written in
// both cases, and of finite numbers no output is ever NaN or infinite.
int project(const Cam *c, const REAL p[3], REAL uv[2], REAL *z) {
    NOT_STARTED; // delete this line, and write uv[0], uv[1] and *z
    (void)c, (void)p, (void)uv, (void)z;
    return 0;
}

// J, two rows by three columns, row-major: du/dx du/dy du/dz dv/dx dv/dy dv/dz, px per world unit, for a point t = x, y, z in
// camera axes with z >= NEAR_DEPTH. (t is R p + c->t of a point p; not to be taken for c->t itself.)
void project_jac(const Cam *c, const REAL t[3], REAL J[6]) {
    NOT_STARTED; // delete this line, and write J[0] .. J[5]
    (void)c, (void)t, (void)J;
}
