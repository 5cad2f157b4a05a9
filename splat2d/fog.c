// fog.c - exponentials that keep the digits of small alphas.
#include "splat2d/fog.h"

#include <math.h>

double fog_alpha(double sigma, double delta) { return -expm1(-sigma * delta); }
double fog_sigma(double alpha, double delta) { return -log1p(-alpha) / delta; }

float fog_alpha_float(float sigma, float delta) { return -expm1f(-sigma * delta); }
float fog_alpha_float_naive(float sigma, float delta) { return 1 - expf(-sigma * delta); }

double splat_fog_gap(double opacity, double g) { return -expm1(g * log1p(-opacity)) - opacity * g; }

// The gap is concave in g and 0 at both ends. Its derivative -ln(1 - o) (1 - o)^g - o vanishes at one place.
double splat_fog_gap_largest(double opacity, double *g) {
    double depth = -log1p(-opacity);
    *g = opacity > 0 ? log(depth / opacity) / depth : 0.5;
    return splat_fog_gap(opacity, *g);
}
