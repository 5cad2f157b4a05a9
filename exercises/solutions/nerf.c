// nerf.c - E06, our solution.
#include "exercises/06_nerf/field.h"

// 1 - exp(-x) loses the digits of a small x when it rounds exp(-x) beside 1; expm1(x) = exp(x) - 1 never forms that 1.
REAL alpha_from_sigma(REAL sigma, REAL delta) { return -expm1(-sigma * delta); }

// log1p(x) = log(1 + x), for the same reason.
REAL sigma_from_alpha(REAL a, REAL delta) { return -log1p(-a) / delta; }

void render_quadrature(const Field *f, int n, REAL out[3]) {
    REAL delta = (f->far - f->near) / n, T = 1;
    for (int c = 0; c < 3; c++) out[c] = 0;
    for (int i = 0; i < n; i++) {
        REAL sigma, rgb[3];
        field_at(f, f->near + (i + (REAL)0.5) * delta, &sigma, rgb);
        REAL alpha = alpha_from_sigma(sigma, delta);
        for (int c = 0; c < 3; c++) out[c] += T * alpha * rgb[c];
        T *= 1 - alpha;
    }
}
