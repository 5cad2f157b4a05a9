#include "lab/base/rng.h"
#include "splat2d/psd_trap.h"
#include "tests/support/difference.h"
#include "tests/support/support.h"

#include <math.h>
#include <string.h>

typedef struct {
    const PsdTrap *trap;
    PsdWalk *walk;
} Loss;

static double loss_of(void *context) {
    const Loss *loss = context;
    return psd_trap_loss(loss->trap, loss->walk);
}

static void both_gradients_are_those_of_the_loss(void **state) {
    (void)state;
    static PsdTrap trap;
    psd_trap_begin(&trap);
    const double values[PSD_WAY_COUNT][3] = {{0.9, 0.3, 0.7}, {0.4, 0.2, -0.5}};
    for (int way = 0; way < PSD_WAY_COUNT; way++) {
        PsdWalk *walk = &trap.walks[way];
        memcpy(walk->values, values[way], sizeof walk->values);
        Loss loss = {&trap, walk};
        double gradient[3], expected[3];
        psd_trap_gradient(&trap, walk, gradient);
        for (int i = 0; i < 3; i++) expected[i] = difference_central(&walk->values[i], 1e-3, loss_of, &loss);
        difference_compare(3, gradient, expected, 1e-6, 1e-8, way == PSD_RAW ? "raw" : "factored");
    }
}

static void the_raw_walk_leaves_the_cone_and_the_factored_one_arrives(void **state) {
    (void)state;
    static PsdTrap trap;
    psd_trap_begin(&trap);
    for (int i = 0; i < 160; i++) psd_trap_step(&trap);
    const PsdWalk *raw = &trap.walks[PSD_RAW], *factored = &trap.walks[PSD_FACTORED];
    assert_true(sym2_eigen(raw->path[10]).minor > 0 && sym2_eigen(raw->path[20]).minor < 0);
    assert_true(raw->loss[160] > 5 * raw->loss[0]);
    assert_true(factored->loss[160] < 1e-4 * factored->loss[0]);
    for (int i = 0; i <= 160; i++) assert_true(sym2_eigen(factored->path[i]).minor > 0);
}

static void the_factored_walk_stays_valid_at_any_rate(void **state) {
    (void)state;
    static PsdTrap trap;
    for (double rate = 0.01; rate < 2; rate *= 2) {
        psd_trap_begin(&trap);
        trap.learning_rate = rate;
        for (int i = 0; i < 100; i++) psd_trap_step(&trap);
        for (int i = 0; i <= 100; i++) {
            const double *v = trap.walks[PSD_FACTORED].values;
            assert_true(isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]));
            assert_true(sym2_eigen(trap.walks[PSD_FACTORED].path[i]).minor >= 0); // 0: rounded, of a needle
        }
    }
}

static void both_walks_end_at_the_step_limit(void **state) {
    (void)state;
    static PsdTrap trap;
    psd_trap_begin(&trap);
    for (int way = 0; way < PSD_WAY_COUNT; way++) trap.walks[way].step = PSD_PATH_MAX - 1;
    for (int i = 0; i < 5; i++) psd_trap_step(&trap);
    assert_int_equal(trap.walks[PSD_RAW].step, PSD_PATH_MAX);
    psd_trap_restart(&trap);
    assert_int_equal(trap.walks[PSD_RAW].step, 0);
}

static void a_walk_is_moved_by_hand(void **state) {
    (void)state;
    static PsdTrap trap;
    psd_trap_begin(&trap);
    Sym2 valid = covariance_from_angle(0.3, 0.5, 2);
    psd_trap_set(&trap, PSD_FACTORED, (double[3]){0.3, log(0.5), log(2)});
    psd_trap_set(&trap, PSD_RAW, (double[3]){1, 2, 1}); // no Gaussian
    Sym2 now = psd_walk_covariance(&trap.walks[PSD_FACTORED]);
    support_near(now.xx, valid.xx, 1e-12, "xx");
    support_near(now.xy, valid.xy, 1e-12, "xy");
    assert_true(psd_walk_covariance(&trap.walks[PSD_RAW]).xy == 2);
    // A round blob has an angle, too, though one does not see it.
    psd_trap_set(&trap, PSD_FACTORED, (double[3]){0.7, 0, 0});
    assert_true(trap.walks[PSD_FACTORED].values[0] == 0.7 && trap.walks[PSD_FACTORED].step == 0);
}

static void the_cone_is_where_the_smaller_eigenvalue_is_positive(void **state) {
    (void)state;
    Rng rng = rng_at(5, RNG_TEST, 0, 0);
    for (int i = 0; i < 1000; i++) {
        Sym2 matrix = {rng_range(&rng, -2, 2), rng_range(&rng, -2, 2), rng_range(&rng, -2, 2)};
        double point[3];
        psd_cone_point(matrix, point);
        bool inside = point[2] > hypot(point[0], point[1]);
        assert_int_equal(inside, sym2_eigen(matrix).minor > 0);
        Sym2 back = psd_cone_covariance(point);
        support_near(back.xx, matrix.xx, 1e-15, "xx");
        support_near(back.yy, matrix.yy, 1e-15, "yy");
    }
}

static void an_indefinite_sigma_grows_along_its_axis(void **state) {
    (void)state;
    Sym2 indefinite = {1, 0, -1};
    assert_true(psd_trap_alpha(0.5, indefinite, 2, 0) < 0.1);  // falls off along x
    assert_true(psd_trap_alpha(0.5, indefinite, 0, 2) > 0.98); // grows along y, up to the clamp
    assert_true(psd_trap_alpha(0.5, (Sym2){1, 1, 1}, 1, 1) == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_gradients_are_those_of_the_loss),
        cmocka_unit_test(the_raw_walk_leaves_the_cone_and_the_factored_one_arrives),
        cmocka_unit_test(the_factored_walk_stays_valid_at_any_rate),
        cmocka_unit_test(both_walks_end_at_the_step_limit),
        cmocka_unit_test(a_walk_is_moved_by_hand),
        cmocka_unit_test(the_cone_is_where_the_smaller_eigenvalue_is_positive),
        cmocka_unit_test(an_indefinite_sigma_grows_along_its_axis),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
