// entry_for_stored.c - M5: the derivative by xy is that of one of the two off-diagonal entries: the stored number
// stands for both, so it moves both, and its derivative is twice as large.
#define grad_raw solution_grad_raw
#include "exercises/solutions/psd.c"
#undef grad_raw

void grad_raw(const REAL S[3], const Img *e, REAL g[3]) {
    REAL det = S[0] * S[2] - S[1] * S[1], K[3] = {S[2] / det, -S[1] / det, S[0] / det};
    g[0] = g[1] = g[2] = 0;
    for (int j = 0; j < e->height; j++)
        for (int i = 0; i < e->width; i++) {
            REAL dx = i + (REAL)0.5 - (REAL)e->width / 2, dy = j + (REAL)0.5 - (REAL)e->height / 2;
            REAL ux = K[0] * dx + K[1] * dy, uy = K[1] * dx + K[2] * dy;
            REAL half = e->values[j * e->width + i] * exp(-(ux * dx + uy * dy) / 2) / 2;
            g[0] += half * ux * ux;
            g[1] += half * ux * uy;
            g[2] += half * uy * uy;
        }
}
