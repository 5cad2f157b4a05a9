// half_of_the_product.c - M4: a factor of 2 is missing. S = M M^T holds M twice, and each side has its part in the gradient: with the full
// symmetric dS it is dM = 2 dS M.
#include "exercises/exercise.h"

#define cov3_vjp solution_cov3_vjp
#include "exercises/solutions/cov3.c"
#undef cov3_vjp

void cov3_vjp(const REAL q[4], const REAL logs[3], const REAL dS[6], REAL dq[4], REAL dlogs[3]) {
    REAL half[6];
    for (int i = 0; i < 6; i++) half[i] = dS[i] / 2;
    solution_cov3_vjp(q, logs, half, dq, dlogs);
}
