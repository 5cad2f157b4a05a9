// corner_for_centre.c - pixels are taken at their corners: the centre of pixel (i, j) is (i + 0.5, j + 0.5).
#define grad_raw solution_grad_raw
#include "exercises/solutions/psd.c"
#undef grad_raw

void grad_raw(const REAL S[3], const Img *e, REAL g[3]) {
    REAL det = S[0] * S[2] - S[1] * S[1], K[3] = {S[2] / det, -S[1] / det, S[0] / det};
    g[0] = g[1] = g[2] = 0;
    for (int j = 0; j < e->height; j++)
        for (int i = 0; i < e->width; i++) {
            REAL dx = i - (REAL)e->width / 2, dy = j - (REAL)e->height / 2;
            REAL ux = K[0] * dx + K[1] * dy, uy = K[1] * dx + K[2] * dy;
            REAL half = e->values[j * e->width + i] * exp(-(ux * dx + uy * dy) / 2) / 2;
            g[0] += half * ux * ux;
            g[1] += half * ux * uy * 2;
            g[2] += half * uy * uy;
        }
}
