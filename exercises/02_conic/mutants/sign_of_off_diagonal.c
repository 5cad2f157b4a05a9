// sign_of_off_diagonal.c - xy keeps its sign: in the inverse of a 2x2 matrix the off-diagonal numbers are negated, or
// the ellipse leans the other way.
#define conic_from_cov2 solution_conic_from_cov2
#include "exercises/solutions/conic.c"
#undef conic_from_cov2

int conic_from_cov2(const REAL S[3], REAL K[3]) {
    REAL det = S[0] * S[2] - S[1] * S[1];
    if (!(det > 0)) return 0;
    K[0] = S[2] / det;
    K[1] = S[1] / det;
    K[2] = S[0] / det;
    return 1;
}
