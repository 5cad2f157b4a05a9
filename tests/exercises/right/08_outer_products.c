// 08_outer_products.c - S as the sum of s^2 r r^T over the columns r of R, and each column's gradient on its own.
#include "exercises/exercise.h"
#include "exercises/solutions/quat.c"

void cov3(const REAL q[4], const REAL logs[3], REAL S[6]) {
    REAL R[9];
    quat_to_R(q, R);
    for (int i = 0; i < 6; i++) S[i] = 0;
    for (int k = 0; k < 3; k++) {
        REAL s = exp(logs[k]), x = R[k], y = R[3 + k], z = R[6 + k];
        S[0] += s * s * x * x, S[1] += s * s * x * y, S[2] += s * s * x * z;
        S[3] += s * s * y * y, S[4] += s * s * y * z, S[5] += s * s * z * z;
    }
}

void cov3_vjp(const REAL q[4], const REAL logs[3], const REAL d[6], REAL dq[4], REAL dlogs[3]) {
    REAL R[9], dR[9];
    quat_to_R(q, R);
    for (int k = 0; k < 3; k++) {
        REAL s = exp(logs[k]), v = s * s, x = R[k], y = R[3 + k], z = R[6 + k];
        dlogs[k] = 2 * v * (d[0] * x * x + d[1] * x * y + d[2] * x * z + d[3] * y * y + d[4] * y * z + d[5] * z * z);
        dR[k] = v * (2 * d[0] * x + d[1] * y + d[2] * z);
        dR[3 + k] = v * (d[1] * x + 2 * d[3] * y + d[4] * z);
        dR[6 + k] = v * (d[2] * x + d[4] * y + 2 * d[5] * z);
    }
    quat_to_R_vjp(q, dR, dq);
}
