// Gradients by every parameter, of both blend shapes, against the double-precision reference.

#include "splat3d/opencl_rasterizer.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "splat3d/reference.h"
#include "tests/support/random_scene.h"
#include "tests/support/support.h"

#include <math.h>
#include <string.h>

// Measured over these scenes: relative L2 up to 9e-6 (needles: 3e-5), cosine 1 - 3e-11.
static const double RELATIVE_L2 = 1e-4, COSINE = 1 - 1e-8;
// Of single numbers: of their own size, and of the largest of the field.
static const double RELATIVE = 2e-3, FLOOR = 2e-5;

typedef struct {
    Gpu *gpu;
    OpenclRasterizer *shape[2]; // BLEND_CPU, BLEND_GPU
    Rasterizer *reference;
} Renderers;

static int create_renderers(void **state) {
    static Renderers r;
    *state = &r;
    if (!gpu_open("", &r.gpu) || !opencl_rasterizer_create(r.gpu, BLEND_CPU, &r.shape[0]) ||
        !opencl_rasterizer_create(r.gpu, BLEND_GPU, &r.shape[1])) {
        print_error("%s\n", fail_text());
        return -1;
    }
    r.reference = reference_rasterizer_create();
    return 0;
}

static int destroy_renderers(void **state) {
    Renderers *r = *state;
    opencl_rasterizer_destroy(r->shape[0]);
    opencl_rasterizer_destroy(r->shape[1]);
    rasterizer_destroy(r->reference);
    gpu_close(r->gpu);
    return 0;
}

static Gaussians backward(Rasterizer *rasterizer, const Gaussians *model, const Camera *camera,
                          const RenderSettings *settings, const ImageF *d_rgb) {
    Gaussians d_model;
    if (!rasterizer_backward(rasterizer, model, camera, settings, d_rgb, &d_model)) fail_msg("%s", fail_text());
    return d_model;
}

static void check_field(const float *actual, const float *expected, size_t count, const char *what) {
    double *a = mem_alloc(count, sizeof *a), *e = mem_alloc(count, sizeof *e), largest = 0;
    for (size_t k = 0; k < count; k++) {
        a[k] = actual[k], e[k] = expected[k];
        largest = fmax(largest, fabs(e[k]));
    }
    const double l2 = support_relative_l2(a, e, count), cosine = support_cosine(a, e, count);
    if (!(l2 <= RELATIVE_L2) || !(cosine >= COSINE))
        fail_msg("gradient by %s: relative L2 error %g, cosine 1 - %g", what, l2, 1 - cosine);
    for (size_t k = 0; k < count; k++)
        if (!(fabs(a[k] - e[k]) <= RELATIVE * fabs(e[k]) + FLOOR * largest))
            fail_msg("gradient by %s, number %zu: %g, expected %g (largest %g)", what, k, a[k], e[k], largest);
    mem_free(a);
    mem_free(e);
}

static void check_scene(Renderers *r, uint64_t seed, const Gaussians *model, const Camera *camera,
                        const RenderSettings *settings) {
    ImageF d_rgb = imagef_create(camera->width, camera->height, 3);
    random_scene_values(seed, d_rgb.values, (size_t)(camera->width * camera->height * 3));
    Gaussians expected = backward(r->reference, model, camera, settings, &d_rgb);
    for (int s = 0; s < 2; s++) {
        Gaussians actual = backward(opencl_rasterizer_interface(r->shape[s]), model, camera, settings, &d_rgb);
        for (int id = 0; id < FIELD_COUNT; id++) {
            char what[64];
            snprintf(what, sizeof what, "%s (%s shape)", GAUSSIAN_FIELDS[id].name, s ? "GPU" : "CPU");
            assert_int_equal(actual.field[id] != NULL, model->field[id] != NULL);
            if (model->field[id])
                check_field(actual.field[id], expected.field[id],
                            (size_t)model->count * (size_t)GAUSSIAN_FIELDS[id].width, what);
        }
        gaussians_destroy(&actual);
    }
    gaussians_destroy(&expected);
    imagef_destroy(&d_rgb);
}

static void gradients_of_any_size_and_degree_agree_with_the_reference(void **state) {
    static const int SIZES[][2] = {{64, 48}, {101, 77}, {17, 33}, {1, 1}, {31, 16}};
    for (uint32_t seed = 1; seed <= 5; seed++) {
        print_message("seed %u\n", seed);
        RandomScene scene = random_scene_default(seed);
        const Camera camera = random_scene_camera(seed, SIZES[seed - 1][0], SIZES[seed - 1][1]);
        RenderSettings settings = render_settings_default();
        scene.sh_degree = (int)seed % 4;
        settings.background[0] = 0.3f, settings.background[1] = 0.9f, settings.background[2] = 0.5f;
        Gaussians model = random_scene_gaussians(&scene, &camera);
        check_scene(*state, seed, &model, &camera, &settings);
        gaussians_destroy(&model);
    }
}

static void crowded_clamped_and_large_splats_have_the_reference_s_gradients(void **state) {
    for (uint32_t seed = 11; seed <= 13; seed++) {
        print_message("seed %u\n", seed);
        RandomScene scene = random_scene_default(seed);
        const Camera camera = random_scene_camera(seed, 50, 60);
        RenderSettings settings = render_settings_default();
        settings.background[2] = 1;
        scene.count = 1500;
        if (seed == 11) scene.logit_high = 12;                     // alphas at the clamp, opaque pixels
        if (seed == 12) scene.size_px = 60, scene.logit_high = -2; // long lists, everything seen
        if (seed == 13) scene.outside = 3, scene.size_px = 25;     // J clamped outside of the picture
        Gaussians model = random_scene_gaussians(&scene, &camera);
        check_scene(*state, seed, &model, &camera, &settings);
        gaussians_destroy(&model);
    }
}

static void a_depth_picture_s_gradient_goes_to_the_depth(void **state) {
    const RandomScene scene = random_scene_default(21);
    const Camera camera = random_scene_camera(21, 40, 50);
    RenderSettings settings = render_settings_default();
    settings.what = RENDER_DEPTH;
    Gaussians model = random_scene_gaussians(&scene, &camera);
    check_scene(*state, 21, &model, &camera, &settings);
    gaussians_destroy(&model);
}

static void needles_keep_exact_gradients(void **state) {
    RandomScene scene = random_scene_default(22);
    scene.count = 60;
    scene.outside = 1;
    const Camera camera = random_scene_camera(22, 80, 60);
    const RenderSettings settings = render_settings_default();
    Gaussians model = random_scene_gaussians(&scene, &camera);
    for (int i = 0; i < model.count; i++) { // thousands of pixels long, thinner than the low-pass
        float *log_scale = gaussians_at(&model, FIELD_LOG_SCALE, i);
        log_scale[i % 3] = 1, log_scale[(i + 1) % 3] = log_scale[(i + 2) % 3] = -7;
    }
    check_scene(*state, 22, &model, &camera, &settings);
    gaussians_destroy(&model);
}

static void fields_above_the_rendered_degree_are_left_alone(void **state) {
    Renderers *r = *state;
    const RandomScene scene = random_scene_default(31);
    const Camera camera = random_scene_camera(31, 40, 50);
    RenderSettings settings = render_settings_default();
    settings.sh_degree = 1;
    Gaussians model = random_scene_gaussians(&scene, &camera), marks = gaussians_create(scene.count, 3), after;
    for (int id = 0; id < FIELD_COUNT; id++)
        for (int k = 0; k < scene.count * GAUSSIAN_FIELDS[id].width; k++) marks.field[id][k] = 77;
    DeviceGaussians device, gradient;
    assert_true(device_gaussians_create(r->gpu, "model", 0, 3, &device));
    assert_true(device_gaussians_create(r->gpu, "gradient", 0, 3, &gradient));
    assert_true(device_gaussians_write(&device, &model) && device_gaussians_write(&gradient, &marks));
    assert_true(opencl_render(r->shape[0], &device, &camera, &settings));
    assert_true(opencl_backward(r->shape[0], &device, &gradient, NULL));
    assert_true(device_gaussians_read(&gradient, &after));
    for (int id = 0; id < FIELD_COUNT; id++)
        for (int k = 0; k < scene.count * GAUSSIAN_FIELDS[id].width; k++)
            assert_int_equal(after.field[id][k] == 77, GAUSSIAN_FIELDS[id].sh_degree > 1);
    gaussians_destroy(&model);
    gaussians_destroy(&marks);
    gaussians_destroy(&after);
    device_gaussians_destroy(&device);
    device_gaussians_destroy(&gradient);
}

// The same frame through the device's own interface, with a gradient picture; adds to the statistics.
static void backward_on_device(OpenclRasterizer *r, DeviceGaussians *model, DeviceGaussians *gradient,
                               const Camera *camera, const ImageF *d_rgb, DensityStatistics *statistics) {
    const RenderSettings settings = render_settings_default();
    void *mapped;
    assert_true(opencl_render(r, model, camera, &settings));
    const DevicePicture picture = opencl_picture(r);
    assert_true(gpu_buffer_map(picture.d_rgb, GPU_READ_WRITE, &mapped));
    float *d = mapped;
    for (int c = 0; c < 3; c++)
        for (int y = 0; y < picture.height; y++)
            for (int x = 0; x < picture.width; x++)
                d[(c * picture.rows + y) * picture.stride + x] = d_rgb->values[(y * picture.width + x) * 3 + c];
    assert_true(gpu_buffer_unmap(picture.d_rgb));
    assert_true(opencl_backward(r, model, gradient, statistics));
}

static void density_statistics_sum_screen_gradients_of_the_splats_in_view(void **state) {
    Renderers *r = *state;
    const RandomScene scene = random_scene_default(33);
    const Camera camera = random_scene_camera(33, 60, 44);
    const RenderSettings settings = render_settings_default();
    const int n = scene.count;
    Gaussians model = random_scene_gaussians(&scene, &camera);
    ImageF d_rgb = imagef_create(60, 44, 3);
    random_scene_values(33, d_rgb.values, 60 * 44 * 3);
    double *d_rgb_double = mem_alloc(60 * 44 * 3, sizeof *d_rgb_double);
    for (int k = 0; k < 60 * 44 * 3; k++) d_rgb_double[k] = d_rgb.values[k];

    GaussiansD exact = gaussiansd_from(&model);
    Splat2 *splats = mem_alloc((size_t)n, sizeof *splats);
    Splat2Gradient *d_splats = mem_alloc((size_t)n, sizeof *d_splats);
    for (int i = 0; i < n; i++) reference_project_forward(&exact, i, &camera, &settings, &splats[i]);
    reference_blend_backward(splats, n, &settings, 60, 44, d_rgb_double, d_splats);

    DeviceGaussians device, gradient;
    DensityStatistics statistics;
    assert_true(device_gaussians_create(r->gpu, "model", 0, 3, &device) && device_gaussians_write(&device, &model));
    assert_true(device_gaussians_create(r->gpu, "gradient", n, 3, &gradient));
    assert_true(gpu_buffer_create(r->gpu, "sum", (size_t)n * sizeof(float), &statistics.gradient_ndc));
    assert_true(gpu_buffer_create(r->gpu, "seen", (size_t)n * sizeof(int), &statistics.seen));
    backward_on_device(r->shape[0], &device, &gradient, &camera, &d_rgb, &statistics);
    backward_on_device(r->shape[1], &device, &gradient, &camera, &d_rgb, &statistics);

    float *sum = mem_alloc((size_t)n, sizeof *sum), *expected = mem_alloc((size_t)n, sizeof *expected);
    int *seen = mem_alloc((size_t)n, sizeof *seen), visible = 0;
    assert_true(gpu_buffer_read(statistics.gradient_ndc, sum, (size_t)n * sizeof *sum));
    assert_true(gpu_buffer_read(statistics.seen, seen, (size_t)n * sizeof *seen));
    for (int i = 0; i < n; i++) {
        assert_int_equal(seen[i], splats[i].visible ? 2 : 0);
        visible += splats[i].visible;
        expected[i] = (float)(2 * hypot(d_splats[i].mean_px[0] * 30, d_splats[i].mean_px[1] * 22));
    }
    assert_true(visible > n / 2 && visible < n);
    check_field(sum, expected, (size_t)n, "the mean on the screen, in units of half the picture");

    mem_free(sum), mem_free(expected), mem_free(seen);
    mem_free(splats), mem_free(d_splats), mem_free(d_rgb_double);
    gpu_buffer_destroy(statistics.gradient_ndc), gpu_buffer_destroy(statistics.seen);
    device_gaussians_destroy(&device), device_gaussians_destroy(&gradient);
    gaussiansd_destroy(&exact), gaussians_destroy(&model), imagef_destroy(&d_rgb);
}

static void a_smaller_picture_after_a_larger_one_has_no_gradient_in_its_padding(void **state) {
    Renderers *r = *state;
    const RandomScene scene = random_scene_default(35);
    const RenderSettings settings = render_settings_default();
    const Camera large = random_scene_camera(35, 64, 64), small = random_scene_camera(35, 50, 42);
    Gaussians model = random_scene_gaussians(&scene, &large);
    check_scene(r, 35, &model, &large, &settings);
    check_scene(r, 36, &model, &small, &settings);
    gaussians_destroy(&model);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gradients_of_any_size_and_degree_agree_with_the_reference),
        cmocka_unit_test(crowded_clamped_and_large_splats_have_the_reference_s_gradients),
        cmocka_unit_test(a_depth_picture_s_gradient_goes_to_the_depth),
        cmocka_unit_test(needles_keep_exact_gradients),
        cmocka_unit_test(fields_above_the_rendered_degree_are_left_alone),
        cmocka_unit_test(density_statistics_sum_screen_gradients_of_the_splats_in_view),
        cmocka_unit_test(a_smaller_picture_after_a_larger_one_has_no_gradient_in_its_padding),
    };
    return cmocka_run_group_tests(tests, create_renderers, destroy_renderers);
}
