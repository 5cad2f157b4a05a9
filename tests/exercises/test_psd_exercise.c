// The oracles of E03: its eigenvalues against GSL's, its differences against the house's own gradient.
#include "exercises/03_psd/check.c"
#include "tests/support/support.h"

#include <gsl/gsl_eigen.h>

enum { SEEDS = 300 };

static void smallest_and_largest_eigenvalue_are_gsls(void **state) {
    (void)state;
    gsl_eigen_symm_workspace *space = gsl_eigen_symm_alloc(3);
    gsl_vector *values = gsl_vector_alloc(3);
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        Rng rng = rng_at(seed, RNG_TEST, 0, 0);
        double S[6], smallest, largest;
        for (int i = 0; i < 6; i++) S[i] = seed % 3 == 0 && i % 2 ? 0 : rng_range(&rng, -2, 2);
        double full[9] = {S[0], S[1], S[2], S[1], S[3], S[4], S[2], S[4], S[5]};
        gsl_matrix_view matrix = gsl_matrix_view_array(full, 3, 3);
        gsl_eigen_symm(&matrix.matrix, values, space);
        eigenvalues3(S, &smallest, &largest);
        support_near(smallest, gsl_vector_min(values), 1e-14, "smallest");
        support_near(largest, gsl_vector_max(values), 1e-14, "largest");
    }
    gsl_vector_free(values);
    gsl_eigen_symm_free(space);
}

static void differences_are_the_gradient_through_the_conic(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        Rng rng = rng_at(seed, RNG_TEST, 1, 0);
        double in[NUMBERS] = {0}, want[3];
        draw_all_pixels(&rng, (int)(seed % 8), in);
        Sym2 S = covariance_of(in + FACTORS), conic, d_conic = {0};
        assert_true(covariance_conic(S, &conic));
        int width = (int)in[WIDTH];
        for (int i = 0; i < width * (int)in[HEIGHT]; i++) {
            double dx = i % width + 0.5 - in[WIDTH] / 2, dy = i / width + 0.5 - in[HEIGHT] / 2;
            double d = -in[ERRORS + i] * exp(-conic_mahalanobis2(conic, dx, dy) / 2) / 2;
            d_conic = (Sym2){d_conic.xx + d * dx * dx, d_conic.xy + 2 * d * dx * dy, d_conic.yy + d * dy * dy};
        }
        Sym2 d = covariance_conic_backward(conic, d_conic);
        double scale = scale_of(in, 1 / minor_of(in));
        expected_raw(in, want);
        support_near(want[0] / scale, d.xx / scale, 1e-9, "xx");
        support_near(want[1] / scale, d.xy / scale, 1e-9, "xy");
        support_near(want[2] / scale, d.yy / scale, 1e-9, "yy");
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(smallest_and_largest_eigenvalue_are_gsls),
        cmocka_unit_test(differences_are_the_gradient_through_the_conic),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
