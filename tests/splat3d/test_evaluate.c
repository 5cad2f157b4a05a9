#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/image_io.h"
#include "splat3d/evaluate.h"
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// ---- a renderer whose pictures are known: grey (value) over the settings' background, alpha 1 ----
typedef struct {
    Rasterizer base;
    float value;
    int renders, fails_at; // the render of that number fails
} FlatRasterizer;

static bool flat_render(Rasterizer *self, const Gaussians *model, const Camera *camera, const RenderSettings *settings,
                        Picture *picture) {
    FlatRasterizer *flat = (FlatRasterizer *)self;
    (void)model, (void)settings;
    if (flat->renders++ == flat->fails_at)
        return (fail)("no more pictures"); // in brackets: cmocka has a macro of that name
    *picture =
        (Picture){imagef_create(camera->width, camera->height, 3), imagef_create(camera->width, camera->height, 1)};
    for (int i = 0; i < 3 * camera->width * camera->height; i++) picture->rgb.values[i] = flat->value;
    return true;
}

static const RasterizerApi FLAT_API = {.name = "flat", .render = flat_render};

static FlatRasterizer flat_rasterizer(float value) {
    return (FlatRasterizer){.base = {&FLAT_API}, .value = value, .fails_at = -1};
}

enum { VIEWS = 5, WIDTH = 20, HEIGHT = 16 };

// Views "0".."4", held out where `held_out` has a bit; photographs are grey of 100 + view, with alpha 255 (or `alpha`).
static Dataset make_dataset(unsigned held_out, int channels, int alpha) {
    Dataset d = {.view_count = VIEWS, .downscale = 1};
    d.views = mem_alloc(VIEWS, sizeof *d.views);
    for (int v = 0; v < VIEWS; v++) {
        View *view = &d.views[v];
        view->name = mem_format("%d", v);
        view->path = mem_text("none");
        view->channels = channels;
        view->held_out = held_out >> v & 1;
        view->camera = (Camera){.width = WIDTH, .height = HEIGHT, .fx = 20, .fy = 20, .cx = 10, .cy = 8};
        view->image = image8_create(WIDTH, HEIGHT, channels);
        for (int i = 0; i < WIDTH * HEIGHT * channels; i++)
            view->image.bytes[i] = (uint8_t)(i % channels == 3 ? alpha : 100 + v);
    }
    return d;
}

static double psnr_of_difference(double difference) { return -20 * log10(fabs(difference)); }

static Evaluation evaluate(FlatRasterizer *flat, const Dataset *dataset, const RenderSettings *settings) {
    Evaluation e;
    const Gaussians model = {0};
    if (!evaluate_model(&flat->base, &model, dataset, settings, false, &e)) fail_msg("%s", fail_text());
    return e;
}

static void only_held_out_views_are_scored_and_the_means_are_theirs(void **state) {
    (void)state;
    Dataset d = make_dataset(1 << 1 | 1 << 4, 3, 255);
    FlatRasterizer flat = flat_rasterizer(0.5f);
    RenderSettings settings = render_settings_default();
    Evaluation e = evaluate(&flat, &d, &settings);
    assert_int_equal(e.count, 2);
    assert_int_equal(flat.renders, 2);
    assert_string_equal(e.views[0].name, "1");
    assert_string_equal(e.views[1].name, "4");
    double first = psnr_of_difference(0.5 - 101 / 255.0), second = psnr_of_difference(0.5 - 104 / 255.0);
    support_near(e.views[0].psnr, first, 1e-4, "PSNR of view 1");
    support_near(e.views[1].psnr, second, 1e-4, "PSNR of view 4");
    support_near(e.psnr, (first + second) / 2, 1e-4, "mean PSNR");
    support_near(e.ssim, (e.views[0].ssim + e.views[1].ssim) / 2, 1e-12, "mean SSIM");
    assert_true(e.ssim > 0 && e.ssim < 1);
    support_near(e.views[0].psnr8, psnr_of_difference((128 - 101) / 255.0), 1e-4, "PSNR of the rounded picture");
    evaluation_destroy(&e);
    evaluation_destroy(&e); // twice is harmless
    dataset_destroy(&d);
}

static void without_held_out_views_all_are_scored(void **state) {
    (void)state;
    Dataset d = make_dataset(0, 3, 255);
    FlatRasterizer flat = flat_rasterizer(102 / 255.0f);
    RenderSettings settings = render_settings_default();
    Evaluation e = evaluate(&flat, &d, &settings);
    assert_int_equal(e.count, VIEWS);
    support_near(e.views[2].psnr, 99, 0, "PSNR of an exact picture");
    support_near(e.views[2].ssim, 1, 1e-9, "SSIM of an exact picture");
    evaluation_destroy(&e);
    dataset_destroy(&d);
}

static void renders_are_clipped_before_they_are_compared(void **state) {
    (void)state;
    Dataset d = make_dataset(1, 3, 255);
    memset(d.views[0].image.bytes, 255, WIDTH * HEIGHT * 3);
    FlatRasterizer flat = flat_rasterizer(3);
    RenderSettings settings = render_settings_default();
    Evaluation e = evaluate(&flat, &d, &settings);
    support_near(e.psnr, 99, 0, "PSNR of an overexposed white");
    support_near(e.ssim, 1, 1e-9, "SSIM of an overexposed white");
    evaluation_destroy(&e);
    dataset_destroy(&d);
}

static void transparent_photographs_are_laid_over_the_background(void **state) {
    (void)state;
    Dataset d = make_dataset(1, 4, 51); // a fifth of 100 / 255, four fifths of the background
    RenderSettings settings = render_settings_default();
    settings.background[0] = settings.background[1] = settings.background[2] = 0.5f;
    FlatRasterizer flat = flat_rasterizer((float)(0.2 * 100 / 255 + 0.8 * 0.5));
    Evaluation e = evaluate(&flat, &d, &settings);
    assert_true(e.psnr > 90);
    evaluation_destroy(&e);
    dataset_destroy(&d);
}

static void a_photograph_that_is_not_in_memory_is_read_and_downscaled(void **state) {
    (void)state;
    Dataset d = make_dataset(1 << 3, 3, 255);
    Image8 large = image8_create(2 * WIDTH, 2 * HEIGHT, 3);
    memset(large.bytes, 77, 4 * WIDTH * HEIGHT * 3);
    const char *path = support_path(support_scratch(), "large.png");
    assert_true(image_save8(path, &large));
    image8_destroy(&large);
    mem_free(d.views[3].path);
    d.views[3].path = mem_text(path);
    image8_destroy(&d.views[3].image);
    d.downscale = 2;
    FlatRasterizer flat = flat_rasterizer(77 / 255.0f);
    RenderSettings settings = render_settings_default();
    Evaluation e = evaluate(&flat, &d, &settings);
    support_near(e.psnr, 99, 0, "PSNR");
    evaluation_destroy(&e);

    const Gaussians model = {0};
    d.downscale = 1; // now the picture is larger than its camera
    assert_false(evaluate_model(&flat.base, &model, &d, &settings, false, &e));
    assert_non_null(strstr(fail_text(), "40x32"));
    dataset_destroy(&d);
}

// A camera of COLMAP belongs to the pixels as they stand in the file, whatever its EXIF orientation says.
static void a_photograph_is_read_as_its_camera_saw_it(void **state) {
    (void)state;
    char *command = mem_format("command -v oiiotool > /dev/null && oiiotool --pattern constant:color=0,0,0 %dx%d 3 "
                               "-d uint8 --orientation 6 -o '%s/turned.tif'",
                               WIDTH, HEIGHT, support_scratch());
    bool made = system(command) == 0;
    mem_free(command);
    if (!made) {
        print_message("skipped: no oiiotool (Debian: openimageio-tools)\n");
        skip();
    }
    Dataset d = make_dataset(1 << 3, 3, 255);
    mem_free(d.views[3].path);
    d.views[3].path = mem_text(support_path(support_scratch(), "turned.tif"));
    d.views[3].as_stored = true;
    image8_destroy(&d.views[3].image);
    FlatRasterizer flat = flat_rasterizer(0);
    RenderSettings settings = render_settings_default();
    Evaluation e = evaluate(&flat, &d, &settings);
    support_near(e.psnr, 99, 0, "PSNR");
    evaluation_destroy(&e);
    dataset_destroy(&d);
}

static void a_render_that_fails_names_its_view(void **state) {
    (void)state;
    Dataset d = make_dataset(1 << 1 | 1 << 4, 3, 255);
    FlatRasterizer flat = flat_rasterizer(0);
    flat.fails_at = 1;
    RenderSettings settings = render_settings_default();
    const Gaussians model = {0};
    Evaluation e;
    ImageF sheet;
    assert_false(evaluate_model(&flat.base, &model, &d, &settings, false, &e));
    assert_string_equal(fail_text(), "view 4: no more pictures");
    assert_null(e.views);
    flat.renders = 0;
    assert_false(evaluate_contact_sheet(&flat.base, &model, &d, &settings, 5, &sheet));
    assert_null(sheet.values);
    dataset_destroy(&d);
}

static float at(const ImageF *image, int x, int y) { return image->values[(y * image->width + x) * 3]; }

static void the_contact_sheet_shows_photo_render_and_error(void **state) {
    (void)state;
    Dataset d = make_dataset(0x1f, 3, 255);
    FlatRasterizer flat = flat_rasterizer(0.5f);
    RenderSettings settings = render_settings_default();
    const Gaussians model = {0};
    ImageF sheet;
    assert_true(evaluate_contact_sheet(&flat.base, &model, &d, &settings, 2, &sheet));
    const int gap = 4, column = WIDTH + gap, row = HEIGHT + gap;
    assert_int_equal(sheet.width, 3 * WIDTH + 2 * gap);
    assert_int_equal(sheet.height, 2 * HEIGHT + gap);
    const int shown[] = {0, 2}; // spread over the five
    for (int i = 0; i < 2; i++) {
        float photo = (float)(100 + shown[i]) / 255;
        support_near(at(&sheet, WIDTH / 2, i * row + 1), photo, 1e-6, "photo");
        support_near(at(&sheet, column + WIDTH / 2, i * row + 1), 0.5, 1e-6, "render");
        support_near(at(&sheet, 2 * column + WIDTH / 2, i * row + 1), 4 * (0.5 - photo), 1e-5, "error");
    }
    assert_true(at(&sheet, WIDTH + 1, 1) == 1 && at(&sheet, 1, HEIGHT + 1) == 1); // gaps are white
    imagef_destroy(&sheet);
    dataset_destroy(&d);
}

static void the_protocol_is_stated(void **state) {
    (void)state;
    assert_non_null(strstr(EVALUATION_PROTOCOL, "PSNR"));
    assert_non_null(strstr(EVALUATION_PROTOCOL, "zero padded"));
    assert_null(strchr(EVALUATION_PROTOCOL, '\n'));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_held_out_views_are_scored_and_the_means_are_theirs),
        cmocka_unit_test(without_held_out_views_all_are_scored),
        cmocka_unit_test(renders_are_clipped_before_they_are_compared),
        cmocka_unit_test(transparent_photographs_are_laid_over_the_background),
        cmocka_unit_test(a_photograph_that_is_not_in_memory_is_read_and_downscaled),
        cmocka_unit_test(a_photograph_is_read_as_its_camera_saw_it),
        cmocka_unit_test(a_render_that_fails_names_its_view),
        cmocka_unit_test(the_contact_sheet_shows_photo_render_and_error),
        cmocka_unit_test(the_protocol_is_stated),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
