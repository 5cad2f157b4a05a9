// quat.c - E07: a rotation from four free numbers, and its gradient. The task: README.md beside this file.
#include "exercises/exercise.h"

// R = R(q / |q|), row-major: R[3 * row + column]. q = w x y z, of any length > 0.
void quat_to_R(const REAL q[4], REAL R[9]) {
    NOT_STARTED; // delete this line, and write R[0] .. R[8]
    (void)q, (void)R;
}

// dR[i] is the derivative of some number L by R[i]. Writes dq[k], the derivative of L by q[k], for q as it is stored: of any
// length, not normalised.
void quat_to_R_vjp(const REAL q[4], const REAL dR[9], REAL dq[4]) {
    NOT_STARTED; // delete this line, and write dq[0] .. dq[3]
    (void)q, (void)dR, (void)dq;
}
