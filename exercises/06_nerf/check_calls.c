// check_calls.c - how the functions of E06 are called: a Field is 20 numbers in a row.
#include "exercises/06_nerf/field.h"
#include "exercises/calls.h"

_Static_assert(sizeof(Field) == 20 * sizeof(REAL), "a field comes as an array of numbers");

REAL alpha_from_sigma(REAL sigma, REAL delta);
REAL sigma_from_alpha(REAL a, REAL delta);
void render_quadrature(const Field *f, int n, REAL out[3]);

static void call_alpha_from_sigma(REAL **a) { a[2][0] = alpha_from_sigma(a[0][0], a[1][0]); }
static void call_sigma_from_alpha(REAL **a) { a[2][0] = sigma_from_alpha(a[0][0], a[1][0]); }
static void call_render_quadrature(REAL **a) { render_quadrature((const Field *)a[0], (int)a[1][0], a[2]); }

const Call CALLS[] = {{"alpha_from_sigma", call_alpha_from_sigma},
                      {"sigma_from_alpha", call_sigma_from_alpha},
                      {"render_quadrature", call_render_quadrature},
                      {0}};
