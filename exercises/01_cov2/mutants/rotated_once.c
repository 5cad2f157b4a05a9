// rotated_once.c - R diag without the R^T behind it: a matrix has to be turned from both sides, as both of its indices are
// directions.
#include "exercises/exercise.h"

void cov2_from_rs(REAL theta, REAL sx, REAL sy, REAL S[3]) {
    REAL c = cos(theta), s = sin(theta);
    S[0] = c * sx * sx;
    S[1] = -s * sy * sy;
    S[2] = c * sy * sy;
}
