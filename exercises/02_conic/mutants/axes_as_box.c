// axes_as_box.c - the half axes of the ellipse are taken for the sides: right only while it is not turned.
#define aabb_ksigma solution_aabb_ksigma
#include "exercises/solutions/conic.c"
#undef aabb_ksigma

void aabb_ksigma(const REAL S[3], REAL k, REAL half[2]) {
    REAL mean = (S[0] + S[2]) / 2, off = (S[0] - S[2]) / 2, radius = sqrt(off * off + S[1] * S[1]);
    half[0] = k * sqrt(mean + radius);
    half[1] = k * sqrt(fmax(mean - radius, (REAL)0));
}
