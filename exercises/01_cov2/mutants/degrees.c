// degrees.c - the angle is taken for degrees: it comes in radians.
#include "exercises/exercise.h"

void cov2_from_rs(REAL theta, REAL sx, REAL sy, REAL S[3]) {
    REAL radians = theta * (REAL)M_PI / 180;
    REAL c = cos(radians), s = sin(radians);
    REAL x2 = sx * sx, y2 = sy * sy;
    S[0] = c * c * x2 + s * s * y2;
    S[1] = c * s * (x2 - y2);
    S[2] = s * s * x2 + c * c * y2;
}
