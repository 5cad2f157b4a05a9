// only_the_diagonal_once.c - in the gradient by x, y and z the diagonal of R counts once: it holds squares, 1 - 2 (y^2 + z^2), whose
// derivative is -4 y, not -2 y.
#include "exercises/exercise.h"

#define quat_to_R_vjp solution_quat_to_R_vjp
#include "exercises/solutions/quat.c"
#undef quat_to_R_vjp

void quat_to_R_vjp(const REAL q[4], const REAL dR[9], REAL dq[4]) {
    REAL unit[4], d_unit[4], along = 0, length = unit_of(q, unit);
    REAL x = unit[1], y = unit[2], z = unit[3];
    unit_vjp(unit, dR, d_unit);
    d_unit[1] += 2 * x * (dR[4] + dR[8]);
    d_unit[2] += 2 * y * (dR[0] + dR[8]);
    d_unit[3] += 2 * z * (dR[0] + dR[4]);
    for (int k = 0; k < 4; k++) along += unit[k] * d_unit[k];
    for (int k = 0; k < 4; k++) dq[k] = (d_unit[k] - along * unit[k]) / length;
}
