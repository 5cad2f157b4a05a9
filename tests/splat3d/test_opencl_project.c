// Every splat on the screen, as the kernel finds it, against the reference in double.

#include "splat3d/opencl_project.h"

#include "lab/base/mem.h"
#include "splat3d/frame_record.h"
#include "splat3d/reference.h"
#include "tests/support/random_scene.h"
#include "tests/support/support.h"

#include <math.h>

static int open_device(void **state) {
    Gpu *gpu;
    if (!gpu_open("", &gpu)) return -1;
    *state = gpu;
    return 0;
}

static int close_device(void **state) {
    gpu_close(*state);
    return 0;
}

typedef struct {
    FrameRecord frame;
    ScreenSplat *screen;
    TileBox *box;
    float *depth;
} Projected;

static bool is_vectorised; // the shape under test

static Projected project(Gpu *gpu, const Gaussians *model, const Camera *camera, const RenderSettings *settings) {
    const size_t n = (size_t)model->count;
    Projected p = {.screen = mem_alloc(n, sizeof(ScreenSplat)),
                   .box = mem_alloc(n, sizeof(TileBox)),
                   .depth = mem_alloc(n, sizeof(float))};
    OpenclProject kernel;
    DeviceGaussians device;
    assert_true(opencl_project_create(gpu, is_vectorised, &kernel));
    assert_true(device_gaussians_create(gpu, "model", 0, model->sh_degree, &device));
    assert_true(device_gaussians_write(&device, model));
    assert_true(frame_record_make(camera, settings, model->count, model->sh_degree, &p.frame));
    assert_true(opencl_project_forward(&kernel, &p.frame, &device));
    assert_true(gpu_buffer_read(kernel.screen, p.screen, n * sizeof *p.screen));
    assert_true(gpu_buffer_read(kernel.box, p.box, n * sizeof *p.box));
    assert_true(gpu_buffer_read(kernel.depth, p.depth, n * sizeof *p.depth));
    device_gaussians_destroy(&device);
    opencl_project_destroy(&kernel);
    return p;
}

static void projected_destroy(Projected *p) {
    mem_free(p->screen);
    mem_free(p->box);
    mem_free(p->depth);
}

// Numbers that grow with a splat's size are compared relative to it.
static void relative(double actual, double expected, double size, const char *what) {
    support_near(actual, expected, 2e-5 * fmax(fabs(expected), size), what);
}

static void check_splat(const ScreenSplat *actual, const Splat2 *expected) {
    const double minus_2_ln2 = -2 * M_LN2, conic_xx = minus_2_ln2 * actual->along_u;
    const double size = expected->conic.xx + expected->conic.yy;
    relative(actual->x, expected->mean_px[0], 100, "mean x");
    relative(actual->y, expected->mean_px[1], 100, "mean y");
    relative(conic_xx, expected->conic.xx, size, "conic xx");
    relative(conic_xx * actual->shear, expected->conic.xy, size, "conic xy");
    relative(conic_xx * actual->shear * actual->shear + minus_2_ln2 * actual->along_v, expected->conic.yy, size,
             "conic yy");
    relative(exp2(actual->log2_opacity), expected->opacity, 0, "opacity");
    relative(actual->half_width, expected->reach_px[0], 1, "half width");
    relative(actual->half_height, expected->reach_px[1], 1, "half height");
    relative(actual->r, expected->rgb[0], 1, "red");
    relative(actual->g, expected->rgb[1], 1, "green");
    relative(actual->b, expected->rgb[2], 1, "blue");
}

// Tiles of the pixels whose centres lie within the reach; a hair more is allowed for rounding.
static void check_range(int first, int end, double centre, double reach, int pixels) {
    for (int hair = -1; hair <= 1; hair += 2) {
        const double grown = reach + 0.02 * hair;
        const int low = (int)fmax(ceil(centre - grown - 0.5), 0),
                  high = (int)fmin(floor(centre + grown - 0.5), pixels - 1);
        if (low > high) continue;
        if (hair < 0) assert_true(first <= low / TILE_SIZE && end > high / TILE_SIZE);
        if (hair > 0) assert_true(first >= low / TILE_SIZE && end <= high / TILE_SIZE + 1);
    }
}

// Does the range certainly hold a pixel's centre? A splat between two rows of pixels counts as visible in the reference only.
static bool holds_centre(double centre, double reach, int pixels) {
    return fmax(ceil(centre - reach + 0.02 - 0.5), 0) <= fmin(floor(centre + reach - 0.02 - 0.5), pixels - 1);
}

static void splats_on_the_screen_agree_with_the_reference(void **state) {
    for (uint32_t seed = 1; seed <= 6; seed++) {
        print_message("seed %u\n", seed);
        RandomScene scene = random_scene_default(seed);
        const Camera camera = random_scene_camera(seed, 60 + 17 * (int)seed, 130 - 11 * (int)seed);
        RenderSettings settings = render_settings_default();
        scene.sh_degree = (int)seed % 4;
        scene.logit_low = -7; // some below ALPHA_MIN
        scene.outside = 2;
        if (seed == 5) settings.what = RENDER_DEPTH;
        Gaussians model = random_scene_gaussians(&scene, &camera);
        GaussiansD exact = gaussiansd_from(&model);
        Projected p = project(*state, &model, &camera, &settings);
        int visible = 0;
        for (int i = 0; i < model.count; i++) {
            Splat2 expected;
            reference_project_forward(&exact, i, &camera, &settings, &expected);
            const TileBox box = p.box[i];
            const bool is_visible = box.x0 < box.x1 && box.y0 < box.y1;
            if (is_visible) assert_true(expected.visible);
            if (!is_visible) {
                assert_int_equal(box.x0 | box.x1 | box.y0 | box.y1, 0);
                assert_false(expected.visible &&
                             holds_centre(expected.mean_px[0], expected.reach_px[0], camera.width) &&
                             holds_centre(expected.mean_px[1], expected.reach_px[1], camera.height));
                continue;
            }
            visible++;
            check_splat(&p.screen[i], &expected);
            relative(p.depth[i], expected.depth, 0, "depth");
            check_range(box.x0, box.x1, expected.mean_px[0], expected.reach_px[0], camera.width);
            check_range(box.y0, box.y1, expected.mean_px[1], expected.reach_px[1], camera.height);
        }
        assert_true(visible > 30 && visible < model.count - 30);
        projected_destroy(&p);
        gaussiansd_destroy(&exact);
        gaussians_destroy(&model);
    }
}

// 2000 px long, 0.55 px wide: in float, det Sigma' as xx yy - xy^2 would be noise here.
static void a_needle_keeps_its_width(void **state) {
    const Camera camera = camera_look_at(vec3(0, 0, 0), vec3(0, 0, 1), vec3(0, -1, 0), 1.0, 640, 480);
    const RenderSettings settings = render_settings_default();
    Gaussians model = gaussians_create(1, 0);
    gaussians_at(&model, FIELD_MEAN, 0)[2] = 2;
    const float log_scale[3] = {1.2f, -12, -12}, quat[4] = {0.9f, 0, 0, 0.4f};
    for (int k = 0; k < 3; k++) gaussians_at(&model, FIELD_LOG_SCALE, 0)[k] = log_scale[k];
    for (int k = 0; k < 4; k++) gaussians_at(&model, FIELD_QUAT, 0)[k] = quat[k];
    GaussiansD exact = gaussiansd_from(&model);
    Projected p = project(*state, &model, &camera, &settings);
    Splat2 expected;
    reference_project_forward(&exact, 0, &camera, &settings, &expected);
    assert_true(expected.visible && p.box[0].x0 < p.box[0].x1);
    support_near(-2 * M_LN2 * p.screen[0].along_u / expected.conic.xx, 1, 1e-5, "1 / variance across the needle");
    support_near(-2 * M_LN2 * p.screen[0].along_v * expected.covariance.yy, 1, 1e-5, "1 / variance along y");
    projected_destroy(&p);
    gaussiansd_destroy(&exact);
    gaussians_destroy(&model);
}

static int cpu_shape(void **state) {
    (void)state;
    is_vectorised = true;
    return 0;
}

static int gpu_shape(void **state) {
    (void)state;
    is_vectorised = false;
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(splats_on_the_screen_agree_with_the_reference, cpu_shape),
        cmocka_unit_test_setup(splats_on_the_screen_agree_with_the_reference, gpu_shape),
        cmocka_unit_test_setup(a_needle_keeps_its_width, cpu_shape),
        cmocka_unit_test_setup(a_needle_keeps_its_width, gpu_shape),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
