// length_forgotten.c - the length of the piece is left out of alpha: the cloud gets thicker the finer it is cut.
#include "exercises/06_nerf/field.h"

REAL alpha_from_sigma(REAL sigma, REAL delta) {
    (void)delta;
    return -expm1(-sigma);
}

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
