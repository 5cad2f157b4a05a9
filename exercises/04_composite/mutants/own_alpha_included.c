// own_alpha_included.c - M2: the product includes the splat's own alpha: T must be what lies in front of it, taken
// before it is multiplied by 1 - alpha.
#include "exercises/exercise.h"

int composite(const Hit *h, int n, REAL Tmin, const REAL bg[3], REAL out[3], REAL *Tend) {
    const REAL ALPHA_MAX = (REAL)0.99, ALPHA_MIN = (REAL)1 / 255;
    REAL T = 1;
    int i = 0;
    for (int c = 0; c < 3; c++) out[c] = 0;
    for (; i < n && T >= Tmin; i++) {
        if (h[i].alpha < ALPHA_MIN) continue;
        REAL alpha = h[i].alpha < ALPHA_MAX ? h[i].alpha : ALPHA_MAX;
        T *= 1 - alpha;
        for (int c = 0; c < 3; c++) out[c] += T * alpha * h[i].rgb[c];
    }
    for (int c = 0; c < 3; c++) out[c] += T * bg[c];
    *Tend = T;
    return i;
}
