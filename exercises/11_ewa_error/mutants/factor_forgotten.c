// factor_forgotten.c - the covariance of the cut draws stands there as it came: what is cut at 3 standard deviations has only
// 0.9178 of the variance; divide by it before you compare.
#define mc_project solution_mc_project
#include "exercises/solutions/ewa_error.c"
#undef mc_project

void mc_project(const Cam *c, const REAL mu[3], const REAL S3[6], int n, unsigned long seed, REAL mean[2],
                REAL cov[3]) {
    solution_mc_project(c, mu, S3, n, seed, mean, cov);
    for (int k = 0; k < 3; k++) cov[k] *= (REAL)CUT_FACTOR;
}
