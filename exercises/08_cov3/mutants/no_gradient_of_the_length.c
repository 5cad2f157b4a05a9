// no_gradient_of_the_length.c - M3: the step q -> q / |q| has no gradient: dq has a part along q, which makes q longer and turns nothing.
#include "exercises/exercise.h"

#define cov3_vjp solution_cov3_vjp
#include "exercises/solutions/cov3.c"
#undef cov3_vjp

void cov3_vjp(const REAL q[4], const REAL logs[3], const REAL dS[6], REAL dq[4], REAL dlogs[3]) {
    REAL s[3], M[9], dR[9] = {0}, unit[4];
    solution_cov3_vjp(q, logs, dS, dq, dlogs);
    stretched(q, logs, s, M);
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 3; k++) {
            dR[3 * ROW[i] + k] += dS[i] * M[3 * COLUMN[i] + k] * s[k];
            dR[3 * COLUMN[i] + k] += dS[i] * M[3 * ROW[i] + k] * s[k];
        }
    unit_of(q, unit);
    unit_vjp(unit, dR, dq);
}
