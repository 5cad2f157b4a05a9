// channel_after_channel.c - the coefficients are read as all of red, then green, then blue: here each coefficient is one triple
// r g b. (The files keep them the other way.)
#define sh_color solution_sh_color
#include "exercises/solutions/sh.c"
#undef sh_color

void sh_color(int deg, const REAL d[3], const REAL (*k)[3], REAL rgb[3], int clamped[3]) {
    REAL r = length_of(d);
    Basis b = basis(deg, d[0] / r, d[1] / r, d[2] / r);
    for (int c = 0; c < 3; c++) {
        REAL sum = (REAL)0.5;
        for (int i = 0; i < (deg + 1) * (deg + 1); i++) sum += b.Y[i] * (&k[0][0])[c * (deg + 1) * (deg + 1) + i];
        clamped[c] = sum < 0;
        rgb[c] = clamped[c] ? 0 : sum;
    }
}
