// scale_is_variance.c - the scales stand in S as they are, not squared: a scale is a standard deviation, and a variance is its
// square.
#include "exercises/exercise.h"

void cov2_from_rs(REAL theta, REAL sx, REAL sy, REAL S[3]) {
    REAL c = cos(theta), s = sin(theta);
    S[0] = c * c * sx + s * s * sy;
    S[1] = c * s * (sx - sy);
    S[2] = s * s * sx + c * c * sy;
}
