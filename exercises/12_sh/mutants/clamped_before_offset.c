// clamped_before_offset.c - the sum is clamped at 0 before 0.5 is added: then no splat can be darker than middle grey. What is
// clamped is the finished colour.
#define sh_color solution_sh_color
#include "exercises/solutions/sh.c"
#undef sh_color

void sh_color(int deg, const REAL d[3], const REAL (*k)[3], REAL rgb[3], int clamped[3]) {
    REAL r = length_of(d);
    Basis b = basis(deg, d[0] / r, d[1] / r, d[2] / r);
    for (int c = 0; c < 3; c++) {
        REAL sum = 0;
        for (int i = 0; i < (deg + 1) * (deg + 1); i++) sum += b.Y[i] * k[i][c];
        clamped[c] = sum < 0;
        rgb[c] = (clamped[c] ? 0 : sum) + (REAL)0.5;
    }
}
