// nerf.c - E06: a ray through a cloud, with the sum of E04. The task: README.md beside this file.
#include "exercises/06_nerf/field.h"

// How much of what lies behind does a piece of length delta and density sigma hide? 1 - exp(-sigma delta), to the last digits
// also where it is tiny. sigma, delta >= 0.
REAL alpha_from_sigma(REAL sigma, REAL delta) {
    NOT_STARTED; // delete this line, and return alpha
    (void)sigma, (void)delta;
    return 0;
}

// The density that gives a piece of length delta > 0 that alpha, 0 <= a < 1.
REAL sigma_from_alpha(REAL a, REAL delta) {
    NOT_STARTED; // delete this line, and return sigma
    (void)a, (void)delta;
    return 0;
}

// The colour of the ray from f->near to f->far on black: n >= 1 equal pieces, each with what field_at() says of its middle,
// composited front to back. (No cap, no skip, no stop.)
void render_quadrature(const Field *f, int n, REAL out[3]) {
    NOT_STARTED; // delete this line, and write out[0], out[1], out[2]
    (void)f, (void)n, (void)out;
}
