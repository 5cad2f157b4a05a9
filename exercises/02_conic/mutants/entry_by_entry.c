// entry_by_entry.c - each number is inverted by itself, as if the ellipse were never turned: the inverse of a matrix is
// not the matrix of inverses.
#define conic_from_cov2 solution_conic_from_cov2
#include "exercises/solutions/conic.c"
#undef conic_from_cov2

int conic_from_cov2(const REAL S[3], REAL K[3]) {
    if (!(S[0] * S[2] - S[1] * S[1] > 0)) return 0;
    K[0] = 1 / S[0];
    K[1] = 0;
    K[2] = 1 / S[2];
    return 1;
}
