// small_is_flat.c - small determinants are refused by a fixed threshold: a blob of a hundredth of a pixel is a blob,
// its determinant is 1e-8.
#define conic_from_cov2 solution_conic_from_cov2
#include "exercises/solutions/conic.c"
#undef conic_from_cov2

int conic_from_cov2(const REAL S[3], REAL K[3]) {
    REAL det = S[0] * S[2] - S[1] * S[1];
    if (!(det > (REAL)1e-6)) return 0;
    K[0] = S[2] / det;
    K[1] = -S[1] / det;
    K[2] = S[0] / det;
    return 1;
}
