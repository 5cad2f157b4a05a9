#include "lab/app/frame.h"
#include "tests/support/support.h"

#include <stdbool.h>
#include <string.h>

// A renderer whose sums are known: one column per pixel of `sums` and `alphas`; notes the settings it was given.
enum { PIXELS = 3 };
static const float SUMS[PIXELS][3] = {{0.2f, 0.1f, 0}, {0, 0, 0}, {2, 0.5f, 0.25f}};
static const float ALPHAS[PIXELS] = {0.5f, 0, 1};
static RenderSettings last_settings;

static bool known_render(Rasterizer *self, const Gaussians *model, const Camera *camera, const RenderSettings *settings,
                         Picture *picture) {
    (void)self, (void)model, (void)camera;
    last_settings = *settings;
    *picture = (Picture){imagef_create(PIXELS, 1, 3), imagef_create(PIXELS, 1, 1)};
    memcpy(picture->rgb.values, SUMS, sizeof SUMS);
    memcpy(picture->alpha.values, ALPHAS, sizeof ALPHAS);
    return true;
}

static const RasterizerApi API = {.name = "known", .render = known_render};

static ImageF render(FrameKind kind) {
    Rasterizer known = {&API};
    const Gaussians model = {0};
    const Camera camera = {.width = PIXELS, .height = 1};
    RenderSettings settings = render_settings_default();
    settings.background[1] = 0.5f;
    ImageF image;
    assert_true(frame_render(&known, &model, &camera, &settings, kind, &image));
    return image;
}

static void colour_is_handed_on(void **state) {
    (void)state;
    ImageF image = render(FRAME_COLOUR);
    assert_int_equal(image.channels, 3);
    assert_memory_equal(image.values, SUMS, sizeof SUMS);
    assert_true(last_settings.background[1] == 0.5f);
    imagef_destroy(&image);
}

static void alpha_is_straight_and_without_background(void **state) {
    (void)state;
    ImageF image = render(FRAME_ALPHA);
    assert_int_equal(image.channels, 4);
    const float expected[] = {0.4f, 0.2f, 0, 0.5f, 0, 0, 0, 0, 2, 0.5f, 0.25f, 1};
    for (int i = 0; i < 12; i++) support_near(image.values[i], expected[i], 1e-6, "value");
    assert_true(last_settings.background[1] == 0);
    imagef_destroy(&image);
}

static void depth_is_the_mean_over_what_is_seen(void **state) {
    (void)state;
    ImageF image = render(FRAME_DEPTH);
    assert_int_equal(last_settings.what, RENDER_DEPTH);
    assert_int_equal(image.channels, 1);
    const float expected[] = {2, 0, 4}; // sum of w z by sum of w; the middle pixel sees nothing
    for (int i = 0; i < 3; i++) support_near(image.values[i], expected[i], 1e-6, "depth");
    frame_normalise_depth(&image);
    const float shown[] = {1, 0, 0.1f};
    for (int i = 0; i < 3; i++) support_near(image.values[i], shown[i], 1e-6, "grey");
    imagef_destroy(&image);
}

static void equal_depths_are_all_near(void **state) {
    (void)state;
    ImageF image = imagef_create(2, 1, 1);
    image.values[0] = image.values[1] = 5;
    frame_normalise_depth(&image);
    assert_true(image.values[0] == 1 && image.values[1] == 1);
    imagef_destroy(&image);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(colour_is_handed_on),
        cmocka_unit_test(alpha_is_straight_and_without_background),
        cmocka_unit_test(depth_is_the_mean_over_what_is_seen),
        cmocka_unit_test(equal_depths_are_all_near),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
