#include "exercises/harness/perspective.h"

#include "exercises/exercise.h"
#include "exercises/harness/camera_case.h"
#include "exercises/harness/cut_draws.h"
#include "tests/support/support.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <gsl/gsl_sort.h>
#include <math.h>

static const Camera CAMERA = {
    .width = 640, .height = 480, .fx = 500, .fy = 430, .cx = 300, .cy = 250, .rotation = {{1, 0, 0, 0, 1, 0, 0, 0, 1}}};

// Sigma = A A^T, with a row of A for each camera axis.
static Sym3 covariance_of(const double a[9]) {
    Mat3 map;
    for (int i = 0; i < 9; i++) map.m[i] = a[i];
    return sym3_turned((Sym3){.xx = 1, .yy = 1, .zz = 1}, &map);
}

static const double SPLAT[9] = {0.4, 0.1, -0.2, 0.05, 0.3, 0.1, 0.15, -0.1, 0.35};
static const Vec3 MEAN = {0.8, -0.5, 2};

static void the_cut_leaves_what_the_chi_square_distributions_say(void **state) {
    (void)state;
    double cut2 = EWA_CUT * EWA_CUT;
    support_near(ewa_cut_factor(EWA_CUT), gsl_cdf_chisq_P(cut2, 5) / gsl_cdf_chisq_P(cut2, 3), 1e-14, "factor");
    support_near(ewa_cut_factor(EWA_CUT), 0.917820, 5e-7, "factor, as the page says");
}

typedef struct {
    double weight, x, y, xx, xy, yy;
} Sums;

static void sum_point(Sums *s, double weight, const double z[3]) {
    double p[3] = {MEAN.x, MEAN.y, MEAN.z};
    for (int i = 0; i < 9; i++) p[i / 3] += SPLAT[i] * z[i % 3];
    double x = CAMERA.fx * p[0] / p[2] + CAMERA.cx, y = CAMERA.fy * p[1] / p[2] + CAMERA.cy;
    *s = (Sums){s->weight + weight,     s->x + weight * x,      s->y + weight * y,
                s->xx + weight * x * x, s->xy + weight * x * y, s->yy + weight * y * y};
}

// In balls, rings and steps: three sums where perspective.c has one.
static Sums sums_in_space(void) {
    enum { BALLS = 40, RINGS = 60, STEPS = 64 };
    Sums sums = {0};
    gsl_integration_glfixed_table *balls = gsl_integration_glfixed_table_alloc(BALLS),
                                  *rings = gsl_integration_glfixed_table_alloc(RINGS);
    for (size_t b = 0; b < BALLS; b++)
        for (size_t ring = 0; ring < RINGS; ring++)
            for (int step = 0; step < STEPS; step++) {
                double radius, height, w_radius, w_height, turn = 2 * M_PI * step / STEPS;
                gsl_integration_glfixed_point(0, EWA_CUT, b, &radius, &w_radius, balls);
                gsl_integration_glfixed_point(-1, 1, ring, &height, &w_height, rings);
                double across = radius * sqrt(1 - height * height);
                sum_point(&sums, w_radius * w_height * radius * radius * exp(-radius * radius / 2),
                          (const double[3]){across * cos(turn), across * sin(turn), radius * height});
            }
    gsl_integration_glfixed_table_free(balls);
    gsl_integration_glfixed_table_free(rings);
    return sums;
}

static void the_integral_along_the_depth_is_the_one_over_space(void **state) {
    (void)state;
    Perspective p = perspective_of(&CAMERA, MEAN, covariance_of(SPLAT));
    Sums s = sums_in_space();
    double x = s.x / s.weight, y = s.y / s.weight, factor = ewa_cut_factor(EWA_CUT);
    support_near(p.mean[0], x, 1e-9, "mean x");
    support_near(p.mean[1], y, 1e-9, "mean y");
    support_near(p.covariance.xx, (s.xx / s.weight - x * x) / factor, 1e-6, "xx");
    support_near(p.covariance.xy, (s.xy / s.weight - x * y) / factor, 1e-6, "xy");
    support_near(p.covariance.yy, (s.yy / s.weight - y * y) / factor, 1e-6, "yy");
}

// Root mean square of the errors of many small samples, which GSL draws, against the standard errors.
static void standard_errors_are_those_of_samples(void **state) {
    (void)state;
    enum { SAMPLES = 400, POINTS = 500 };
    Perspective p = perspective_of(&CAMERA, MEAN, covariance_of(SPLAT));
    double factor = ewa_cut_factor(EWA_CUT), square[5] = {0};
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    for (int sample = 0; sample < SAMPLES; sample++) {
        Sums s = {0};
        while (s.weight < POINTS) {
            double z[3], z2 = 0;
            for (int i = 0; i < 3; i++) z[i] = gsl_ran_gaussian(rng, 1), z2 += z[i] * z[i];
            if (z2 <= EWA_CUT * EWA_CUT) sum_point(&s, 1, z);
        }
        double x = s.x / POINTS, y = s.y / POINTS;
        const double off[5] = {x - p.mean[0], y - p.mean[1], (s.xx / POINTS - x * x) / factor - p.covariance.xx,
                               (s.yy / POINTS - y * y) / factor - p.covariance.yy,
                               (s.xy / POINTS - x * y) / factor - p.covariance.xy};
        for (int i = 0; i < 5; i++) square[i] += off[i] * off[i] / SAMPLES;
    }
    gsl_rng_free(rng);
    const double want[5] = {p.mean_error[0], p.mean_error[1], p.covariance_error.xx, p.covariance_error.yy,
                            p.covariance_error.xy};
    // The error of an error from 400 samples is 4 %; a heavy tail makes it a little more.
    for (int i = 0; i < 4; i++) support_near(sqrt(square[i] * POINTS) / want[i], 1, 0.2, "standard error");
    assert_true(sqrt(square[4] * POINTS) / want[4] < 1.2); // of xy: an upper bound
    assert_true(sqrt(square[4] * POINTS) / want[4] > 0.3);
}

static void a_small_splat_far_away_is_what_ewa_says(void **state) {
    (void)state;
    double tiny[9];
    for (int i = 0; i < 9; i++) tiny[i] = 1e-5 * SPLAT[i];
    Sym3 sigma = covariance_of(tiny);
    Perspective p = perspective_of(&CAMERA, MEAN, sigma);
    Sym2 ewa = reference_ewa_forward(&CAMERA, MEAN, sigma);
    double trace = ewa.xx + ewa.yy;
    support_near(p.mean[0], CAMERA.fx * MEAN.x / MEAN.z + CAMERA.cx, 1e-7, "mean x");
    support_near(p.mean[1], CAMERA.fy * MEAN.y / MEAN.z + CAMERA.cy, 1e-7, "mean y");
    support_near(p.covariance.xx / trace, ewa.xx / trace, 1e-9, "xx");
    support_near(p.covariance.xy / trace, ewa.xy / trace, 1e-9, "xy");
    support_near(p.covariance.yy / trace, ewa.yy / trace, 1e-9, "yy");
}

// A splat as flat as a sheet across the view has one depth: perspective is linear there.
static void a_sheet_across_the_view_is_no_approximation(void **state) {
    (void)state;
    const double sheet[9] = {0.4, 0.1, 0, 0.05, 0.3, 0, 0, 0, 0};
    Sym3 sigma = covariance_of(sheet);
    Perspective p = perspective_of(&CAMERA, MEAN, sigma);
    Sym2 ewa = reference_ewa_forward(&CAMERA, MEAN, sigma);
    support_near(p.covariance.xx / ewa.xx, 1, 1e-13, "xx");
    support_near(p.covariance.yy / ewa.yy, 1, 1e-13, "yy");
    support_near(p.covariance.xy / ewa.xx, ewa.xy / ewa.xx, 1e-13, "xy");
}

// What stands in exercises/11_ewa_error/README.md.
static void the_page_of_exercise_11_says_what_is_true(void **state) {
    (void)state;
    static const double ANGLES[4] = {0, 30, 45, 60}, SIZES[4] = {0.05, 0.1, 0.2, 0.3};
    static const double SHIFT[4][4] = {
        {0, 0, 0, 0}, {0.023, 0.047, 0.103, 0.189}, {0.033, 0.067, 0.145, 0.267}, {0.040, 0.082, 0.178, 0.327}};
    static const double PERCENT[4][4] = {
        {0.6, 2.6, 12, 37}, {0.8, 3.4, 16, 59}, {1.1, 4.5, 22, 89}, {1.4, 5.8, 29, 125}};
    for (int a = 0; a < 4; a++)
        for (int k = 0; k < 4; k++) {
            double u = tan(ANGLES[a] * M_PI / 180), r = SIZES[k], f = CAMERA.fx;
            Camera square = CAMERA;
            square.fy = f;
            Vec3 mean = {3 * u, 0, 3};
            Sym3 ball = {.xx = 9 * r * r, .yy = 9 * r * r, .zz = 9 * r * r};
            Perspective p = perspective_of(&square, mean, ball);
            double radial = f * f * r * r * (1 + u * u), tangential = f * f * r * r;
            double off =
                hypot(hypot(p.covariance.xx - radial, p.covariance.yy - tangential), sqrt(2) * p.covariance.xy);
            support_near((p.mean[0] - f * u - square.cx) / sqrt(radial), SHIFT[a][k], 5.1e-4, "shift");
            support_near(100 * off / hypot(radial, tangential), PERCENT[a][k], k < 2 ? 0.051 : 0.51, "percent");
        }
}

// Kolmogorov and Smirnov: the largest distance from the normal distribution, times sqrt(n); above 1.95 once in a thousand.
static void the_draws_of_the_exercises_are_normal(void **state) {
    (void)state;
    enum { COUNT = 20000 };
    static double draws[3][COUNT];
    for (unsigned long seed = 0; seed < 5; seed++) {
        double product[3] = {0};
        for (unsigned long i = 0; i < COUNT; i++) {
            double z[3];
            draw_normals(seed, i, z);
            for (int k = 0; k < 3; k++) draws[k][i] = z[k], product[k] += z[k] * z[(k + 1) % 3] / COUNT;
        }
        for (int k = 0; k < 3; k++) {
            double distance = 0;
            gsl_sort(draws[k], 1, COUNT);
            for (int i = 0; i < COUNT; i++) {
                double p = gsl_cdf_ugaussian_P(draws[k][i]);
                distance = fmax(distance, fmax(fabs(p - (double)i / COUNT), fabs(p - (i + 1.0) / COUNT)));
            }
            assert_true(distance * sqrt(COUNT) < 1.95);
            support_near(product[k], 0, 5 / sqrt(COUNT), "mean of a product of two of one draw");
        }
    }
}

// Of draws i and i + 1, and of the same draw of neighbouring seeds.
static void draws_and_seeds_know_nothing_of_each_other(void **state) {
    (void)state;
    enum { COUNT = 100000 };
    double next = 0, neighbour = 0, inside = 0, square = 0;
    for (unsigned long i = 0; i < COUNT; i++) {
        double a[3], b[3], c[3];
        draw_normals(7, i, a);
        draw_normals(7, i + 1, b);
        draw_normals(8, i, c);
        next += a[0] * b[0] / COUNT;
        neighbour += a[0] * c[0] / COUNT;
        double z2 = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
        if (z2 <= EWA_CUT * EWA_CUT) inside++, square += z2 / 3;
    }
    support_near(next, 0, 5 / sqrt(COUNT), "draw i times draw i + 1");
    support_near(neighbour, 0, 5 / sqrt(COUNT), "seed times next seed");
    support_near(inside / COUNT, gsl_cdf_chisq_P(9, 3), 5 * sqrt(0.03 / COUNT), "share of what the cut keeps");
    support_near(square / inside, ewa_cut_factor(EWA_CUT), 5 / sqrt(COUNT), "variance of what it keeps");
}

static void the_judge_counts_the_draws_inside_the_cut(void **state) {
    (void)state;
    enum { COUNT = 100000 };
    double first[3];
    draw_normals(3, 0, first);
    CutDraws one = cut_draws(3, 1), many = cut_draws(3, COUNT);
    support_near(one.mean2, first[0] * first[0] + first[1] * first[1] + first[2] * first[2], 1e-15, "one draw");
    support_near(one.spread, 0, 1e-15, "spread of one");
    support_near(many.mean2, 0, 25.0 / COUNT, "mean of many");
    support_near(many.spread / 3, gsl_cdf_chisq_P(9, 5) / gsl_cdf_chisq_P(9, 3), 5 / sqrt(COUNT), "spread of many");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_cut_leaves_what_the_chi_square_distributions_say),
        cmocka_unit_test(the_integral_along_the_depth_is_the_one_over_space),
        cmocka_unit_test(standard_errors_are_those_of_samples),
        cmocka_unit_test(a_small_splat_far_away_is_what_ewa_says),
        cmocka_unit_test(a_sheet_across_the_view_is_no_approximation),
        cmocka_unit_test(the_page_of_exercise_11_says_what_is_true),
        cmocka_unit_test(the_draws_of_the_exercises_are_normal),
        cmocka_unit_test(draws_and_seeds_know_nothing_of_each_other),
        cmocka_unit_test(the_judge_counts_the_draws_inside_the_cut),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
