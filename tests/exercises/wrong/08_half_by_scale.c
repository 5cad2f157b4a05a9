// 08_half_by_scale.c - d exp(2 logs) is taken to be exp(2 logs): dlogs is half of what it should be, and dq is right.
#include "exercises/exercise.h"

#define cov3_vjp solution_cov3_vjp
#include "exercises/solutions/cov3.c"
#undef cov3_vjp

void cov3_vjp(const REAL q[4], const REAL logs[3], const REAL dS[6], REAL dq[4], REAL dlogs[3]) {
    solution_cov3_vjp(q, logs, dS, dq, dlogs);
    for (int k = 0; k < 3; k++) dlogs[k] /= 2;
}
