#include "splat2d/compositing.h"

#include "lab/base/rng.h"
#include "tests/support/support.h"

#include <math.h>

enum { SEEDS = 200, LAYERS = 12 };

typedef struct {
    double alpha, rgb[3];
} Layer;

static void random_layers(uint32_t seed, double alpha_low, double alpha_high, Layer layers[LAYERS]) {
    Rng rng = rng_at(seed, RNG_TEST, 0, 0);
    for (int i = 0; i < LAYERS; i++) {
        layers[i].alpha = rng_range(&rng, alpha_low, alpha_high);
        for (int c = 0; c < 3; c++) layers[i].rgb[c] = rng_uniform(&rng);
    }
}

static Composite blend_all(const CompositeRule *rule, const Layer layers[LAYERS], const double background[3],
                           double *sum_of_weights) {
    Composite pixel = composite_begin();
    *sum_of_weights = 0;
    for (int i = 0; i < LAYERS; i++) *sum_of_weights += composite_blend(&pixel, rule, layers[i].alpha, layers[i].rgb);
    composite_end(&pixel, background);
    return pixel;
}

// The other way to say the same: lay each layer over what is behind it, from the back.
static void over_from_the_back(const Layer layers[LAYERS], const double background[3], long double rgb[3]) {
    for (int c = 0; c < 3; c++) rgb[c] = background[c];
    for (int i = LAYERS - 1; i >= 0; i--)
        for (int c = 0; c < 3; c++)
            rgb[c] = layers[i].alpha * (long double)layers[i].rgb[c] + (1 - (long double)layers[i].alpha) * rgb[c];
}

static void front_to_back_is_over_from_the_back(void **state) {
    (void)state;
    CompositeRule rule = composite_rule_default();
    const double background[3] = {0.2, 0.5, 0.9};
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        char name[32];
        snprintf(name, sizeof name, "seed %u", seed);
        Layer layers[LAYERS];
        random_layers(seed, 0.01, 0.5, layers); // 0.5^12 > stop: no pixel becomes opaque
        double weights;
        Composite pixel = blend_all(&rule, layers, background, &weights);
        long double rgb[3];
        over_from_the_back(layers, background, rgb);
        for (int c = 0; c < 3; c++) support_near(pixel.rgb[c], (double)rgb[c], 1e-14, name);
        support_near(weights + pixel.transmittance, 1, 1e-14, name);
    }
}

static void the_order_matters(void **state) {
    (void)state;
    CompositeRule rule = composite_rule_default();
    const double red[3] = {1, 0, 0}, blue[3] = {0, 0, 1};
    Composite red_first = composite_begin(), blue_first = composite_begin();
    composite_blend(&red_first, &rule, 0.8, red);
    composite_blend(&red_first, &rule, 0.8, blue);
    composite_blend(&blue_first, &rule, 0.8, blue);
    composite_blend(&blue_first, &rule, 0.8, red);
    support_near(red_first.rgb[0], 0.8, 1e-15, "red in front");
    support_near(blue_first.rgb[0], 0.16, 1e-15, "red behind");
    support_near(red_first.transmittance, blue_first.transmittance, 1e-15, "T knows no order");
}

static void a_faint_splat_is_skipped_and_a_solid_one_is_clamped(void **state) {
    (void)state;
    CompositeRule rule = {.alpha_max = 0.9, .alpha_min = 0.1, .stop = 1e-4, .rule = STOP_AFTER_BLEND};
    const double white[3] = {1, 1, 1};
    Composite pixel = composite_begin();
    support_near(composite_blend(&pixel, &rule, 0.0999, white), 0, 0, "faint");
    support_near(pixel.transmittance, 1, 0, "T after the faint one");
    support_near(composite_blend(&pixel, &rule, 1, white), 0.9, 1e-15, "solid");
    support_near(pixel.transmittance, 0.1, 1e-15, "T after the solid one");
    support_near(composite_blend(&pixel, &rule, 0.1, white), 0.01, 1e-15, "just enough");
}

// How much of the background is left in the picture when a pixel became opaque.
static double unseen(StopRule stop_rule, const Layer layers[LAYERS]) {
    CompositeRule rule = composite_rule_default();
    rule.rule = stop_rule;
    const double background[3] = {0, 0, 0};
    double weights;
    Composite pixel = blend_all(&rule, layers, background, &weights);
    assert_true(pixel.opaque);
    support_near(weights + pixel.transmittance, 1, 1e-14, "sum of weights and T");
    return pixel.transmittance;
}

static void each_stop_rule_keeps_its_bound(void **state) {
    (void)state;
    CompositeRule rule = composite_rule_default();
    double largest_before = 0;
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        Layer layers[LAYERS];
        random_layers(seed, 0.7, 1, layers);
        assert_true(unseen(STOP_AFTER_BLEND, layers) < rule.stop);
        double before = unseen(STOP_BEFORE_BLEND, layers);
        assert_true(before >= rule.stop && before <= rule.stop / (1 - rule.alpha_max));
        largest_before = fmax(largest_before, before);
    }
    assert_true(largest_before > 10 * rule.stop); // the bound of the second rule is no pessimism
}

static void nothing_is_blended_behind_an_opaque_pixel(void **state) {
    (void)state;
    const StopRule rules[] = {STOP_AFTER_BLEND, STOP_BEFORE_BLEND};
    const double white[3] = {1, 1, 1};
    for (int r = 0; r < 2; r++) {
        CompositeRule rule = {.alpha_max = 1, .alpha_min = 0, .stop = 0.2, .rule = rules[r]};
        Composite pixel = composite_begin();
        composite_blend(&pixel, &rule, 0.5, white);
        assert_false(pixel.opaque);
        double weight = composite_blend(&pixel, &rule, 0.8, white); // T would fall from 0.5 to 0.1
        assert_true(pixel.opaque);
        support_near(weight, rules[r] == STOP_AFTER_BLEND ? 0.4 : 0, 1e-15, "the splat that makes it opaque");
        Composite before = pixel;
        support_near(composite_blend(&pixel, &rule, 0.01, white), 0, 0, "behind");
        assert_memory_equal(&before.rgb, &pixel.rgb, sizeof pixel.rgb);
        support_near(pixel.transmittance, before.transmittance, 0, "T behind");
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(front_to_back_is_over_from_the_back),
        cmocka_unit_test(the_order_matters),
        cmocka_unit_test(a_faint_splat_is_skipped_and_a_solid_one_is_clamped),
        cmocka_unit_test(each_stop_rule_keeps_its_bound),
        cmocka_unit_test(nothing_is_blended_behind_an_opaque_pixel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
