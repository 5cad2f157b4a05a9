// ewa.c - E10: the ellipse that a Gaussian makes on the screen (EWA projection). The task: README.md beside this file.
#include "exercises/exercise.h"

// S2 = J W S3 W^T J^T + 0.3 px^2 on the diagonal, stored as S2 = { xx, xy, yy }.
// t: the mean in camera axes, t[2] > 0. S3: covariance in the world, { xx, xy, xz, yy, yz, zz }. W is c->R.
// J: derivative of (fx x/z + cx, fy y/z + cy) by (x, y, z), with x/z and y/z clamped: see README.md.
void cov2_project(const Cam *c, const REAL t[3], const REAL S3[6], REAL S2[3]) {
    NOT_STARTED; // delete this line, and write S2[0], S2[1], S2[2]
    (void)c, (void)t, (void)S3, (void)S2;
}

// The gradient by t of a loss whose gradient by the three stored numbers of S2 is dS2: the mean moves the shape, too.
void cov2_project_vjp(const Cam *c, const REAL t[3], const REAL S3[6], const REAL dS2[3], REAL dt[3]) {
    NOT_STARTED; // delete this line, and write dt[0], dt[1], dt[2]
    (void)c, (void)t, (void)S3, (void)dS2, (void)dt;
}
