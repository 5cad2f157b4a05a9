// 07_column_gradient.c - R is right, but dR is read column by column.
#include "exercises/exercise.h"

#define quat_to_R_vjp solution_quat_to_R_vjp
#include "exercises/solutions/quat.c"
#undef quat_to_R_vjp

void quat_to_R_vjp(const REAL q[4], const REAL dR[9], REAL dq[4]) {
    REAL T[9];
    for (int i = 0; i < 9; i++) T[i] = dR[i % 3 * 3 + i / 3];
    solution_quat_to_R_vjp(q, T, dq);
}
