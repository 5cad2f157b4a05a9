// cov3.c - E08, our solution.
#include "exercises/exercise.h"
#include "exercises/solutions/quat.c"

// Row and column of each stored number.
static const int ROW[6] = {0, 0, 0, 1, 1, 2}, COLUMN[6] = {0, 1, 2, 1, 2, 2};

// M = R diag(s): what becomes of a unit ball's axes.
static void stretched(const REAL q[4], const REAL logs[3], REAL s[3], REAL M[9]) {
    quat_to_R(q, M);
    for (int k = 0; k < 3; k++) s[k] = exp(logs[k]);
    for (int i = 0; i < 9; i++) M[i] *= s[i % 3];
}

// S = M M^T: each number is the product of two rows of M.
void cov3(const REAL q[4], const REAL logs[3], REAL S[6]) {
    REAL s[3], M[9];
    stretched(q, logs, s, M);
    for (int i = 0; i < 6; i++) {
        const REAL *row = M + 3 * ROW[i], *column = M + 3 * COLUMN[i];
        S[i] = row[0] * column[0] + row[1] * column[1] + row[2] * column[2];
    }
}

// A stored number is a product of two rows, so it moves each of them by the other; on the diagonal both are the same row.
void cov3_vjp(const REAL q[4], const REAL logs[3], const REAL dS[6], REAL dq[4], REAL dlogs[3]) {
    REAL s[3], M[9], dM[9] = {0}, dR[9];
    stretched(q, logs, s, M);
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 3; k++) {
            dM[3 * ROW[i] + k] += dS[i] * M[3 * COLUMN[i] + k];
            dM[3 * COLUMN[i] + k] += dS[i] * M[3 * ROW[i] + k];
        }
    for (int i = 0; i < 9; i++) dR[i] = dM[i] * s[i % 3];
    for (int k = 0; k < 3; k++) dlogs[k] = dM[k] * M[k] + dM[3 + k] * M[3 + k] + dM[6 + k] * M[6 + k];
    quat_to_R_vjp(q, dR, dq);
}
