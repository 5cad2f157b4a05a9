// 08_scaled_rows.c - M = diag(s) R in place of R diag(s): S then is never turned.
#include "exercises/exercise.h"

#define cov3 solution_cov3
#include "exercises/solutions/cov3.c"
#undef cov3

void cov3(const REAL q[4], const REAL logs[3], REAL S[6]) {
    REAL s[3], R[9];
    quat_to_R(q, R);
    for (int k = 0; k < 3; k++) s[k] = exp(logs[k]);
    for (int i = 0; i < 6; i++) {
        S[i] = 0;
        for (int k = 0; k < 3; k++) S[i] += s[ROW[i]] * R[3 * ROW[i] + k] * R[3 * COLUMN[i] + k] * s[COLUMN[i]];
    }
}
