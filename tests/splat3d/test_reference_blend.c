#include "splat3d/reference.h"

#include "lab/base/mem.h"
#include "lab/base/rng.h"
#include "tests/support/difference.h"
#include "tests/support/support.h"

#include <stdlib.h>
#include <string.h>

// Three tiles wide, two high, none of the edges at a multiple of the tile's size.
enum { WIDTH = 41, HEIGHT = 23, PIXELS = WIDTH * HEIGHT };

static Splat2 make_splat(double x, double y, Sym2 covariance, double depth, double opacity) {
    Splat2 s = {.visible = true, .mean_px = {x, y}, .depth = depth, .covariance = covariance, .opacity = opacity};
    s.rgb[0] = 0.9, s.rgb[1] = 0.5, s.rgb[2] = 0.2;
    assert_true(covariance_conic(covariance, &s.conic));
    double k = sqrt(2 * log(opacity / (double)ALPHA_MIN));
    covariance_box(covariance, k, &s.reach_px[0], &s.reach_px[1]);
    return s;
}

static Splat2 random_splat(Rng *rng) {
    double angle = rng_range(rng, 0, 3), a = rng_range(rng, 0.7, 9), b = rng_range(rng, 0.7, 4);
    double x = rng_range(rng, -5, WIDTH + 5), y = rng_range(rng, -5, HEIGHT + 5);
    double depth = rng_range(rng, 1, 9), opacity = rng_range(rng, 0.1, 1);
    Splat2 s = make_splat(x, y, covariance_from_angle(angle, a, b), depth, opacity);
    for (int c = 0; c < 3; c++) s.rgb[c] = rng_uniform(rng);
    return s;
}

static RenderSettings settings_with_background(void) {
    RenderSettings settings = render_settings_default();
    settings.background[0] = 0.25f, settings.background[1] = 0.5f, settings.background[2] = 1;
    return settings;
}

static PictureD blend(const Splat2 *splats, int count, const RenderSettings *settings) {
    PictureD picture = pictured_create(WIDTH, HEIGHT);
    reference_blend_forward(splats, count, settings, &picture);
    return picture;
}

// ---- forward ----

static void no_splat_leaves_the_background(void **state) {
    (void)state;
    RenderSettings settings = settings_with_background();
    Splat2 hidden = make_splat(20, 10, (Sym2){9, 0, 9}, 2, 1);
    hidden.visible = false;
    PictureD picture = blend(&hidden, 1, &settings);
    for (int i = 0; i < PIXELS; i++) {
        for (int c = 0; c < 3; c++)
            support_near(picture.rgb[3 * i + c], (double)settings.background[c], 0, "background");
        support_near(picture.transmittance[i], 1, 0, "T");
    }
    pictured_destroy(&picture);
}

static void pixel_centres_are_at_half_and_alpha_is_the_gaussian(void **state) {
    (void)state;
    RenderSettings settings = settings_with_background();
    Splat2 splat = make_splat(20.5, 10.5, (Sym2){4, 0, 9}, 2, 0.8);
    PictureD picture = blend(&splat, 1, &settings);
    support_near(picture.transmittance[10 * WIDTH + 20], 0.2, 1e-15, "at the mean");
    support_near(picture.transmittance[10 * WIDTH + 22], 1 - 0.8 * exp(-0.5), 1e-15, "one sigma to the right");
    support_near(picture.transmittance[4 * WIDTH + 20], 1 - 0.8 * exp(-2), 1e-15, "two sigma up");
    support_near(picture.rgb[3 * (10 * WIDTH + 20)], 0.8 * 0.9 + 0.2 * 0.25, 1e-15, "red over the background");
    support_near(picture.transmittance[10 * WIDTH + 28], 1, 0, "four sigma: below ALPHA_MIN");
    pictured_destroy(&picture);
}

static void the_nearer_splat_covers_and_of_equals_the_first(void **state) {
    (void)state;
    RenderSettings settings = render_settings_default();
    Splat2 pair[2] = {make_splat(20.5, 10.5, (Sym2){9, 0, 9}, 3, 0.9), make_splat(20.5, 10.5, (Sym2){9, 0, 9}, 2, 0.9)};
    size_t centre = 3 * (10 * WIDTH + 20);
    memcpy(pair[1].rgb, (double[3]){0, 0, 1}, sizeof pair[1].rgb);
    PictureD picture = blend(pair, 2, &settings);
    support_near(picture.rgb[centre + 2], 0.9 + 0.1 * 0.9 * 0.2, 1e-15, "blue is nearer");
    pictured_destroy(&picture);
    pair[1].depth = 3;
    picture = blend(pair, 2, &settings);
    support_near(picture.rgb[centre], 0.9 * 0.9, 1e-15, "equal depth: index 0 first");
    pictured_destroy(&picture);
}

// Every splat at every pixel, in an order found by looking for the next one again and again.
static void blend_without_tiles(const Splat2 *splats, int count, const RenderSettings *settings, PictureD *picture) {
    CompositeRule rule = composite_rule_default();
    rule.rule = settings->stop_rule;
    for (int i = 0; i < PIXELS; i++) {
        Composite pixel = composite_begin();
        double last = 0;
        for (int n = 0; n < count; n++) {
            int next = -1;
            for (int k = 0; k < count; k++)
                if (splats[k].depth > last && (next < 0 || splats[k].depth < splats[next].depth)) next = k;
            const Splat2 *s = &splats[next];
            last = s->depth;
            double dx = i % WIDTH + 0.5 - s->mean_px[0], dy = i / WIDTH + 0.5 - s->mean_px[1];
            composite_blend(&pixel, &rule, s->opacity * exp(-conic_mahalanobis2(s->conic, dx, dy) / 2), s->rgb);
        }
        const double background[3] = {0.25, 0.5, 1};
        composite_end(&pixel, background);
        memcpy(picture->rgb + 3 * i, pixel.rgb, sizeof pixel.rgb);
        picture->transmittance[i] = pixel.transmittance;
    }
}

static void tiles_change_nothing(void **state) {
    (void)state;
    enum { COUNT = 40 };
    RenderSettings settings = settings_with_background();
    for (uint32_t seed = 1; seed <= 10; seed++) {
        Rng rng = rng_at(seed, RNG_TEST, 0, 0);
        Splat2 splats[COUNT];
        for (int i = 0; i < COUNT; i++) splats[i] = random_splat(&rng);
        settings.stop_rule = seed % 2 ? STOP_AFTER_BLEND : STOP_BEFORE_BLEND;
        PictureD picture = blend(splats, COUNT, &settings), expected = pictured_create(WIDTH, HEIGHT);
        blend_without_tiles(splats, COUNT, &settings, &expected);
        char name[32];
        snprintf(name, sizeof name, "seed %u", seed);
        for (int i = 0; i < 3 * PIXELS; i++) support_near(picture.rgb[i], expected.rgb[i], 0, name);
        for (int i = 0; i < PIXELS; i++) support_near(picture.transmittance[i], expected.transmittance[i], 0, name);
        pictured_destroy(&picture);
        pictured_destroy(&expected);
    }
}

static void the_stop_rules_differ_in_what_they_leave_unseen(void **state) {
    (void)state;
    enum { COUNT = 6 };
    RenderSettings settings = render_settings_default();
    Splat2 stack[COUNT];
    for (int i = 0; i < COUNT; i++) stack[i] = make_splat(20.5, 10.5, (Sym2){900, 0, 900}, 1 + i, 0.95);
    int centre = 10 * WIDTH + 20;
    PictureD after = blend(stack, COUNT, &settings);
    settings.stop_rule = STOP_BEFORE_BLEND;
    PictureD before = blend(stack, COUNT, &settings);
    support_near(before.transmittance[centre], pow(0.05, 3), 1e-18, "three splats: the fourth would go below 1e-4");
    support_near(after.transmittance[centre], pow(0.05, 4), 1e-18, "four");
    pictured_destroy(&after);
    pictured_destroy(&before);
}

// ---- backward ----

enum { SPLATS = 16 };

// The loss is weight . rgb.
typedef struct {
    Splat2 splats[SPLATS];
    RenderSettings settings;
    double weight[3 * PIXELS];
} Scene;

static double weighted_picture(void *context) {
    const Scene *scene = context;
    PictureD picture = blend(scene->splats, SPLATS, &scene->settings);
    double sum = 0;
    for (int k = 0; k < 3 * PIXELS; k++) sum += scene->weight[k] * picture.rgb[k];
    pictured_destroy(&picture);
    return sum;
}

// Does the splat's alpha keep 0.5 % away from ALPHA_MIN and alpha_max at each pixel, where differences mean nothing?
static bool is_clear_of_kinks(const Splat2 *s, double alpha_max) {
    for (int i = 0; i < PIXELS; i++) {
        double dx = i % WIDTH + 0.5 - s->mean_px[0], dy = i / WIDTH + 0.5 - s->mean_px[1];
        double alpha = s->opacity * exp(-conic_mahalanobis2(s->conic, dx, dy) / 2);
        if (fabs(alpha / (double)ALPHA_MIN - 1) < 5e-3 || fabs(alpha / alpha_max - 1) < 5e-3) return false;
    }
    return true;
}

static void check_backward(uint32_t seed, StopRule stop_rule, float alpha_max) {
    Scene scene = {.settings = settings_with_background()};
    scene.settings.stop_rule = stop_rule;
    scene.settings.alpha_max = alpha_max;
    Rng rng = rng_at(seed, RNG_TEST, 0, 0);
    for (int i = 0; i < SPLATS; i++) do
            scene.splats[i] = random_splat(&rng);
        while (!is_clear_of_kinks(&scene.splats[i], (double)alpha_max));
    for (int k = 0; k < 3 * PIXELS; k++) scene.weight[k] = rng_normal(&rng);

    Splat2Gradient d[SPLATS] = {0};
    reference_blend_backward(scene.splats, SPLATS, &scene.settings, WIDTH, HEIGHT, scene.weight, d);
    for (int i = 0; i < SPLATS; i++) {
        Splat2 *s = &scene.splats[i];
        double *numbers[] = {&s->mean_px[0], &s->mean_px[1], &s->conic.xx, &s->conic.xy, &s->conic.yy,
                             &s->opacity,    &s->rgb[0],     &s->rgb[1],   &s->rgb[2]};
        double actual[] = {d[i].mean_px[0], d[i].mean_px[1], d[i].conic.xx, d[i].conic.xy, d[i].conic.yy,
                           d[i].opacity,    d[i].rgb[0],     d[i].rgb[1],   d[i].rgb[2]};
        double expected[9];
        for (int k = 0; k < 9; k++) expected[k] = difference_central(numbers[k], 1e-6, weighted_picture, &scene);
        char what[64];
        snprintf(what, sizeof what, "seed %u, splat %d", seed, i);
        difference_compare(9, actual, expected, 1e-6, 1e-7, what);
    }
}

static void every_gradient_agrees_with_central_differences(void **state) {
    (void)state;
    check_backward(1, STOP_AFTER_BLEND, ALPHA_MAX);
    check_backward(2, STOP_BEFORE_BLEND, ALPHA_MAX);
    check_backward(3, STOP_AFTER_BLEND, 0.4f); // much is clamped
}

static void a_clamped_alpha_has_no_gradient_but_its_colour_has(void **state) {
    (void)state;
    RenderSettings settings = settings_with_background();
    Splat2 splat = make_splat(20.5, 10.5, (Sym2){9, 0, 9}, 2, 0.995);
    double *d_rgb = mem_alloc(3 * PIXELS, sizeof(double));
    d_rgb[3 * (10 * WIDTH + 20)] = 1; // red of the pixel at the mean
    Splat2Gradient d = {0};
    reference_blend_backward(&splat, 1, &settings, WIDTH, HEIGHT, d_rgb, &d);
    support_near(d.opacity, 0, 0, "opacity");
    support_near(d.conic.xx, 0, 0, "conic");
    support_near(d.rgb[0], (double)ALPHA_MAX, 1e-15, "red");
    support_near(d.rgb[1], 0, 0, "green");
    mem_free(d_rgb);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_splat_leaves_the_background),
        cmocka_unit_test(pixel_centres_are_at_half_and_alpha_is_the_gaussian),
        cmocka_unit_test(the_nearer_splat_covers_and_of_equals_the_first),
        cmocka_unit_test(tiles_change_nothing),
        cmocka_unit_test(the_stop_rules_differ_in_what_they_leave_unseen),
        cmocka_unit_test(every_gradient_agrees_with_central_differences),
        cmocka_unit_test(a_clamped_alpha_has_no_gradient_but_its_colour_has),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
