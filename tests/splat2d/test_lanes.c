#include "splat2d/lanes.h"

#include "tests/support/support.h"

static void the_fast_power_of_two_is_as_good_as_a_float(void **state) {
    (void)state;
    double worst = 0;
    for (int i = -125000; i <= 125000; i += LANES) {
        Lanes x = lanes_count_from((float)i) * 0.001f, power = lanes_exp2(x);
        for (int k = 0; k < LANES && i + k <= 125000; k++)
            worst = fmax(worst, fabs((double)power[k] / exp2((double)x[k]) - 1));
    }
    support_near(worst, 0, 2.5e-7, "relative error");
}

static void outside_its_range_it_stays_at_the_ends(void **state) {
    (void)state;
    Lanes power = lanes_exp2((Lanes){-1e30f, 1e30f, -INFINITY, INFINITY});
    for (int k = 0; k < 2; k++) {
        assert_true(power[2 * k] > 0 && power[2 * k] < 2e-38f);
        assert_true(power[2 * k + 1] > 8e37f && power[2 * k + 1] < INFINITY);
    }
}

static void masks_choose_and_sums_go_from_first_to_last(void **state) {
    (void)state;
    const float memory[6] = {9, 1, 2, 3, 4, 9};
    Lanes a = lanes_load(memory + 1), b = lanes_all(2.5f);
    Lanes smaller = lanes_min(a, b), kept = lanes_only(a > b, a), chosen = lanes_where(a > b, a, -a);
    const float expected[3][4] = {{1, 2, 2.5f, 2.5f}, {0, 0, 3, 4}, {-1, -2, 3, 4}};
    for (int k = 0; k < 4; k++) {
        assert_true(smaller[k] == expected[0][k]);
        assert_true(kept[k] == expected[1][k]);
        assert_true(chosen[k] == expected[2][k]);
    }
    assert_true(lanes_any(a > 3.5f));
    assert_false(lanes_any(a > 4));
    assert_true(lanes_sum((Lanes){1e8f, 1, -1e8f, 1}) == 1); // 1e8 + 1 is 1e8
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_fast_power_of_two_is_as_good_as_a_float),
        cmocka_unit_test(outside_its_range_it_stays_at_the_ends),
        cmocka_unit_test(masks_choose_and_sums_go_from_first_to_last),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
