// ewa_error.c - E11: what EWA gets wrong, measured by drawing points. The task: README.md beside this file.
#include "exercises/exercise.h"

// Draws n points from the Gaussian of mean mu and covariance S3 = { xx, xy, xz, yy, yz, zz } (both in the world), cut at 3
// standard deviations; projects each of them; mean: of the pixels, px; cov = { xx, xy, yy }: theirs over n, divided by
// 0.917820. draw_normals(seed, i, z) gives three normal numbers for i = 0, 1, 2, ...; those outside of the cut are skipped.
void mc_project(const Cam *c, const REAL mu[3], const REAL S3[6], int n, unsigned long seed, REAL mean[2],
                REAL cov[3]) {
    NOT_STARTED; // delete this line, and write mean and cov
    (void)c, (void)mu, (void)S3, (void)n, (void)seed, (void)mean, (void)cov;
}

// How far `mean` lies from `centre` in standard deviations of S2, and |cov - S2| / |S2| (root of the sum of all four squares).
void ewa_error(const REAL mean[2], const REAL cov[3], const REAL centre[2], const REAL S2[3], REAL *shift,
               REAL *relative) {
    NOT_STARTED; // delete this line, and write *shift and *relative
    (void)mean, (void)cov, (void)centre, (void)S2, (void)shift, (void)relative;
}
