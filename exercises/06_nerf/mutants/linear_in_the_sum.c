// linear_in_the_sum.c - the sum takes sigma delta for alpha: it comes near the truth as 1/n, in place of 1/n^2, and a
// dense piece gives back more light than there is.
#include "exercises/06_nerf/field.h"

REAL alpha_from_sigma(REAL sigma, REAL delta) { return -expm1(-sigma * delta); }

REAL sigma_from_alpha(REAL a, REAL delta) { return -log1p(-a) / delta; }

void render_quadrature(const Field *f, int n, REAL out[3]) {
    REAL delta = (f->far - f->near) / n, T = 1;
    for (int c = 0; c < 3; c++) out[c] = 0;
    for (int i = 0; i < n; i++) {
        REAL sigma, rgb[3];
        field_at(f, f->near + (i + (REAL)0.5) * delta, &sigma, rgb);
        REAL alpha = sigma * delta;
        for (int c = 0; c < 3; c++) out[c] += T * alpha * rgb[c];
        T *= 1 - alpha;
    }
}
