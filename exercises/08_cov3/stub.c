// cov3.c - E08: the covariance of a blob in space from seven free numbers, and its gradient. The task: README.md beside this
// file.
#include "exercises/exercise.h"
#include "exercises/solutions/quat.c" // quat_to_R() and quat_to_R_vjp() of E07: ours, so that you need not wait for yours

// S = R diag(s^2) R^T with R = R(q / |q|) and s = exp(logs), stored as S = { xx, xy, xz, yy, yz, zz }.
// q = w x y z, of any length > 0. logs: natural logarithms of the standard deviations along the blob's own axes, any numbers.
void cov3(const REAL q[4], const REAL logs[3], REAL S[6]) {
    NOT_STARTED; // delete this line, and write S[0] .. S[5]
    (void)q, (void)logs, (void)S;
}

// dS[i] is the derivative of some number L by the stored S[i]: xy, xz and yz stand for two entries of the matrix each, and are
// varied once. Writes dq and dlogs, the derivatives of L by q and by logs.
void cov3_vjp(const REAL q[4], const REAL logs[3], const REAL dS[6], REAL dq[4], REAL dlogs[3]) {
    NOT_STARTED; // delete this line, and write dq[0] .. dq[3] and dlogs[0] .. dlogs[2]
    (void)q, (void)logs, (void)dS, (void)dq, (void)dlogs;
}
