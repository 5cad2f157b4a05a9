// 04_one_256th.c - the faintest step of an 8-bit picture taken for 1/256.
#include "exercises/exercise.h"
int composite(const Hit *h, int n, REAL Tmin, const REAL bg[3], REAL out[3], REAL *Tend) {
    REAL T = 1;
    int i = 0;
    for (int c = 0; c < 3; c++) out[c] = 0;
    for (; i < n && T >= Tmin; i++) {
        REAL a = fmin(h[i].alpha, (REAL)0.99);
        if (a < (REAL)1 / 256) continue;
        for (int c = 0; c < 3; c++) out[c] += T * a * h[i].rgb[c];
        T *= 1 - a;
    }
    for (int c = 0; c < 3; c++) out[c] += T * bg[c];
    *Tend = T;
    return i;
}
