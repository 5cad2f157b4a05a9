#include "splat3d/schedule.h"
#include "tests/support/support.h"

#include <math.h>
#include <string.h>

// Over the published 30,000 steps the shares of the run are the published step numbers (Kerbl et al. 2023).
static TrainOptions published(void) {
    TrainOptions o = train_options_default();
    o.iterations = 30000;
    return o;
}

static void density_control_runs_from_600_to_14900_every_100(void **state) {
    (void)state;
    TrainOptions o = published();
    int first = 0, last = 0, count = 0;
    for (int step = 1; step <= o.iterations; step++) {
        if (!schedule_density_is_due(&o, step)) continue;
        if (!first) first = step;
        last = step;
        count++;
    }
    assert_int_equal(first, 600);
    assert_int_equal(last, 14900);
    assert_int_equal(count, 144);
}

static void opacities_are_reset_every_3000_while_density_control_is_on(void **state) {
    (void)state;
    TrainOptions o = published();
    int steps[8], count = 0;
    for (int step = 1; step <= o.iterations; step++)
        if (schedule_reset_is_due(&o, step, false)) steps[count++] = step;
    assert_int_equal(count, 4);
    for (int i = 0; i < 4; i++) assert_int_equal(steps[i], 3000 * (i + 1));
    assert_true(schedule_reset_is_due(&o, 500, true));
    assert_false(schedule_reset_is_due(&o, 500, false));
}

static void the_mean_rate_decays_log_linearly_from_start_to_end(void **state) {
    (void)state;
    TrainOptions o = published();
    float rate[FIELD_COUNT];
    schedule_learning_rates(&o, 1, 2.0, rate);
    support_near(rate[FIELD_MEAN], 3.2e-4, 1e-9, "first step");
    schedule_learning_rates(&o, 15001, 2.0, rate);
    support_near(rate[FIELD_MEAN], 3.2e-5, 1e-10, "half way: the geometric mean");
    schedule_learning_rates(&o, 30001, 2.0, rate);
    support_near(rate[FIELD_MEAN], 3.2e-6, 1e-11, "end");
    support_near(rate[FIELD_SH3], o.lr_sh0 / 20, 1e-10, "higher SH degrees learn 20 times slower");
}

static void one_sh_degree_more_every_1000_steps(void **state) {
    (void)state;
    TrainOptions o = published();
    assert_int_equal(schedule_sh_degree(&o, 999), 0);
    assert_int_equal(schedule_sh_degree(&o, 1000), 1);
    assert_int_equal(schedule_sh_degree(&o, 3000), 3);
    assert_int_equal(schedule_sh_degree(&o, 30000), 3);
    o.sh_degree = 1;
    assert_int_equal(schedule_sh_degree(&o, 30000), 1);
}

static void every_epoch_sees_every_view_once_in_another_order(void **state) {
    (void)state;
    enum { VIEWS = 37 };
    TrainOptions o = published();
    int order[VIEWS], epoch = -1, before[VIEWS] = {0};
    for (int e = 0; e < 5; e++) {
        int seen[VIEWS] = {0}, now[VIEWS];
        for (int i = 0; i < VIEWS; i++) {
            now[i] = schedule_view(&o, e * VIEWS + i + 1, VIEWS, order, &epoch);
            seen[now[i]]++;
        }
        for (int i = 0; i < VIEWS; i++) assert_int_equal(seen[i], 1);
        assert_memory_not_equal(now, before, sizeof now);
        memcpy(before, now, sizeof now);
    }
}

static void a_resumed_run_sees_the_views_of_an_uninterrupted_one(void **state) {
    (void)state;
    enum { VIEWS = 11 };
    TrainOptions o = published();
    int order[VIEWS], epoch = -1, resumed_order[VIEWS], resumed_epoch = -1;
    for (int step = 1; step <= 100; step++) {
        int view = schedule_view(&o, step, VIEWS, order, &epoch);
        if (step > 57) assert_int_equal(schedule_view(&o, step, VIEWS, resumed_order, &resumed_epoch), view);
    }
}

// How many steps of a run see pictures of each level.
static void count_levels(const TrainOptions *o, int counts[COARSE_LEVELS_MAX + 1]) {
    memset(counts, 0, (COARSE_LEVELS_MAX + 1) * sizeof *counts);
    int before = o->coarse_levels;
    for (int step = 1; step <= o->iterations; step++) {
        int level = schedule_coarse_level(o, step);
        assert_in_range(level, 0, before); // pictures never shrink again
        counts[before = level]++;
    }
}

static void pictures_grow_in_equal_parts_until_coarse_until_and_are_whole_from_there(void **state) {
    (void)state;
    TrainOptions o = published();
    int counts[COARSE_LEVELS_MAX + 1];
    o.iterations = 1000, o.coarse_levels = 3, o.coarse_until = 0.6;
    count_levels(&o, counts);
    assert_int_equal(counts[3], 200);
    assert_int_equal(counts[2], 200);
    assert_int_equal(counts[1], 200);
    assert_int_equal(counts[0], 400);
    o.coarse_until = 1; // and where it does not divide
    o.iterations = 1001;
    count_levels(&o, counts);
    for (int level = 1; level <= 3; level++) assert_in_range(counts[level], 333, 334);
    assert_int_equal(counts[0], 0);
    o.coarse_until = 0;
    assert_int_equal(schedule_coarse_level(&o, 1), 0);
    o.coarse_until = 0.6, o.coarse_levels = 0;
    assert_int_equal(schedule_coarse_level(&o, 1), 0);
}

static void pictures_are_halved_as_long_as_their_sides_allow(void **state) {
    (void)state;
    TrainOptions o = published();
    o.coarse_levels = 2, o.coarse_least = 100;
    assert_int_equal(schedule_sizes(&o, 640, 426), 3);
    assert_int_equal(schedule_sizes(&o, 399, 640), 2);
    assert_int_equal(schedule_sizes(&o, 640, 199), 1);
    o.coarse_levels = 0;
    assert_int_equal(schedule_sizes(&o, 640, 426), 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(density_control_runs_from_600_to_14900_every_100),
        cmocka_unit_test(opacities_are_reset_every_3000_while_density_control_is_on),
        cmocka_unit_test(the_mean_rate_decays_log_linearly_from_start_to_end),
        cmocka_unit_test(one_sh_degree_more_every_1000_steps),
        cmocka_unit_test(every_epoch_sees_every_view_once_in_another_order),
        cmocka_unit_test(pictures_grow_in_equal_parts_until_coarse_until_and_are_whole_from_there),
        cmocka_unit_test(pictures_are_halved_as_long_as_their_sides_allow),
        cmocka_unit_test(a_resumed_run_sees_the_views_of_an_uninterrupted_one),
    };
    return cmocka_run_group_tests_name("schedule", tests, NULL, NULL);
}
