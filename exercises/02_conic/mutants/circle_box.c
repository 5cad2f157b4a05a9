// circle_box.c - the box is that of a circle with the long axis as its radius: safe, but a streak gets many times the
// pixels that it needs.
#define aabb_ksigma solution_aabb_ksigma
#include "exercises/solutions/conic.c"
#undef aabb_ksigma

void aabb_ksigma(const REAL S[3], REAL k, REAL half[2]) {
    REAL mean = (S[0] + S[2]) / 2, off = (S[0] - S[2]) / 2;
    half[0] = half[1] = k * sqrt(mean + sqrt(off * off + S[1] * S[1]));
}
