// flat_accepted.c - a matrix whose determinant is not above zero is inverted all the same: a blob without area gives
// infinities, and one outside the cone grows without bound.
#define conic_from_cov2 solution_conic_from_cov2
#include "exercises/solutions/conic.c"
#undef conic_from_cov2

int conic_from_cov2(const REAL S[3], REAL K[3]) {
    REAL det = S[0] * S[2] - S[1] * S[1];
    K[0] = S[2] / det;
    K[1] = -S[1] / det;
    K[2] = S[0] / det;
    return 1;
}
