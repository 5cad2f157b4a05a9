// conic_cross_term_half.c - M4: the derivative of m^2 by the stored K_xy is 2 dx dy; here it is dx dy. All three
// numbers are off by a part that vanishes on the axes, so weak tests pass; a second factor of 2 elsewhere would hide
// it.
#define grad_raw solution_grad_raw
#include "exercises/solutions/psd.c"
#undef grad_raw

void grad_raw(const REAL S[3], const Img *e, REAL g[3]) {
    REAL det = S[0] * S[2] - S[1] * S[1], a = S[2] / det, b = -S[1] / det, c = S[0] / det, dK[3] = {0, 0, 0};
    for (int j = 0; j < e->height; j++)
        for (int i = 0; i < e->width; i++) {
            REAL dx = i + (REAL)0.5 - (REAL)e->width / 2, dy = j + (REAL)0.5 - (REAL)e->height / 2;
            REAL m2 = a * dx * dx + 2 * b * dx * dy + c * dy * dy;
            REAL d = -e->values[j * e->width + i] * exp(-m2 / 2) / 2;
            dK[0] += d * dx * dx;
            dK[1] += d * dx * dy;
            dK[2] += d * dy * dy;
        }
    g[0] = -(a * a * dK[0] + a * b * dK[1] + b * b * dK[2]);
    g[1] = -(2 * a * b * dK[0] + (a * c + b * b) * dK[1] + 2 * b * c * dK[2]);
    g[2] = -(b * b * dK[0] + b * c * dK[1] + c * c * dK[2]);
}
