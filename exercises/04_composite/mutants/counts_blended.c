// counts_blended.c - the returned count leaves out what was skipped: a skipped hit was looked at, and its place in the
// list is what the count says.
#include "exercises/exercise.h"

int composite(const Hit *h, int n, REAL Tmin, const REAL bg[3], REAL out[3], REAL *Tend) {
    const REAL ALPHA_MAX = (REAL)0.99, ALPHA_MIN = (REAL)1 / 255;
    REAL T = 1;
    int i = 0, blended = 0;
    for (int c = 0; c < 3; c++) out[c] = 0;
    for (; i < n && T >= Tmin; i++) {
        if (h[i].alpha < ALPHA_MIN) continue;
        REAL alpha = h[i].alpha < ALPHA_MAX ? h[i].alpha : ALPHA_MAX;
        for (int c = 0; c < 3; c++) out[c] += T * alpha * h[i].rgb[c];
        T *= 1 - alpha;
        blended++;
    }
    for (int c = 0; c < 3; c++) out[c] += T * bg[c];
    *Tend = T;
    return blended;
}
