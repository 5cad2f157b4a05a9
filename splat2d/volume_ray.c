// volume_ray.c - the integral by adaptive Simpson, the sum by composite_blend().
#include "splat2d/volume_ray.h"

#include "splat2d/compositing.h"
#include "splat2d/fog.h"

#include <math.h>

static double bump_at(const VolumeBump *b, double t) {
    double x = (t - b->centre) / b->width;
    return b->density * exp(-x * x / 2);
}

double volume_ray_at(const VolumeRay *ray, double t, double rgb[3]) {
    double sigma = 0, sum[3] = {0};
    for (int i = 0; i < ray->count; i++) {
        double s = bump_at(&ray->bumps[i], t);
        sigma += s;
        for (int c = 0; c < 3; c++) sum[c] += s * ray->bumps[i].rgb[c];
    }
    for (int c = 0; c < 3; c++) rgb[c] = sigma > 0 ? sum[c] / sigma : 0;
    return sigma;
}

// The integral of exp(-x^2 / 2) is sqrt(pi / 2) erf(x / sqrt(2)).
double volume_ray_transmittance(const VolumeRay *ray, double t) {
    double depth = 0;
    for (int i = 0; i < ray->count; i++) {
        const VolumeBump *b = &ray->bumps[i];
        double to = (t - b->centre) / b->width, from = (ray->near - b->centre) / b->width;
        depth += b->density * b->width * sqrt(M_PI / 2) * (erf(to * M_SQRT1_2) - erf(from * M_SQRT1_2));
    }
    return exp(-depth);
}

// ---- the integral ----

typedef struct {
    double rgb[3];
} Colour;

static Colour integrand(const VolumeRay *ray, double t) {
    Colour c;
    double weight = volume_ray_at(ray, t, c.rgb) * volume_ray_transmittance(ray, t);
    for (int i = 0; i < 3; i++) c.rgb[i] *= weight;
    return c;
}

// [from, to] with its middle, and Simpson's rule on it.
typedef struct {
    double from, to;
    Colour at_from, at_middle, at_to, sum;
} Panel;

static Panel panel_of(const VolumeRay *ray, double from, double to, Colour at_from, Colour at_to) {
    Panel p = {.from = from, .to = to, .at_from = at_from, .at_to = at_to};
    p.at_middle = integrand(ray, (from + to) / 2);
    for (int i = 0; i < 3; i++)
        p.sum.rgb[i] = (to - from) / 6 * (at_from.rgb[i] + 4 * p.at_middle.rgb[i] + at_to.rgb[i]);
    return p;
}

// The difference between one panel and its two halves is 15 times the halves' error (Lyness 1969).
static void add_panel(const VolumeRay *ray, const Panel *p, double tolerance, int depth, double sum[3]) {
    double middle = (p->from + p->to) / 2, off = 0;
    Panel left = panel_of(ray, p->from, middle, p->at_from, p->at_middle),
          right = panel_of(ray, middle, p->to, p->at_middle, p->at_to);
    for (int i = 0; i < 3; i++) off = fmax(off, fabs(left.sum.rgb[i] + right.sum.rgb[i] - p->sum.rgb[i]));
    if (off <= 15 * tolerance || depth == 0) {
        for (int i = 0; i < 3; i++) {
            double halves = left.sum.rgb[i] + right.sum.rgb[i];
            sum[i] += halves + (halves - p->sum.rgb[i]) / 15;
        }
        return;
    }
    add_panel(ray, &left, tolerance / 2, depth - 1, sum);
    add_panel(ray, &right, tolerance / 2, depth - 1, sum);
}

// First in equal panels, so that no bump is missed between the points of a coarse one.
enum { FIRST_PANELS = 32, HALVINGS_MAX = 20 };
static const double TOLERANCE = 1e-12;

double volume_ray_integral(const VolumeRay *ray, double rgb[3]) {
    double step = (ray->far - ray->near) / FIRST_PANELS;
    for (int c = 0; c < 3; c++) rgb[c] = 0;
    for (int i = 0; i < FIRST_PANELS; i++) {
        double from = ray->near + i * step, to = ray->near + (i + 1) * step;
        Panel panel = panel_of(ray, from, to, integrand(ray, from), integrand(ray, to));
        add_panel(ray, &panel, TOLERANCE / FIRST_PANELS, HALVINGS_MAX, rgb);
    }
    return volume_ray_transmittance(ray, ray->far);
}

// ---- the sum ----

double volume_ray_quadrature(const VolumeRay *ray, VolumeRule rule, int n, double rgb[3], double *weights) {
    const CompositeRule whole = {.alpha_max = 1, .alpha_min = 0, .stop = 0, .rule = STOP_AFTER_BLEND};
    Composite pixel = composite_begin();
    double delta = (ray->far - ray->near) / n;
    for (int i = 0; i < n; i++) {
        double colour[3], sigma = volume_ray_at(ray, ray->near + (i + 0.5) * delta, colour);
        double alpha = rule == VOLUME_LINEAR ? fmin(1, sigma * delta) : fog_alpha(sigma, delta);
        double weight = composite_blend(&pixel, &whole, alpha, colour);
        if (weights) weights[i] = weight;
    }
    for (int c = 0; c < 3; c++) rgb[c] = pixel.rgb[c];
    return pixel.transmittance;
}
