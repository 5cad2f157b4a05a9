// off_diagonal_halved.c - M5: the gradient by the off-diagonal number is taken for that of one matrix entry, and shared over
// two: dS2[1] is by the stored number, which stands for both.
#define cov2_project_vjp solution_cov2_project_vjp
#include "exercises/solutions/ewa.c"
#undef cov2_project_vjp

void cov2_project_vjp(const Cam *c, const REAL t[3], const REAL S3[6], const REAL dS2[3], REAL dt[3]) {
    const REAL shared[3] = {dS2[0], dS2[1] / 2, dS2[2]};
    solution_cov2_project_vjp(c, t, S3, shared, dt);
}
