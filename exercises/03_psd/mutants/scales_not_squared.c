// scales_not_squared.c - R diag(s) R^T has the scales where it needs their squares: a covariance has the unit of an
// area.
#define cov3_from_factors solution_cov3_from_factors
#include "exercises/solutions/psd.c"
#undef cov3_from_factors

void cov3_from_factors(const REAL R[9], const REAL logs[3], REAL S[6]) {
    REAL A[9];
    for (int i = 0; i < 9; i++) A[i] = R[i] * exp(logs[i % 3] / 2);
    for (int i = 0, at = 0; i < 3; i++)
        for (int j = i; j < 3; j++)
            S[at++] = A[3 * i] * A[3 * j] + A[3 * i + 1] * A[3 * j + 1] + A[3 * i + 2] * A[3 * j + 2];
}
