// symmetric_is_enough.c - A = R diag(s) is made symmetric, (A + A^T) / 2, in place of squared, A A^T: symmetric is not
// enough, its eigenvalues may have any sign.
#define cov3_from_factors solution_cov3_from_factors
#include "exercises/solutions/psd.c"
#undef cov3_from_factors

void cov3_from_factors(const REAL R[9], const REAL logs[3], REAL S[6]) {
    REAL A[9];
    for (int i = 0; i < 9; i++) A[i] = R[i] * exp(logs[i % 3]);
    for (int i = 0, at = 0; i < 3; i++)
        for (int j = i; j < 3; j++) S[at++] = (A[3 * i + j] + A[3 * j + i]) / 2;
}
