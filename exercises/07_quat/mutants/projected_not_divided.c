// projected_not_divided.c - the part along q is taken out, but the rest is not divided by |q|: a long q turns less by the same step, so its
// gradient is smaller.
#include "exercises/exercise.h"

#define quat_to_R_vjp solution_quat_to_R_vjp
#include "exercises/solutions/quat.c"
#undef quat_to_R_vjp

void quat_to_R_vjp(const REAL q[4], const REAL dR[9], REAL dq[4]) {
    REAL unit[4], d_unit[4], along = 0;
    unit_of(q, unit);
    unit_vjp(unit, dR, d_unit);
    for (int k = 0; k < 4; k++) along += unit[k] * d_unit[k];
    for (int k = 0; k < 4; k++) dq[k] = d_unit[k] - along * unit[k];
}
