// no_skip.c - faint hits are blended: an alpha below 1/255 is skipped, as if the splat were not there.
#include "exercises/exercise.h"

int composite(const Hit *h, int n, REAL Tmin, const REAL bg[3], REAL out[3], REAL *Tend) {
    const REAL ALPHA_MAX = (REAL)0.99;
    REAL T = 1;
    int i = 0;
    for (int c = 0; c < 3; c++) out[c] = 0;
    for (; i < n && T >= Tmin; i++) {
        REAL alpha = h[i].alpha < ALPHA_MAX ? h[i].alpha : ALPHA_MAX;
        for (int c = 0; c < 3; c++) out[c] += T * alpha * h[i].rgb[c];
        T *= 1 - alpha;
    }
    for (int c = 0; c < 3; c++) out[c] += T * bg[c];
    *Tend = T;
    return i;
}
