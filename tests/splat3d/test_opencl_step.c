// The step that a CPU device takes in one kernel, against the two kernels that it stands for: the same bits.

#include "splat3d/opencl_rasterizer.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "tests/support/random_scene.h"
#include "tests/support/support.h"

#include <math.h>
#include <string.h>

enum { WIDTH = 90, HEIGHT = 70 };

static const float RATES[FIELD_COUNT] = {1.6e-4f, 5e-3f, 1e-3f, 5e-2f, 2.5e-3f, 1.25e-4f, 1.25e-4f, 1.25e-4f};

// A model in training, twice; the rasterizer has the CPU's shape.
typedef struct {
    Gpu *gpu;
    OpenclRasterizer *rasterizer;
    struct {
        OpenclAdam *adam;
        DeviceGaussians model, m, v;
        DensityStatistics statistics;
    } way[2]; // one kernel after the other, and both at once
    DeviceGaussians gradient;
} Training;

static void begin(Training *t, const Gaussians *model, bool only_in_view) {
    const size_t n = (size_t)model->count;
    if (!gpu_open("cpu", &t->gpu) || !opencl_rasterizer_create(t->gpu, BLEND_CPU, &t->rasterizer) ||
        !device_gaussians_create(t->gpu, "gradient", model->count, 3, &t->gradient))
        fail_msg("%s", fail_text());
    for (int k = 0; k < 2; k++)
        if (!opencl_adam_create(t->gpu, only_in_view, &t->way[k].adam) ||
            !device_gaussians_create(t->gpu, "model", model->count, 3, &t->way[k].model) ||
            !device_gaussians_create(t->gpu, "m", model->count, 3, &t->way[k].m) ||
            !device_gaussians_create(t->gpu, "v", model->count, 3, &t->way[k].v) ||
            !device_gaussians_write(&t->way[k].model, model) ||
            !gpu_buffer_create(t->gpu, "sum", n * sizeof(float), &t->way[k].statistics.gradient_ndc) ||
            !gpu_buffer_create(t->gpu, "seen", n * sizeof(int), &t->way[k].statistics.seen))
            fail_msg("%s", fail_text());
}

static void end(Training *t) {
    for (int k = 0; k < 2; k++) {
        opencl_adam_destroy(t->way[k].adam);
        device_gaussians_destroy(&t->way[k].model);
        device_gaussians_destroy(&t->way[k].m);
        device_gaussians_destroy(&t->way[k].v);
        gpu_buffer_destroy(t->way[k].statistics.gradient_ndc);
        gpu_buffer_destroy(t->way[k].statistics.seen);
    }
    device_gaussians_destroy(&t->gradient);
    opencl_rasterizer_destroy(t->rasterizer);
    gpu_close(t->gpu);
}

// A gradient picture; `broken` is put into its middle.
static void write_d_rgb(const Training *t, uint32_t seed, float broken) {
    static float values[3 * WIDTH * HEIGHT];
    const DevicePicture picture = opencl_picture(t->rasterizer);
    void *mapped;
    random_scene_values(seed, values, 3 * WIDTH * HEIGHT);
    assert_true(gpu_buffer_map(picture.d_rgb, GPU_READ_WRITE, &mapped));
    float *d = mapped;
    for (int c = 0; c < 3; c++)
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++)
                d[(c * picture.rows + y) * picture.stride + x] = values[(c * HEIGHT + y) * WIDTH + x];
    d[HEIGHT / 2 * picture.stride + WIDTH / 2] += broken;
    assert_true(gpu_buffer_unmap(picture.d_rgb));
}

// Step number `step` (1 is the first) by either way. broken: 0, or a number that the gradient picture gets in its middle.
static void both_step(Training *t, int step, const Camera *camera, int active_degree, float broken) {
    RenderSettings settings = render_settings_default();
    settings.sh_degree = active_degree;
    for (int k = 0; k < 2; k++) {
        DeviceGaussians *model = &t->way[k].model, *m = &t->way[k].m, *v = &t->way[k].v;
        const DensityStatistics *statistics = step == 2 ? NULL : &t->way[k].statistics;
        bool done = opencl_render(t->rasterizer, model, camera, &settings);
        if (done) write_d_rgb(t, 40 + (uint32_t)step, broken);
        if (k == 0)
            done = done && opencl_backward(t->rasterizer, model, &t->gradient, statistics) &&
                   opencl_adam_step(t->way[k].adam, step, RATES, active_degree, opencl_boxes(t->rasterizer),
                                    &t->gradient, model, m, v);
        else
            done = done && opencl_backward_step(t->rasterizer, t->way[k].adam, step, RATES, model, m, v, statistics);
        if (!done) fail_msg("%s", fail_text());
    }
}

static void expect_same_numbers(const DeviceGaussians *one, const DeviceGaussians *other, const char *what) {
    Gaussians a, b;
    assert_true(device_gaussians_read(one, &a) && device_gaussians_read(other, &b));
    for (int id = 0; id < FIELD_COUNT; id++)
        for (int k = 0; k < a.count * GAUSSIAN_FIELDS[id].width; k++)
            if (memcmp(&a.field[id][k], &b.field[id][k], sizeof(float)))
                fail_msg("%s %s of splat %d: %.9g by two kernels, %.9g by one", what, GAUSSIAN_FIELDS[id].name,
                         k / GAUSSIAN_FIELDS[id].width, (double)a.field[id][k], (double)b.field[id][k]);
    gaussians_destroy(&a);
    gaussians_destroy(&b);
}

static void expect_same_bytes(GpuBuffer *one, GpuBuffer *other) {
    const size_t bytes = gpu_buffer_bytes(one);
    void *a = mem_alloc(bytes, 1), *b = mem_alloc(bytes, 1);
    assert_true(gpu_buffer_read(one, a, bytes) && gpu_buffer_read(other, b, bytes));
    assert_memory_equal(a, b, bytes);
    mem_free(a);
    mem_free(b);
}

static void expect_same(const Training *t) {
    expect_same_numbers(&t->way[0].model, &t->way[1].model, "parameter");
    expect_same_numbers(&t->way[0].m, &t->way[1].m, "first moment of");
    expect_same_numbers(&t->way[0].v, &t->way[1].v, "second moment of");
    expect_same_bytes(t->way[0].statistics.gradient_ndc, t->way[1].statistics.gradient_ndc);
    expect_same_bytes(t->way[0].statistics.seen, t->way[1].statistics.seen);
}

// The splat that a step noted, the same by both ways; -1 for none.
static int noted_splat(const Training *t) {
    int splat[2];
    GaussianFieldId field[2];
    for (int k = 0; k < 2; k++) assert_true(opencl_adam_check(t->way[k].adam, &splat[k], &field[k]));
    assert_int_equal(splat[0], splat[1]);
    assert_int_equal(field[0], field[1]);
    return splat[0];
}

static Gaussians scene_of(int count, const Camera *camera) {
    RandomScene scene = random_scene_default(51);
    scene.count = count;
    return random_scene_gaussians(&scene, camera);
}

// The camera, looking a third of its picture aside.
static Camera turned_aside(Camera camera) {
    camera.cx += WIDTH / 3.0;
    return camera;
}

static void expect_one_kernel_steps_as_two_do(int count, bool only_in_view) {
    const Camera camera = random_scene_camera(51, WIDTH, HEIGHT), aside = turned_aside(camera);
    Training t = {0};
    Gaussians model = scene_of(count, &camera), after;
    begin(&t, &model, only_in_view);
    int in_view[2] = {0};
    for (int step = 1; step <= 5; step++) {
        both_step(&t, step, step % 2 ? &camera : &aside, step < 4 ? step - 1 : 3, 0);
        in_view[step % 2] = opencl_frame_counts(t.rasterizer).visible;
    }
    print_message("of %d splats %d are in view, and %d aside\n", count, in_view[1], in_view[0]);
    assert_true(in_view[0] < in_view[1]); // so that there is something to leave alone
    expect_same(&t);
    assert_int_equal(noted_splat(&t), -1);
    assert_true(device_gaussians_read(&t.way[1].model, &after));
    assert_true(memcmp(after.field[FIELD_SH0], model.field[FIELD_SH0], 3 * sizeof(float)) != 0); // it did step
    gaussians_destroy(&after);
    gaussians_destroy(&model);
    end(&t);
}

static void one_kernel_steps_as_two_do(void **state) {
    (void)state;
    const int counts[] = {1, 16, 333};
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++)
        for (int only_in_view = 0; only_in_view < 2; only_in_view++)
            expect_one_kernel_steps_as_two_do(counts[c], only_in_view);
}

static void both_note_the_same_splat_that_is_not_finite(void **state) {
    (void)state;
    const Camera camera = random_scene_camera(51, WIDTH, HEIGHT);
    Training t = {0};
    Gaussians model = scene_of(203, &camera);
    begin(&t, &model, false);
    both_step(&t, 1, &camera, 3, NAN);
    assert_true(noted_splat(&t) >= 0);
    expect_same(&t);
    both_step(&t, 2, &camera, 3, 0);
    assert_int_equal(noted_splat(&t), -1);
    expect_same(&t);
    gaussians_destroy(&model);
    end(&t);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_kernel_steps_as_two_do),
        cmocka_unit_test(both_note_the_same_splat_that_is_not_finite),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
