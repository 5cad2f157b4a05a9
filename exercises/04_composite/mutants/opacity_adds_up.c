// opacity_adds_up.c - opacities are added until they reach 1: a splat covers its share of what is still visible, not of
// the whole, so what is left is multiplied.
#include "exercises/exercise.h"

int composite(const Hit *h, int n, REAL Tmin, const REAL bg[3], REAL out[3], REAL *Tend) {
    const REAL ALPHA_MAX = (REAL)0.99, ALPHA_MIN = (REAL)1 / 255;
    REAL T = 1;
    int i = 0;
    for (int c = 0; c < 3; c++) out[c] = 0;
    for (; i < n && T >= Tmin; i++) {
        if (h[i].alpha < ALPHA_MIN) continue;
        REAL alpha = h[i].alpha < ALPHA_MAX ? h[i].alpha : ALPHA_MAX;
        for (int c = 0; c < 3; c++) out[c] += (alpha < T ? alpha : T) * h[i].rgb[c];
        T = alpha < T ? T - alpha : 0;
    }
    for (int c = 0; c < 3; c++) out[c] += T * bg[c];
    *Tend = T;
    return i;
}
