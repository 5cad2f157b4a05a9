// quat.c - E07, our solution.
#include "exercises/exercise.h"

// unit = q / |q|; returns |q|.
static REAL unit_of(const REAL q[4], REAL unit[4]) {
    REAL length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int k = 0; k < 4; k++) unit[k] = q[k] / length;
    return length;
}

void quat_to_R(const REAL q[4], REAL R[9]) {
    REAL unit[4];
    unit_of(q, unit);
    REAL w = unit[0], x = unit[1], y = unit[2], z = unit[3];
    R[0] = 1 - 2 * (y * y + z * z), R[1] = 2 * (x * y - w * z), R[2] = 2 * (x * z + w * y);
    R[3] = 2 * (x * y + w * z), R[4] = 1 - 2 * (x * x + z * z), R[5] = 2 * (y * z - w * x);
    R[6] = 2 * (x * z - w * y), R[7] = 2 * (y * z + w * x), R[8] = 1 - 2 * (x * x + y * y);
}

// By the unit quaternion: each entry of R above, differentiated by w, x, y, z and weighted with its dR.
static void unit_vjp(const REAL unit[4], const REAL dR[9], REAL d_unit[4]) {
    REAL w = unit[0], x = unit[1], y = unit[2], z = unit[3];
    d_unit[0] = 2 * (x * (dR[7] - dR[5]) + y * (dR[2] - dR[6]) + z * (dR[3] - dR[1]));
    d_unit[1] = 2 * (w * (dR[7] - dR[5]) + y * (dR[1] + dR[3]) + z * (dR[2] + dR[6]) - 2 * x * (dR[4] + dR[8]));
    d_unit[2] = 2 * (w * (dR[2] - dR[6]) + x * (dR[1] + dR[3]) + z * (dR[5] + dR[7]) - 2 * y * (dR[0] + dR[8]));
    d_unit[3] = 2 * (w * (dR[3] - dR[1]) + x * (dR[2] + dR[6]) + y * (dR[5] + dR[7]) - 2 * z * (dR[0] + dR[4]));
}

// Then through q -> q / |q|: what points along q is taken out, the rest is divided by |q|.
void quat_to_R_vjp(const REAL q[4], const REAL dR[9], REAL dq[4]) {
    REAL unit[4], d_unit[4], along = 0;
    REAL length = unit_of(q, unit);
    unit_vjp(unit, dR, d_unit);
    for (int k = 0; k < 4; k++) along += unit[k] * d_unit[k];
    for (int k = 0; k < 4; k++) dq[k] = (d_unit[k] - along * unit[k]) / length;
}
