// off_diagonal_half.c - M5: xy, xz and yz count half. They were halved for the full symmetric matrix, and then only one of its two entries
// was used.
#include "exercises/exercise.h"

#define cov3_vjp solution_cov3_vjp
#include "exercises/solutions/cov3.c"
#undef cov3_vjp

void cov3_vjp(const REAL q[4], const REAL logs[3], const REAL dS[6], REAL dq[4], REAL dlogs[3]) {
    const REAL half[6] = {dS[0], dS[1] / 2, dS[2] / 2, dS[3], dS[4] / 2, dS[5]};
    solution_cov3_vjp(q, logs, half, dq, dlogs);
}
