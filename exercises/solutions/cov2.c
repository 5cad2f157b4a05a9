// cov2.c - E01, our solution.
#include "exercises/exercise.h"

// With R = [[c, -s], [s, c]] the product R diag(x2, y2) R^T, written out.
void cov2_from_rs(REAL theta, REAL sx, REAL sy, REAL S[3]) {
    REAL c = cos(theta), s = sin(theta);
    REAL x2 = sx * sx, y2 = sy * sy;
    S[0] = c * c * x2 + s * s * y2;
    S[1] = c * s * (x2 - y2);
    S[2] = s * s * x2 + c * c * y2;
}
