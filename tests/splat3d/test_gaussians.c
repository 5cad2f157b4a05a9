// test_gaussians.c - what follows from the field table: memory, copies, counts, the search for what is not finite.
#include "splat3d/gaussians.h"
#include "tests/support/support.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

static void every_degree_has_its_fields_and_no_more(void **state) {
    (void)state;
    const int floats[] = {14, 23, 38, 59}; // 11 + 3 (d + 1)^2
    for (int degree = 0; degree <= SH_DEGREE_MAX; degree++) {
        Gaussians g = gaussians_create(5, degree);
        assert_int_equal(gaussians_floats_per_splat(degree), floats[degree]);
        int found = 0;
        for (int id = 0; id < FIELD_COUNT; id++) {
            bool wanted = GAUSSIAN_FIELDS[id].sh_degree <= degree;
            assert_int_equal(g.field[id] != NULL, wanted);
            if (!wanted) continue;
            found += GAUSSIAN_FIELDS[id].width;
            assert_int_equal((uintptr_t)g.field[id] % 64, 0); // a vector load wants it
            for (int i = 0; i < 5 * GAUSSIAN_FIELDS[id].width; i++) assert_true(g.field[id][i] == 0);
        }
        assert_int_equal(found, floats[degree]);
        gaussians_destroy(&g);
        gaussians_destroy(&g);
        assert_null(g.field[FIELD_MEAN]);
    }
}

static void a_copy_has_the_numbers_and_its_own_memory(void **state) {
    (void)state;
    Gaussians g = gaussians_create(3, 2);
    gaussians_at(&g, FIELD_QUAT, 1)[2] = 7;
    g.field[FIELD_SH2][3 * 15 - 1] = 5;
    Gaussians copy = gaussians_copy(&g);
    assert_int_equal(copy.count, 3);
    assert_int_equal(copy.sh_degree, 2);
    gaussians_at(&g, FIELD_QUAT, 1)[2] = 8;
    assert_true(copy.field[FIELD_QUAT][1 * 4 + 2] == 7);
    assert_true(gaussians_at(&copy, FIELD_SH2, 2)[14] == 5);
    gaussians_destroy(&copy);
    gaussians_destroy(&g);
}

static void gathered_splats_bring_all_their_numbers_and_nothing_is_zeros(void **state) {
    (void)state;
    const uint32_t source[5] = {2, 0, GAUSSIANS_GATHER_NOTHING, 2, 1};
    Gaussians g = gaussians_create(3, 1);
    for (int id = 0; id < FIELD_COUNT; id++)
        for (int k = 0; g.field[id] && k < 3 * GAUSSIAN_FIELDS[id].width; k++)
            g.field[id][k] = (float)(100 * id + k + 1);
    Gaussians before = gaussians_copy(&g);
    gaussians_gather(&g, 5, source);
    assert_int_equal(g.count, 5);
    assert_null(g.field[FIELD_SH2]);
    for (GaussianFieldId id = 0; id <= FIELD_SH1; id++)
        for (int i = 0; i < 5; i++)
            for (int k = 0; k < GAUSSIAN_FIELDS[id].width; k++)
                support_near((double)gaussians_at(&g, id, i)[k],
                             i == 2 ? 0 : (double)gaussians_at(&before, id, (int)source[i])[k], 0, "number");
    gaussians_destroy(&g);
    gaussians_destroy(&before);
}

static void the_first_splat_that_is_not_finite_is_found(void **state) {
    (void)state;
    Gaussians g = gaussians_create(10, 3);
    int splat = -1;
    GaussianFieldId id = FIELD_MEAN;
    assert_true(gaussians_are_finite(&g, &splat, &id));
    gaussians_at(&g, FIELD_MEAN, 8)[0] = NAN;
    gaussians_at(&g, FIELD_SH3, 4)[20] = -INFINITY;
    gaussians_at(&g, FIELD_OPACITY_LOGIT, 5)[0] = INFINITY;
    assert_false(gaussians_are_finite(&g, &splat, &id));
    assert_int_equal(splat, 4);
    assert_int_equal(id, FIELD_SH3);
    gaussians_at(&g, FIELD_SH3, 4)[20] = 0;
    assert_false(gaussians_are_finite(&g, &splat, &id));
    assert_int_equal(splat, 5);
    assert_int_equal(id, FIELD_OPACITY_LOGIT);
    gaussians_destroy(&g);
}

static void a_model_without_splats_is_a_model(void **state) {
    (void)state;
    Gaussians g = gaussians_create(0, 3), copy = gaussians_copy(&g);
    int splat;
    GaussianFieldId id;
    assert_true(gaussians_are_finite(&copy, &splat, &id));
    gaussians_destroy(&copy);
    gaussians_destroy(&g);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_degree_has_its_fields_and_no_more),
        cmocka_unit_test(a_copy_has_the_numbers_and_its_own_memory),
        cmocka_unit_test(gathered_splats_bring_all_their_numbers_and_nothing_is_zeros),
        cmocka_unit_test(the_first_splat_that_is_not_finite_is_found),
        cmocka_unit_test(a_model_without_splats_is_a_model),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
