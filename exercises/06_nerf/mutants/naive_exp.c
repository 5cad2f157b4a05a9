// naive_exp.c - 1 - exp(-x) is written as it stands: for a small x the 1 swallows its digits. expm1 computes exp(x) - 1
// without ever forming that 1.
#include "exercises/06_nerf/field.h"

REAL alpha_from_sigma(REAL sigma, REAL delta) { return 1 - exp(-sigma * delta); }

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
