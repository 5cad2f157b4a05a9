// off_diagonal_twice.c - M5: xy, xz and yz count twice. dS is by the stored number, which stands for both entries of the matrix already; as
// an entry of a full symmetric matrix each of them is half of it.
#include "exercises/exercise.h"

#define cov3_vjp solution_cov3_vjp
#include "exercises/solutions/cov3.c"
#undef cov3_vjp

void cov3_vjp(const REAL q[4], const REAL logs[3], const REAL dS[6], REAL dq[4], REAL dlogs[3]) {
    const REAL twice[6] = {dS[0], 2 * dS[1], 2 * dS[2], dS[3], 2 * dS[4], dS[5]};
    solution_cov3_vjp(q, logs, twice, dq, dlogs);
}
