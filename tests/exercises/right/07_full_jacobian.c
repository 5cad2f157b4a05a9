// 07_full_jacobian.c - the diagonal as w^2 + x^2 - y^2 - z^2, and the 4x4 Jacobian of the normalisation written out.
#include "exercises/exercise.h"

static void unit_of(const REAL q[4], REAL u[4], REAL *inverse) {
    *inverse = 1 / sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int k = 0; k < 4; k++) u[k] = q[k] * *inverse;
}

void quat_to_R(const REAL q[4], REAL R[9]) {
    REAL u[4], inverse;
    unit_of(q, u, &inverse);
    REAL w = u[0], x = u[1], y = u[2], z = u[3];
    R[0] = w * w + x * x - y * y - z * z, R[1] = 2 * x * y - 2 * w * z, R[2] = 2 * x * z + 2 * w * y;
    R[3] = 2 * x * y + 2 * w * z, R[4] = w * w - x * x + y * y - z * z, R[5] = 2 * y * z - 2 * w * x;
    R[6] = 2 * x * z - 2 * w * y, R[7] = 2 * y * z + 2 * w * x, R[8] = w * w - x * x - y * y + z * z;
}

void quat_to_R_vjp(const REAL q[4], const REAL d[9], REAL dq[4]) {
    REAL u[4], inverse;
    unit_of(q, u, &inverse);
    REAL w = u[0], x = u[1], y = u[2], z = u[3];
    const REAL g[4] = {
        2 * (w * d[0] - z * d[1] + y * d[2] + z * d[3] + w * d[4] - x * d[5] - y * d[6] + x * d[7] + w * d[8]),
        2 * (x * d[0] + y * d[1] + z * d[2] + y * d[3] - x * d[4] - w * d[5] + z * d[6] + w * d[7] - x * d[8]),
        2 * (-y * d[0] + x * d[1] + w * d[2] + x * d[3] + y * d[4] + z * d[5] - w * d[6] + z * d[7] - y * d[8]),
        2 * (-z * d[0] - w * d[1] + x * d[2] + w * d[3] - z * d[4] + y * d[5] + x * d[6] + y * d[7] + z * d[8])};
    for (int a = 0; a < 4; a++) {
        dq[a] = 0;
        for (int b = 0; b < 4; b++) dq[a] += ((a == b) - u[a] * u[b]) * inverse * g[b];
    }
}
