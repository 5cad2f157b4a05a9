#include "splat2d/volume_ray.h"

#include "lab/base/rng.h"
#include "tests/support/support.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdio.h>

enum { SEEDS = 40, WORKSPACE = 1000, SEGMENTS = 4096 };

static VolumeRay random_ray(uint32_t seed) {
    Rng rng = rng_at(seed, RNG_TEST, 0, 0);
    VolumeRay ray = {.near = rng_range(&rng, 0.5, 2), .count = (int)rng_below(&rng, VOLUME_BUMPS_MAX + 1)};
    ray.far = ray.near + rng_range(&rng, 1, 6);
    for (int i = 0; i < ray.count; i++) {
        VolumeBump *b = &ray.bumps[i];
        double length = ray.far - ray.near;
        b->centre = rng_range(&rng, ray.near - 0.1 * length, ray.far + 0.1 * length);
        b->width = rng_range(&rng, 0.03, 0.4) * length;
        b->density = rng_range(&rng, 0, 10) / b->width;
        for (int c = 0; c < 3; c++) b->rgb[c] = rng_uniform(&rng);
    }
    return ray;
}

typedef struct {
    const VolumeRay *ray;
    int channel; // -1: density alone
} Asked;

static double density_or_light(double t, void *context) {
    const Asked *asked = context;
    double rgb[3], sigma = volume_ray_at(asked->ray, t, rgb);
    return asked->channel < 0 ? sigma : sigma * rgb[asked->channel] * volume_ray_transmittance(asked->ray, t);
}

static double gsl_integral(const VolumeRay *ray, int channel, double to) {
    Asked asked = {ray, channel};
    gsl_function f = {.function = density_or_light, .params = &asked};
    gsl_integration_workspace *space = gsl_integration_workspace_alloc(WORKSPACE);
    double value, error;
    gsl_integration_qag(&f, ray->near, to, 1e-13, 1e-12, WORKSPACE, GSL_INTEG_GAUSS31, space, &value, &error);
    gsl_integration_workspace_free(space);
    return value;
}

static void integral_and_transmittance_are_gsls(void **state) {
    (void)state;
    gsl_set_error_handler_off(); // 1e-13 may be below the rounding of the integrand; the value is compared below
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        VolumeRay ray = random_ray(seed);
        char name[32];
        snprintf(name, sizeof name, "seed %u", seed);
        double rgb[3], transmittance = volume_ray_integral(&ray, rgb);
        support_near(transmittance, exp(-gsl_integral(&ray, -1, ray.far)), 1e-11, name);
        for (int c = 0; c < 3; c++) support_near(rgb[c], gsl_integral(&ray, c, ray.far), 1e-11, name);
    }
}

// What is not transmitted was seen: with one colour, C = (1 - T) c.
static void light_of_one_colour_is_what_is_not_transmitted(void **state) {
    (void)state;
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        VolumeRay ray = random_ray(seed);
        for (int i = 0; i < ray.count; i++) ray.bumps[i].rgb[0] = 0.7;
        double rgb[3], transmittance = volume_ray_integral(&ray, rgb);
        support_near(rgb[0], 0.7 * (1 - transmittance), 1e-11, "integral");
        for (int rule = 0; rule < VOLUME_RULE_COUNT; rule++) {
            transmittance = volume_ray_quadrature(&ray, (VolumeRule)rule, 13, rgb, NULL);
            support_near(rgb[0], 0.7 * (1 - transmittance), 1e-13, "quadrature");
        }
    }
}

static void weights_and_what_is_left_are_one(void **state) {
    (void)state;
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        VolumeRay ray = random_ray(seed);
        double rgb[3], weights[SEGMENTS], sum = 0, left = 0;
        for (int rule = 0; rule < VOLUME_RULE_COUNT; rule++, sum = 0) {
            left = volume_ray_quadrature(&ray, (VolumeRule)rule, SEGMENTS, rgb, weights);
            for (int i = 0; i < SEGMENTS; i++) sum += weights[i];
            support_near(sum + left, 1, 1e-13, "weights + T");
        }
        left = volume_ray_quadrature(&ray, VOLUME_EXPONENTIAL, SEGMENTS, rgb, NULL);
        support_near(left, volume_ray_transmittance(&ray, ray.far), 1e-6, "T");
    }
}

static double error_of(const VolumeRay *ray, VolumeRule rule, int n) {
    double rgb[3], truth[3], sum = 0;
    volume_ray_integral(ray, truth);
    volume_ray_quadrature(ray, rule, n, rgb, NULL);
    for (int c = 0; c < 3; c++) sum += (rgb[c] - truth[c]) * (rgb[c] - truth[c]);
    return sqrt(sum);
}

static double mean_order(VolumeRule rule) {
    double sum = 0;
    int count = 0;
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        VolumeRay ray = random_ray(seed);
        if (ray.count == 0) continue;
        sum += log2(error_of(&ray, rule, 512) / error_of(&ray, rule, 1024));
        count++;
    }
    return sum / count;
}

static void twice_the_samples_leave_a_quarter_of_the_error_or_a_half_by_the_linear_rule(void **state) {
    (void)state;
    support_near(mean_order(VOLUME_EXPONENTIAL), 2, 0.05, "mean order of 1 - exp(-sigma delta)");
    support_near(mean_order(VOLUME_LINEAR), 1, 0.05, "mean order of sigma delta");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(integral_and_transmittance_are_gsls),
        cmocka_unit_test(light_of_one_colour_is_what_is_not_transmitted),
        cmocka_unit_test(weights_and_what_is_left_are_one),
        cmocka_unit_test(twice_the_samples_leave_a_quarter_of_the_error_or_a_half_by_the_linear_rule),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
