// turned_backwards.c - R^T diag R in place of R diag R^T: the blob turns the other way, which shows in the sign of xy alone.
#include "exercises/exercise.h"

void cov2_from_rs(REAL theta, REAL sx, REAL sy, REAL S[3]) {
    REAL c = cos(theta), s = sin(theta);
    REAL x2 = sx * sx, y2 = sy * sy;
    S[0] = c * c * x2 + s * s * y2;
    S[1] = -c * s * (x2 - y2);
    S[2] = s * s * x2 + c * c * y2;
}
