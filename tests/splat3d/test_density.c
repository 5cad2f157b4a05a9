#include "lab/base/rng.h"
#include "splat3d/density.h"
#include "tests/support/support.h"

#include <math.h>
#include <string.h>

static const double EXTENT = 2;

// N splats with distinct numbers everywhere, opaque, of scale 0.01 (small: 0.01 x extent is 0.02), no statistics.
static TrainingState splats(int count) {
    Gaussians g = gaussians_create(count, 1);
    for (int i = 0; i < count; i++) {
        for (GaussianFieldId f = 0; f < FIELD_COUNT; f++)
            for (int k = 0; g.field[f] && k < GAUSSIAN_FIELDS[f].width; k++)
                gaussians_at(&g, f, i)[k] = (float)(100 * i + 10 * (int)f + k);
        for (int a = 0; a < 3; a++) gaussians_at(&g, FIELD_LOG_SCALE, i)[a] = logf(0.01f);
        float quat[4] = {1, 0, 0, 0};
        memcpy(gaussians_at(&g, FIELD_QUAT, i), quat, sizeof quat);
        *gaussians_at(&g, FIELD_OPACITY_LOGIT, i) = 2;
    }
    TrainingState s = training_state_from_model(g);
    for (int i = 0; i < count; i++) *gaussians_at(&s.m, FIELD_OPACITY_LOGIT, i) = (float)(i + 1);
    return s;
}

static void make_hot(TrainingState *s, int i, float mean_gradient) {
    s->seen[i] = 4;
    s->gradient_sum[i] = 4 * mean_gradient;
}

static void set_scale(TrainingState *s, int i, double scale) {
    gaussians_at(&s->model, FIELD_LOG_SCALE, i)[1] = (float)log(scale);
}

static DensityChange control(TrainingState *s, bool prune_large) {
    TrainOptions o = train_options_default();
    return density_control(&o, 600, EXTENT, prune_large, s);
}

static void a_small_hot_splat_is_cloned_in_place(void **state) {
    (void)state;
    TrainingState s = splats(3);
    make_hot(&s, 1, 3e-4f);
    DensityChange c = control(&s, false);
    assert_int_equal(c.cloned, 1);
    assert_int_equal(c.split, 0);
    assert_int_equal(s.model.count, 4);
    for (GaussianFieldId f = 0; f <= FIELD_SH1; f++) // it follows its original
        assert_memory_equal(gaussians_at(&s.model, f, 2), gaussians_at(&s.model, f, 1),
                            (size_t)GAUSSIAN_FIELDS[f].width * 4);
    support_near(*gaussians_at(&s.m, FIELD_OPACITY_LOGIT, 1), 2, 0, "the original keeps its moments");
    support_near(*gaussians_at(&s.m, FIELD_OPACITY_LOGIT, 2), 0, 0, "the clone has none");
    assert_int_equal(s.id[1], 1);
    assert_int_equal(s.id[2], 3);
    assert_int_equal(s.id[3], 2);
    assert_int_equal(s.next_id, 4);
    assert_int_equal(s.seen[1], 0);
    training_state_destroy(&s);
}

static void a_large_hot_splat_is_replaced_by_two_smaller_children(void **state) {
    (void)state;
    TrainingState s = splats(3);
    make_hot(&s, 1, 3e-4f);
    set_scale(&s, 1, 0.5);
    DensityChange c = control(&s, false);
    assert_int_equal(c.split, 1);
    assert_int_equal(s.model.count, 4);
    assert_int_equal(s.id[0], 0);
    assert_int_equal(s.id[3], 2);
    for (int i = 1; i < 3; i++) { // in the place of their parent
        support_near(exp(gaussians_at(&s.model, FIELD_LOG_SCALE, i)[1]), 0.5 / 1.6, 1e-6, "scale of a child");
        assert_true(s.id[i] >= 3);
    }
    assert_memory_not_equal(gaussians_at(&s.model, FIELD_MEAN, 1), gaussians_at(&s.model, FIELD_MEAN, 2), 12);
    training_state_destroy(&s);
}

static void children_are_drawn_from_the_parent(void **state) {
    (void)state;
    enum { PARENTS = 2000 };
    const double scale[3] = {0.5, 0.1, 2};
    TrainingState s = splats(PARENTS);
    for (int i = 0; i < PARENTS; i++) {
        make_hot(&s, i, 1);
        for (int a = 0; a < 3; a++) {
            gaussians_at(&s.model, FIELD_MEAN, i)[a] = 0;
            gaussians_at(&s.model, FIELD_LOG_SCALE, i)[a] = (float)log(scale[a]);
        }
        float half = sqrtf(0.5f),
              turn[4] = {3 * half, 0, 0, 3 * half}; // 90 degrees about z, of length 3: x -> y, y -> -x
        memcpy(gaussians_at(&s.model, FIELD_QUAT, i), turn, sizeof turn);
    }
    control(&s, false);
    assert_int_equal(s.model.count, 2 * PARENTS);
    double square[3] = {0};
    for (int i = 0; i < s.model.count; i++)
        for (int a = 0; a < 3; a++) square[a] += pow(gaussians_at(&s.model, FIELD_MEAN, i)[a], 2) / s.model.count;
    // The variance of a variance over n normal draws is 2 sigma^4 / n: 5 standard deviations is 0.11 at n = 4000.
    support_near(square[0] / 0.01, 1, 0.12, "world x has the parent's own y");
    support_near(square[1] / 0.25, 1, 0.12, "world y has the parent's own x");
    support_near(square[2] / 4.00, 1, 0.12, "world z stays");
    training_state_destroy(&s);
}

static void the_gradient_is_the_mean_over_views_that_saw_the_splat(void **state) {
    (void)state;
    TrainingState s = splats(3);
    s.gradient_sum[0] = 3e-4f, s.seen[0] = 1; // 3e-4: grows
    s.gradient_sum[1] = 3e-4f, s.seen[1] = 2; // 1.5e-4: does not
    s.gradient_sum[2] = 0, s.seen[2] = 0;
    assert_int_equal(control(&s, false).cloned, 1);
    training_state_destroy(&s);
}

static void faint_splats_are_removed_and_huge_ones_after_the_first_reset(void **state) {
    (void)state;
    TrainingState s = splats(5);
    *gaussians_at(&s.model, FIELD_OPACITY_LOGIT, 0) = (float)log(0.004 / 0.996);
    *gaussians_at(&s.model, FIELD_OPACITY_LOGIT, 1) = (float)log(0.006 / 0.994);
    set_scale(&s, 2, 0.21); // 0.1 x extent is 0.2
    TrainingState late = splats(5);
    set_scale(&late, 2, 0.21);
    DensityChange early_change = control(&s, false), late_change = control(&late, true);
    assert_int_equal(early_change.pruned, 1);
    assert_int_equal(s.id[0], 1);
    assert_int_equal(late_change.pruned, 1);
    assert_int_equal(late.id[2], 3);
    training_state_destroy(&s);
    training_state_destroy(&late);
}

static void at_the_cap_the_steepest_grow(void **state) {
    (void)state;
    TrainOptions o = train_options_default();
    o.max_splats = 7;
    TrainingState s = splats(5);
    for (int i = 0; i < 5; i++) make_hot(&s, i, (float)(i == 3 ? 9 : i + 1));
    DensityChange c = density_control(&o, 600, EXTENT, false, &s);
    assert_int_equal(c.cloned, 2);
    assert_int_equal(s.model.count, 7);
    const uint32_t ids[] = {0, 1, 2, 3, 5, 4, 6};
    assert_memory_equal(s.id, ids, sizeof ids);
    assert_memory_equal(gaussians_at(&s.model, FIELD_MEAN, 4), gaussians_at(&s.model, FIELD_MEAN, 3), 12);
    assert_memory_equal(gaussians_at(&s.model, FIELD_MEAN, 6), gaussians_at(&s.model, FIELD_MEAN, 5), 12);
    training_state_destroy(&s);
}

static void the_model_comes_out_along_the_curve_through_space_with_all_that_belongs_to_a_splat(void **state) {
    (void)state;
    const float corner[4][3] = {{1, 1, 0}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}}; // the curve: 1, 3, 2, 0
    const uint32_t ids[] = {1, 3, 2, 0};
    TrainingState s = splats(4);
    for (int i = 0; i < 4; i++) memcpy(gaussians_at(&s.model, FIELD_MEAN, i), corner[i], sizeof corner[i]);
    control(&s, false);
    assert_memory_equal(s.id, ids, sizeof ids);
    for (int i = 0; i < 4; i++) {
        assert_memory_equal(gaussians_at(&s.model, FIELD_MEAN, i), corner[ids[i]], sizeof corner[0]);
        support_near(gaussians_at(&s.model, FIELD_SH1, i)[2], 100 * ids[i] + 10 * FIELD_SH1 + 2, 0, "its colour");
        support_near(*gaussians_at(&s.m, FIELD_OPACITY_LOGIT, i), ids[i] + 1, 0, "its moment");
    }
    training_state_destroy(&s);
}

static void a_reset_cuts_opacities_and_their_moments_only(void **state) {
    (void)state;
    TrainOptions o = train_options_default();
    TrainingState s = splats(2);
    *gaussians_at(&s.model, FIELD_OPACITY_LOGIT, 1) = -6;
    gaussians_at(&s.m, FIELD_MEAN, 0)[0] = 5;
    density_reset_opacity(&o, &s);
    support_near(1 / (1 + exp(-*gaussians_at(&s.model, FIELD_OPACITY_LOGIT, 0))), 0.01, 1e-6, "cut opacity");
    support_near(*gaussians_at(&s.model, FIELD_OPACITY_LOGIT, 1), -6, 0, "a fainter one stays");
    support_near(*gaussians_at(&s.m, FIELD_OPACITY_LOGIT, 0), 0, 0, "moment of the opacity");
    support_near(gaussians_at(&s.m, FIELD_MEAN, 0)[0], 5, 0, "other moments stay");
    training_state_destroy(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_small_hot_splat_is_cloned_in_place),
        cmocka_unit_test(a_large_hot_splat_is_replaced_by_two_smaller_children),
        cmocka_unit_test(children_are_drawn_from_the_parent),
        cmocka_unit_test(the_gradient_is_the_mean_over_views_that_saw_the_splat),
        cmocka_unit_test(faint_splats_are_removed_and_huge_ones_after_the_first_reset),
        cmocka_unit_test(at_the_cap_the_steepest_grow),
        cmocka_unit_test(the_model_comes_out_along_the_curve_through_space_with_all_that_belongs_to_a_splat),
        cmocka_unit_test(a_reset_cuts_opacities_and_their_moments_only),
    };
    return cmocka_run_group_tests_name("density", tests, NULL, NULL);
}
