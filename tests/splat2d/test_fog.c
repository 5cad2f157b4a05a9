#include "splat2d/fog.h"

#include "lab/base/rng.h"
#include "tests/support/support.h"

#include <gsl/gsl_integration.h>
#include <math.h>

enum { DRAWS = 1000 };

static void alpha_and_sigma_are_each_others_inverse_over_thirty_decades(void **state) {
    (void)state;
    Rng rng = rng_at(1, RNG_TEST, 0, 0);
    for (int i = 0; i < DRAWS; i++) {
        double alpha = pow(10, rng_range(&rng, -30, -0.1)), delta = pow(10, rng_range(&rng, -3, 3));
        double back = fog_alpha(fog_sigma(alpha, delta), delta);
        support_near(back / alpha, 1, 4e-15, "alpha there and back");
    }
}

static void tiny_alphas_survive_single_precision_only_through_expm1(void **state) {
    (void)state;
    double worst = 0, worst_naive = 0;
    for (int i = 0; i < DRAWS; i++) {
        float sigma = (float)(1e-5 * (1 + 0.001 * i));
        double exact = -expm1(-(double)sigma);
        worst = fmax(worst, fabs((double)fog_alpha_float(sigma, 1) / exact - 1));
        worst_naive = fmax(worst_naive, fabs((double)fog_alpha_float_naive(sigma, 1) / exact - 1));
    }
    assert_true(worst < 2e-7);
    assert_true(worst_naive > 1e-3);
}

// ---- splats ----

// A Gaussian of density along the ray, integrated by GSL, off the centre by (1 - g) of its density.
static double gaussian_density(double t, void *peak) { return *(double *)peak * exp(-t * t / 2); }

static void the_gap_is_between_a_splat_and_the_integral_of_a_gaussian_fog(void **state) {
    (void)state;
    for (int i = 1; i < 10; i++) {
        double opacity = 0.1 * i, g = 0.07 * i + 0.2, depth, error;
        double peak = -log(1 - opacity) / sqrt(2 * M_PI) * g;
        gsl_function function = {gaussian_density, &peak};
        gsl_integration_workspace *work = gsl_integration_workspace_alloc(200);
        gsl_integration_qagi(&function, 1e-12, 1e-12, 200, work, &depth, &error);
        gsl_integration_workspace_free(work);
        support_near(splat_fog_gap(opacity, g), 1 - exp(-depth) - opacity * g, 1e-10, "gap");
    }
}

static void no_gap_is_larger_than_the_largest(void **state) {
    (void)state;
    for (int i = 0; i < 100; i++) {
        double opacity = 0.0099 * i, at, largest = splat_fog_gap_largest(opacity, &at), seen = 0;
        assert_true(at >= 0 && at <= 1);
        for (int k = 0; k <= 1000; k++) seen = fmax(seen, splat_fog_gap(opacity, k / 1000.0));
        assert_true(seen <= largest + 1e-15);
        support_near(seen, largest, 1e-5, "largest gap");
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(alpha_and_sigma_are_each_others_inverse_over_thirty_decades),
        cmocka_unit_test(tiny_alphas_survive_single_precision_only_through_expm1),
        cmocka_unit_test(the_gap_is_between_a_splat_and_the_integral_of_a_gaussian_fog),
        cmocka_unit_test(no_gap_is_larger_than_the_largest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
