// 07_no_root.c - no square root: R - I is of second degree in q, divided by |q|^2; the gradient is that of a product.
#include "exercises/exercise.h"

static REAL square_of(const REAL q[4]) { return q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]; }

void quat_to_R(const REAL q[4], REAL R[9]) {
    REAL w = q[0], x = q[1], y = q[2], z = q[3], s = 2 / square_of(q);
    R[0] = 1 - s * (y * y + z * z), R[1] = s * (x * y - w * z), R[2] = s * (x * z + w * y);
    R[3] = s * (x * y + w * z), R[4] = 1 - s * (x * x + z * z), R[5] = s * (y * z - w * x);
    R[6] = s * (x * z - w * y), R[7] = s * (y * z + w * x), R[8] = 1 - s * (x * x + y * y);
}

void quat_to_R_vjp(const REAL q[4], const REAL dR[9], REAL dq[4]) {
    REAL w = q[0], x = q[1], y = q[2], z = q[3], n = square_of(q), R[9];
    const REAL P[4][9] = {{0, -z, y, z, 0, -x, -y, x, 0},
                          {0, y, z, y, -2 * x, -w, z, w, -2 * x},
                          {-2 * y, x, w, x, 0, z, -w, z, -2 * y},
                          {-2 * z, -w, x, w, -2 * z, y, x, y, 0}};
    quat_to_R(q, R);
    for (int k = 0; k < 4; k++) {
        dq[k] = 0;
        for (int i = 0; i < 9; i++) dq[k] += dR[i] * 2 / n * (P[k][i] - q[k] * (R[i] - (i % 4 == 0)));
    }
}
