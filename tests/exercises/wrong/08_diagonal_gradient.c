// 08_diagonal_gradient.c - the scales' gradient takes the diagonal of dS alone, as if the blob were not turned.
#include "exercises/exercise.h"

#define cov3_vjp solution_cov3_vjp
#include "exercises/solutions/cov3.c"
#undef cov3_vjp

void cov3_vjp(const REAL q[4], const REAL logs[3], const REAL dS[6], REAL dq[4], REAL dlogs[3]) {
    const REAL diagonal[6] = {dS[0], 0, 0, dS[3], 0, dS[5]};
    REAL other[4];
    solution_cov3_vjp(q, logs, dS, dq, dlogs);
    solution_cov3_vjp(q, logs, diagonal, other, dlogs);
}
