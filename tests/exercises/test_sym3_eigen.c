// test_sym3_eigen.c - the eigenvalues by which a covariance is judged, against GSL's.
#include "exercises/harness/sym3_eigen.h"

#include "lab/base/rng.h"
#include "tests/support/support.h"

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_sort_vector.h>
#include <math.h>

enum { SEEDS = 2000 };
static const double TOLERANCE = 4e-15; // of the largest; 18 units in the last place

static void expect_same(Sym3 s, const char *what) {
    double entries[9] = {s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz}, values[3];
    gsl_matrix_view matrix = gsl_matrix_view_array(entries, 3, 3);
    gsl_vector *wanted = gsl_vector_alloc(3);
    gsl_eigen_symm_workspace *work = gsl_eigen_symm_alloc(3);
    gsl_eigen_symm(&matrix.matrix, wanted, work);
    gsl_sort_vector(wanted);
    sym3_eigenvalues(s, values);
    double largest = fmax(fabs(gsl_vector_get(wanted, 0)), fabs(gsl_vector_get(wanted, 2)));
    for (size_t k = 0; k < 3; k++) support_near(values[k], gsl_vector_get(wanted, k), TOLERANCE * largest, what);
    gsl_eigen_symm_free(work);
    gsl_vector_free(wanted);
}

static void eigenvalues_of_any_symmetric_matrix_are_those_of_gsl(void **state) {
    (void)state;
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        Rng rng = rng_at(seed, RNG_TEST, 0, 0);
        Sym3 s;
        char what[32];
        snprintf(what, sizeof what, "seed %u", seed);
        for (int k = 0; k < 6; k++) (&s.xx)[k] = rng_normal(&rng) * exp(rng_range(&rng, -6, 6));
        if (seed % 5 == 0) s.xy = s.xz = 0;
        expect_same(s, what);
    }
}

static void eigenvalues_of_a_needle_are_those_of_gsl(void **state) {
    (void)state;
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        Rng rng = rng_at(seed, RNG_TEST, 1, 0);
        double quat[4], log_scale[3];
        char what[32];
        snprintf(what, sizeof what, "seed %u", seed);
        for (int k = 0; k < 4; k++) quat[k] = rng_normal(&rng);
        for (int k = 0; k < 3; k++) log_scale[k] = rng_range(&rng, -8, 3);
        if (seed % 3 == 0) log_scale[1] = log_scale[0]; // twice the same
        expect_same(reference_covariance_forward(log_scale, quat), what);
    }
}

static void matrices_that_are_diagonal_already_keep_their_numbers(void **state) {
    (void)state;
    double values[3];
    sym3_eigenvalues((Sym3){.xx = 3, .yy = -2, .zz = 0.5}, values);
    assert_true(values[0] == -2 && values[1] == 0.5 && values[2] == 3);
    sym3_eigenvalues((Sym3){0}, values);
    assert_true(values[0] == 0 && values[1] == 0 && values[2] == 0);
}

static void what_is_not_finite_has_no_eigenvalues(void **state) {
    (void)state;
    double values[3];
    sym3_eigenvalues((Sym3){.xx = 1, .yz = NAN}, values);
    assert_true(isnan(values[0]) && isnan(values[1]) && isnan(values[2]));
    sym3_eigenvalues((Sym3){.xx = INFINITY}, values);
    assert_true(isnan(values[0]));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(eigenvalues_of_any_symmetric_matrix_are_those_of_gsl),
        cmocka_unit_test(eigenvalues_of_a_needle_are_those_of_gsl),
        cmocka_unit_test(matrices_that_are_diagonal_already_keep_their_numbers),
        cmocka_unit_test(what_is_not_finite_has_no_eigenvalues),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
