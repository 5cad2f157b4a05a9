// no_low_pass.c - M8: the 0.3 px^2 on the diagonal are missing: a splat thinner than a pixel then falls between the pixel
// centres, and spokes and leaves vanish.
#define cov2_project solution_cov2_project
#include "exercises/solutions/ewa.c"
#undef cov2_project

void cov2_project(const Cam *c, const REAL t[3], const REAL S3[6], REAL S2[3]) {
    solution_cov2_project(c, t, S3, S2);
    S2[0] -= (REAL)0.3;
    S2[2] -= (REAL)0.3;
}
