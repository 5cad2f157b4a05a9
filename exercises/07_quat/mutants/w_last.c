// w_last.c - q is read as x y z w: here the first of the four numbers is w. Both orders are in use; a reader must know which.
#include "exercises/exercise.h"

#define quat_to_R     solution_quat_to_R
#define quat_to_R_vjp solution_quat_to_R_vjp
#include "exercises/solutions/quat.c"
#undef quat_to_R
#undef quat_to_R_vjp

void quat_to_R(const REAL q[4], REAL R[9]) {
    const REAL wxyz[4] = {q[3], q[0], q[1], q[2]};
    solution_quat_to_R(wxyz, R);
}

void quat_to_R_vjp(const REAL q[4], const REAL dR[9], REAL dq[4]) {
    const REAL wxyz[4] = {q[3], q[0], q[1], q[2]};
    REAL d[4];
    solution_quat_to_R_vjp(wxyz, dR, d);
    dq[0] = d[1], dq[1] = d[2], dq[2] = d[3], dq[3] = d[0];
}
