// cov2.c - E01: the covariance of a blob from its angle and two scales. The task: README.md beside this file.
#include "exercises/exercise.h"

// Sigma = R(theta) diag(sx^2, sy^2) R(theta)^T, stored as S = { xx, xy, yy }.
// theta: rad, from +x towards +y, any value. sx, sy: standard deviations along the blob's own axes, px, >= 0.
void cov2_from_rs(REAL theta, REAL sx, REAL sy, REAL S[3]) {
    NOT_STARTED; // delete this line, and write S[0], S[1], S[2]
    (void)theta, (void)sx, (void)sy, (void)S;
}
