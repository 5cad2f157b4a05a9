// diagonal_not_exchanged.c - xx and yy stay where they are: in the inverse they change places, as the long axis of S is
// the short one of K.
#define conic_from_cov2 solution_conic_from_cov2
#include "exercises/solutions/conic.c"
#undef conic_from_cov2

int conic_from_cov2(const REAL S[3], REAL K[3]) {
    REAL det = S[0] * S[2] - S[1] * S[1];
    if (!(det > 0)) return 0;
    K[0] = S[0] / det;
    K[1] = -S[1] / det;
    K[2] = S[2] / det;
    return 1;
}
