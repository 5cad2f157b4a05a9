#include "splat2d/covariance.h"

#include "lab/base/rng.h"
#include "tests/support/support.h"

#include <gsl/gsl_eigen.h>
#include <math.h>

enum { SEEDS = 200 };

// Calls check(rng, seed) for many seeds; a failing check names its seed.
static void for_each_seed(void (*check)(Rng *rng, const char *seed)) {
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        char name[32];
        snprintf(name, sizeof name, "seed %u", seed);
        Rng rng = rng_at(seed, RNG_TEST, 0, 0);
        check(&rng, name);
    }
}

static Sym2 random_covariance(Rng *rng) {
    double angle = rng_range(rng, -7, 7), sx = rng_range(rng, 0.3, 5), sy = rng_range(rng, 0.3, 5);
    return covariance_from_angle(angle, sx, sy);
}

static void check_eigen(Rng *rng, const char *seed) {
    double angle = rng_range(rng, 0, M_PI), major = rng_range(rng, 2, 5), minor = rng_range(rng, 0.1, 1.9);
    Sym2 a = covariance_from_angle(angle, major, minor);
    double entries[4] = {a.xx, a.xy, a.xy, a.yy};
    gsl_matrix_view matrix = gsl_matrix_view_array(entries, 2, 2);
    gsl_vector *values = gsl_vector_alloc(2);
    gsl_eigen_symm_workspace *work = gsl_eigen_symm_alloc(2);
    gsl_eigen_symm(&matrix.matrix, values, work);

    Eigen2 eigen = sym2_eigen(a);
    support_near(eigen.major, gsl_vector_max(values), 1e-12, seed);
    support_near(eigen.minor, gsl_vector_min(values), 1e-12, seed);
    support_near(eigen.major, major * major, 1e-12, seed);
    support_near(eigen.minor, minor * minor, 1e-12, seed);
    support_near(eigen.angle_rad, angle, 1e-9, seed);
    support_near(sym2_length(a), hypot(gsl_vector_get(values, 0), gsl_vector_get(values, 1)), 1e-12, seed);
    gsl_eigen_symm_free(work);
    gsl_vector_free(values);
}

static void a_rotated_blob_keeps_its_eigenvalues_and_points_along_its_angle(void **state) {
    (void)state;
    for_each_seed(check_eigen);
}

static void a_round_blob_has_angle_zero_and_every_angle_is_below_pi(void **state) {
    (void)state;
    assert_true(sym2_eigen((Sym2){4, 0, 4}).angle_rad == 0);
    assert_true(sym2_eigen((Sym2){4, -1e-300, 1}).angle_rad == 0);
    support_near(sym2_eigen((Sym2){1, 0, 4}).angle_rad, M_PI / 2, 1e-15, "upright");
    support_near(sym2_eigen((Sym2){2, -1, 2}).angle_rad, 3 * M_PI / 4, 1e-15, "falling diagonal");
}

static void check_semidefinite(Rng *rng, const char *seed) {
    Sym2 a = covariance_from_angle(rng_range(rng, -7, 7), rng_range(rng, -3, 3), rng_range(rng, -3, 3));
    double x = rng_normal(rng), y = rng_normal(rng);
    support_near(fmin(0, conic_mahalanobis2(a, x, y)), 0, 1e-14, seed); // v^T Sigma v, not below 0
    Sym2 widened = sym2_add_diagonal(a, 0.3);
    support_near(fmin(0.3, sym2_eigen(widened).minor), 0.3, 1e-14, seed);
}

static void a_covariance_is_positive_semidefinite_for_any_input(void **state) {
    (void)state;
    for_each_seed(check_semidefinite);
}

static void check_conic(Rng *rng, const char *seed) {
    Sym2 a = random_covariance(rng), c;
    assert_true(covariance_conic(a, &c));
    support_near(a.xx * c.xx + a.xy * c.xy, 1, 1e-12, seed);
    support_near(a.xx * c.xy + a.xy * c.yy, 0, 1e-12, seed);
    support_near(a.xy * c.xy + a.yy * c.yy, 1, 1e-12, seed);
    support_near(sym2_determinant(a) * sym2_determinant(c), 1, 1e-12, seed);
}

static void the_conic_is_the_inverse(void **state) {
    (void)state;
    for_each_seed(check_conic);
}

static void a_matrix_without_extent_has_no_conic(void **state) {
    (void)state;
    Sym2 conic = {7, 8, 9};
    assert_false(covariance_conic(covariance_from_angle(0, 2, 0), &conic));
    assert_false(covariance_conic((Sym2){1, 2, 1}, &conic));
    assert_false(covariance_conic((Sym2){NAN, 0, 1}, &conic));
    assert_true(conic.xx == 7 && conic.xy == 8 && conic.yy == 9);
}

// L = w . conic for random weights w, so that d_conic = w.
static double weighted_conic(Sym2 covariance, Sym2 w) {
    Sym2 c;
    assert_true(covariance_conic(covariance, &c));
    return w.xx * c.xx + w.xy * c.xy + w.yy * c.yy;
}

static void check_conic_backward(Rng *rng, const char *seed) {
    Sym2 a = random_covariance(rng), w = {rng_normal(rng), rng_normal(rng), rng_normal(rng)}, c;
    assert_true(covariance_conic(a, &c));
    Sym2 d = covariance_conic_backward(c, w);
    double *stored[3] = {&a.xx, &a.xy, &a.yy}, expected[3] = {d.xx, d.xy, d.yy};
    for (int k = 0; k < 3; k++) {
        double value = *stored[k], h = 1e-6 * sym2_eigen(a).minor;
        *stored[k] = value + h;
        double above = weighted_conic(a, w);
        *stored[k] = value - h;
        double below = weighted_conic(a, w);
        *stored[k] = value;
        double scale = fabs(d.xx) + fabs(d.xy) + fabs(d.yy);
        support_near((above - below) / (2 * h), expected[k], 1e-6 * scale, seed);
    }
}

static void the_gradient_through_the_conic_is_by_the_stored_numbers(void **state) {
    (void)state;
    for_each_seed(check_conic_backward);
}

static void check_box(Rng *rng, const char *seed) {
    double angle = rng_range(rng, 0, 7), sx = rng_range(rng, 0.3, 5), sy = rng_range(rng, 0.3, 5), k = 2.5;
    double half_x, half_y, reach_x = 0, reach_y = 0;
    covariance_box(covariance_from_angle(angle, sx, sy), k, &half_x, &half_y);
    for (int i = 0; i < 3600; i++) { // walk round the ellipse in its own axes
        double t = i * M_PI / 1800, u = k * sx * cos(t), v = k * sy * sin(t);
        reach_x = fmax(reach_x, cos(angle) * u - sin(angle) * v);
        reach_y = fmax(reach_y, sin(angle) * u + cos(angle) * v);
    }
    support_near(reach_x, half_x, 2e-6 * half_x, seed);
    support_near(reach_y, half_y, 2e-6 * half_y, seed);
}

static void the_box_touches_the_ellipse(void **state) {
    (void)state;
    for_each_seed(check_box);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rotated_blob_keeps_its_eigenvalues_and_points_along_its_angle),
        cmocka_unit_test(a_round_blob_has_angle_zero_and_every_angle_is_below_pi),
        cmocka_unit_test(a_covariance_is_positive_semidefinite_for_any_input),
        cmocka_unit_test(the_conic_is_the_inverse),
        cmocka_unit_test(a_matrix_without_extent_has_no_conic),
        cmocka_unit_test(the_gradient_through_the_conic_is_by_the_stored_numbers),
        cmocka_unit_test(the_box_touches_the_ellipse),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
