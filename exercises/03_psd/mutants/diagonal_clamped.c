// diagonal_clamped.c - the diagonal is clamped to be above zero afterwards: that does not make a matrix positive, xy^2
// may still be larger than xx yy.
#define cov3_from_factors solution_cov3_from_factors
#include "exercises/solutions/psd.c"
#undef cov3_from_factors

void cov3_from_factors(const REAL R[9], const REAL logs[3], REAL S[6]) {
    REAL A[9];
    for (int i = 0; i < 9; i++) A[i] = R[i] * exp(logs[i % 3]);
    for (int i = 0, at = 0; i < 3; i++)
        for (int j = i; j < 3; j++)
            S[at++] = i == j ? fmax(A[3 * i + j], (REAL)1e-6) : (A[3 * i + j] + A[3 * j + i]) / 2;
}
