// psd_trap.c - two descents towards one thin blob.
#include "splat2d/psd_trap.h"

#include "kernels/shared.h"
#include "splat2d/adam.h"

#include <math.h>
#include <string.h>

static const double START_SIGMA = 1.2, TARGET_SIGMA_X = 1.5, TARGET_SIGMA_Y = 0.16, TARGET_THETA = 0.7; // units, rad
static const double RATE = 0.04, OPACITY = 0.95;

// ---- shape ----

Sym2 psd_walk_covariance(const PsdWalk *walk) {
    const double *v = walk->values;
    if (walk->way == PSD_RAW) return (Sym2){v[0], v[1], v[2]};
    return covariance_from_angle(v[0], exp(v[1]), exp(v[2]));
}

// Sigma^-1 also of what is no covariance.
static bool inverse(Sym2 a, Sym2 *conic) {
    double determinant = sym2_determinant(a);
    if (determinant == 0 || !isfinite(determinant)) return false;
    *conic = (Sym2){a.yy / determinant, -a.xy / determinant, a.xx / determinant};
    return true;
}

static double alpha_at(double opacity, Sym2 conic, double dx, double dy) {
    return fmin(ALPHA_MAX, opacity * exp(-conic_mahalanobis2(conic, dx, dy) / 2));
}

double psd_trap_alpha(double opacity, Sym2 covariance, double dx, double dy) {
    Sym2 conic;
    return inverse(covariance, &conic) ? alpha_at(opacity, conic, dx, dy) : 0;
}

void psd_cone_point(Sym2 covariance, double point[3]) {
    point[0] = (covariance.xx - covariance.yy) / 2;
    point[1] = covariance.xy;
    point[2] = (covariance.xx + covariance.yy) / 2;
}

Sym2 psd_cone_covariance(const double point[3]) {
    return (Sym2){.xx = point[2] + point[0], .xy = point[1], .yy = point[2] - point[0]};
}

// ---- loss and gradient ----

// The loss of a conic; d_conic, when not NULL, receives its gradient. From alpha = o exp(-m^2 / 2) follows
//     d alpha / d conic = -alpha / 2 (dx^2, 2 dx dy, dy^2),   and 0 where alpha is clamped.
static double conic_loss(const PsdTrap *trap, Sym2 conic, Sym2 target, Sym2 *d_conic) {
    double sum = 0, pixels = PSD_GRID * PSD_GRID;
    if (d_conic) *d_conic = (Sym2){0};
    for (int j = 0; j < PSD_GRID; j++)
        for (int i = 0; i < PSD_GRID; i++) {
            double dx = PSD_HALF_SIDE * ((2 * i + 1.0) / PSD_GRID - 1),
                   dy = PSD_HALF_SIDE * ((2 * j + 1.0) / PSD_GRID - 1);
            double alpha = alpha_at(trap->opacity, conic, dx, dy);
            double difference = alpha - alpha_at(trap->opacity, target, dx, dy);
            sum += difference * difference;
            if (!d_conic || alpha >= (double)ALPHA_MAX) continue;
            double d = -difference * alpha / pixels; // 2 difference * (-alpha / 2)
            d_conic->xx += d * dx * dx;
            d_conic->xy += 2 * d * dx * dy;
            d_conic->yy += d * dy * dy;
        }
    return sum / pixels;
}

// With c, s of theta and x2, y2 the squared scales: the derivatives of covariance_from_angle().
static void through_factors(const double values[3], Sym2 d_covariance, double gradient[3]) {
    double c = cos(values[0]), s = sin(values[0]), x2 = exp(2 * values[1]), y2 = exp(2 * values[2]);
    Sym2 d = d_covariance;
    gradient[0] = (x2 - y2) * (-2 * c * s * d.xx + (c * c - s * s) * d.xy + 2 * c * s * d.yy);
    gradient[1] = 2 * x2 * (c * c * d.xx + c * s * d.xy + s * s * d.yy);
    gradient[2] = 2 * y2 * (s * s * d.xx - c * s * d.xy + c * c * d.yy);
}

double psd_trap_gradient(const PsdTrap *trap, const PsdWalk *walk, double gradient[3]) {
    Sym2 conic, target, d_conic;
    memset(gradient, 0, 3 * sizeof *gradient);
    if (!inverse(psd_walk_covariance(walk), &conic) || !inverse(trap->target, &target)) return INFINITY;
    double loss = conic_loss(trap, conic, target, &d_conic);
    Sym2 d = covariance_conic_backward(conic, d_conic);
    if (walk->way == PSD_FACTORED)
        through_factors(walk->values, d, gradient);
    else
        gradient[0] = d.xx, gradient[1] = d.xy, gradient[2] = d.yy;
    return loss;
}

double psd_trap_loss(const PsdTrap *trap, const PsdWalk *walk) {
    Sym2 conic, target;
    if (!inverse(psd_walk_covariance(walk), &conic) || !inverse(trap->target, &target)) return INFINITY;
    return conic_loss(trap, conic, target, NULL);
}

// ---- walks ----

static void note_step(const PsdTrap *trap, PsdWalk *walk) {
    walk->path[walk->step] = psd_walk_covariance(walk);
    walk->loss[walk->step] = psd_trap_loss(trap, walk);
}

static void start_from(const PsdTrap *trap, PsdWalk *walk, PsdWay way, const double values[3]) {
    memset(walk, 0, sizeof *walk);
    walk->way = way;
    memcpy(walk->values, values, sizeof walk->values);
    note_step(trap, walk);
}

void psd_trap_restart(PsdTrap *trap) {
    const double raw[3] = {START_SIGMA * START_SIGMA, 0, START_SIGMA * START_SIGMA};
    const double factored[3] = {0, log(START_SIGMA), log(START_SIGMA)};
    start_from(trap, &trap->walks[PSD_RAW], PSD_RAW, raw);
    start_from(trap, &trap->walks[PSD_FACTORED], PSD_FACTORED, factored);
}

void psd_trap_begin(PsdTrap *trap) {
    trap->target = covariance_from_angle(TARGET_THETA, TARGET_SIGMA_X, TARGET_SIGMA_Y);
    trap->learning_rate = RATE;
    trap->opacity = OPACITY;
    psd_trap_restart(trap);
}

static void walk_step(const PsdTrap *trap, PsdWalk *walk) {
    if (walk->step == PSD_PATH_MAX) return;
    double gradient[3];
    AdamRule rule = adam_rule_default(trap->learning_rate);
    psd_trap_gradient(trap, walk, gradient);
    walk->step++;
    bool finite = isfinite(gradient[0]) && isfinite(gradient[1]) && isfinite(gradient[2]);
    if (finite) adam_step(&rule, walk->step, 3, gradient, walk->values, walk->m, walk->v);
    note_step(trap, walk);
}

void psd_trap_step(PsdTrap *trap) {
    for (int way = 0; way < PSD_WAY_COUNT; way++) walk_step(trap, &trap->walks[way]);
}

void psd_trap_set(PsdTrap *trap, PsdWay way, const double values[3]) {
    const double kept[3] = {values[0], values[1], values[2]}; // they may stand in the walk itself
    start_from(trap, &trap->walks[way], way, kept);
}
