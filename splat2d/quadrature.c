// quadrature.c - sums over the segments of a ray, in plain double precision.
#include "splat2d/quadrature.h"

#include "splat2d/compositing.h"

#include <math.h>

double quadrature_alpha(double sigma, double delta) { return -expm1(-sigma * delta); }
double quadrature_sigma(double alpha, double delta) { return -log1p(-alpha) / delta; }

float quadrature_alpha_float(float sigma, float delta) { return -expm1f(-sigma * delta); }
float quadrature_alpha_float_naive(float sigma, float delta) { return 1 - expf(-sigma * delta); }

// ---- the fog ----

// sigma = density (1 + 0.9 sin(2 pi (t - 1/4))): thin at both ends, thick in the middle; its integral over [0, 1] is density.
static const double SWING = 0.9;

double fog_sigma(const Fog *fog, double t) { return fog->density * (1 + SWING * sin(2 * M_PI * (t - 0.25))); }

double fog_transmittance(const Fog *fog, double t) {
    double bump = SWING / (2 * M_PI) * (cos(2 * M_PI * 0.25) - cos(2 * M_PI * (t - 0.25)));
    return exp(-fog->density * (t + bump));
}

void fog_rgb(double t, double rgb[3]) {
    for (int c = 0; c < 3; c++) rgb[c] = 0.5 + 0.45 * cos(M_PI * (1.2 * t - 0.4 * c));
}

double quadrature_render(const Fog *fog, QuadratureRule rule, int n, double rgb[3], double *weights) {
    const CompositeRule whole = {.alpha_max = 1, .alpha_min = 0, .stop = 0, .rule = STOP_AFTER_BLEND};
    Composite pixel = composite_begin();
    double delta = 1.0 / n;
    for (int i = 0; i < n; i++) {
        double t = (i + 0.5) * delta, sigma = fog_sigma(fog, t), colour[3];
        double alpha = rule == QUADRATURE_LINEAR ? fmin(1, sigma * delta) : quadrature_alpha(sigma, delta);
        fog_rgb(t, colour);
        double weight = composite_blend(&pixel, &whole, alpha, colour);
        if (weights) weights[i] = weight;
    }
    for (int c = 0; c < 3; c++) rgb[c] = pixel.rgb[c];
    return pixel.transmittance;
}

// ---- a splat as a fog ----

double splat_fog_gap(double opacity, double g) { return -expm1(g * log1p(-opacity)) - opacity * g; }

// The gap is concave in g and 0 at both ends. Its derivative -ln(1 - o) (1 - o)^g - o vanishes at one place.
double splat_fog_gap_largest(double opacity, double *g) {
    double depth = -log1p(-opacity);
    *g = opacity > 0 ? log(depth / opacity) / depth : 0.5;
    return splat_fog_gap(opacity, *g);
}
