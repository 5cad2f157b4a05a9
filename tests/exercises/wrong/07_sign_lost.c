// 07_sign_lost.c - q with w < 0 is replaced by -q, which is right for R, but its gradient is not turned back.
#include "exercises/exercise.h"

#define quat_to_R_vjp solution_quat_to_R_vjp
#include "exercises/solutions/quat.c"
#undef quat_to_R_vjp

void quat_to_R_vjp(const REAL q[4], const REAL dR[9], REAL dq[4]) {
    REAL sign = q[0] < 0 ? -1 : 1;
    const REAL positive[4] = {sign * q[0], sign * q[1], sign * q[2], sign * q[3]};
    solution_quat_to_R_vjp(positive, dR, dq);
}
