// 08_forgets_the_scale.c - dR is taken for dM: the scales between them are forgotten.
#include "exercises/exercise.h"

#define cov3_vjp solution_cov3_vjp
#include "exercises/solutions/cov3.c"
#undef cov3_vjp

void cov3_vjp(const REAL q[4], const REAL logs[3], const REAL dS[6], REAL dq[4], REAL dlogs[3]) {
    REAL s[3], M[9], dM[9] = {0};
    solution_cov3_vjp(q, logs, dS, dq, dlogs);
    stretched(q, logs, s, M);
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 3; k++) {
            dM[3 * ROW[i] + k] += dS[i] * M[3 * COLUMN[i] + k];
            dM[3 * COLUMN[i] + k] += dS[i] * M[3 * ROW[i] + k];
        }
    quat_to_R_vjp(q, dM, dq);
}
