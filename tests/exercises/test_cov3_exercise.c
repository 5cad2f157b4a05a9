// test_cov3_exercise.c - the figures on E08's page: how soon six free numbers are no covariance, and that seven always are one.
#include "exercises/harness/sym3_eigen.h"
#include "lab/base/rng.h"
#include "tests/support/support.h"

#include <math.h>

enum { BLOBS = 20000, ASPECTS = 5 };
static const double ASPECT[ASPECTS] = {2, 4, 8, 16, 30};
static const double OUTSIDE[ASPECTS] = {0, 0, 0.13, 0.48, 0.62}; // as the page says
static const double STEP = 0.01;                                 // of the largest eigenvalue, the standard deviation
static const double LARGE_STEP = 0.5;                            // of logs and of q, which has a length of about 2

// A blob whose scales are 1, one between, and 1 / aspect.
static void draw_blob(Rng *rng, double aspect, double log_scale[3], double quat[4]) {
    for (int k = 0; k < 4; k++) quat[k] = rng_normal(rng);
    log_scale[0] = 0;
    log_scale[1] = -log(aspect) * rng_uniform(rng);
    log_scale[2] = -log(aspect);
}

static double smallest_eigenvalue(Sym3 s) {
    double values[3];
    sym3_eigenvalues(s, values);
    return values[0];
}

static void small_steps_of_six_numbers_leave_the_cone_as_the_page_says(void **state) {
    (void)state;
    for (uint32_t a = 0; a < ASPECTS; a++) {
        int outside = 0;
        for (uint32_t i = 0; i < BLOBS; i++) {
            Rng rng = rng_at(1, RNG_TEST, a, i);
            double log_scale[3], quat[4];
            draw_blob(&rng, ASPECT[a], log_scale, quat);
            Sym3 s = reference_covariance_forward(log_scale, quat);
            for (int k = 0; k < 6; k++) (&s.xx)[k] += STEP * rng_normal(&rng);
            outside += smallest_eigenvalue(s) < 0;
        }
        print_message("aspect %2g: %.1f %% outside\n", ASPECT[a], 100.0 * outside / BLOBS);
        support_near((double)outside / BLOBS, OUTSIDE[a], 0.01, "share outside");
    }
}

static void large_steps_of_seven_numbers_never_do(void **state) {
    (void)state;
    for (uint32_t a = 0; a < ASPECTS; a++)
        for (uint32_t i = 0; i < BLOBS; i++) {
            Rng rng = rng_at(2, RNG_TEST, a, i);
            double log_scale[3], quat[4];
            draw_blob(&rng, ASPECT[a], log_scale, quat);
            for (int k = 0; k < 3; k++) log_scale[k] += LARGE_STEP * rng_normal(&rng);
            for (int k = 0; k < 4; k++) quat[k] += LARGE_STEP * rng_normal(&rng);
            assert_true(smallest_eigenvalue(reference_covariance_forward(log_scale, quat)) > 0);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(small_steps_of_six_numbers_leave_the_cone_as_the_page_says),
        cmocka_unit_test(large_steps_of_seven_numbers_never_do),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
