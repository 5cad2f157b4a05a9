// 08_full_matrices.c - R diag(s^2) R^T as it stands, and its gradient with the full symmetric dS, halves on the off-diagonals.
#include "exercises/exercise.h"
#include "exercises/solutions/quat.c"

void cov3(const REAL q[4], const REAL logs[3], REAL S[6]) {
    REAL R[9];
    int n = 0;
    quat_to_R(q, R);
    for (int i = 0; i < 3; i++)
        for (int j = i; j < 3; j++, n++) {
            S[n] = 0;
            for (int k = 0; k < 3; k++) S[n] += R[3 * i + k] * exp(2 * logs[k]) * R[3 * j + k];
        }
}

void cov3_vjp(const REAL q[4], const REAL logs[3], const REAL dS[6], REAL dq[4], REAL dlogs[3]) {
    const REAL G[9] = {dS[0], dS[1] / 2, dS[2] / 2, dS[1] / 2, dS[3], dS[4] / 2, dS[2] / 2, dS[4] / 2, dS[5]};
    REAL R[9], dR[9];
    quat_to_R(q, R);
    for (int k = 0; k < 3; k++) {
        REAL square = exp(2 * logs[k]);
        dlogs[k] = 0;
        for (int i = 0; i < 3; i++) {
            REAL g = G[3 * i] * R[k] + G[3 * i + 1] * R[3 + k] + G[3 * i + 2] * R[6 + k];
            dR[3 * i + k] = 2 * g * square;
            dlogs[k] += 2 * square * R[3 * i + k] * g;
        }
    }
    quat_to_R_vjp(q, dR, dq);
}
