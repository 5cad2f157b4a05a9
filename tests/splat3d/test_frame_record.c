#include "splat3d/frame_record.h"

#include "kernels/adam_record.h"
#include "lab/base/fail.h"
#include "lab/gpu/gpu.h"
#include "tests/support/random_scene.h"
#include "tests/support/support.h"

#include <string.h>

static void records_have_the_same_layout_on_the_device(void **state) {
    (void)state;
    Gpu *gpu;
    GpuProgram *program;
    GpuKernel *kernel;
    GpuBuffer *buffer;
    int sizes[6];
    const FrameRecord frame = {.is_depth = 4711}; // the last member: anything shifted before it shows here
    assert_true(gpu_open("", &gpu));
    assert_true(gpu_program_create(gpu, "record_sizes.cl", "", &program));
    assert_true(gpu_kernel(program, "record_sizes", &kernel));
    assert_true(gpu_buffer_create(gpu, "sizes", sizeof sizes, &buffer));
    assert_true(gpu_launch(kernel, ((GpuRange){.width = 1, .group_width = 1}), gpu_record_arg(&frame, sizeof frame),
                           gpu_buffer_arg(buffer)));
    assert_true(gpu_buffer_read(buffer, sizes, sizeof sizes));
    assert_int_equal(sizes[0], sizeof(FrameRecord));
    assert_int_equal(sizes[1], sizeof(ScreenSplat));
    assert_int_equal(sizes[2], sizeof(TileBox));
    assert_int_equal(sizes[3], sizeof(PairGradient));
    assert_int_equal(sizes[4], 4711);
    assert_int_equal(sizes[5], sizeof(AdamStepRecord));
    gpu_buffer_destroy(buffer);
    gpu_program_destroy(program);
    gpu_close(gpu);
}

static void the_picture_is_padded_to_whole_tiles_and_the_degree_is_the_smaller_one(void **state) {
    (void)state;
    const Camera camera = random_scene_camera(1, 33, 16);
    RenderSettings settings = render_settings_default();
    FrameRecord frame;
    settings.sh_degree = 2;
    assert_true(frame_record_make(&camera, &settings, 5, 3, &frame));
    assert_int_equal(frame.stride, 48);
    assert_int_equal(frame.rows, 16);
    assert_int_equal(frame.tiles_x * 10 + frame.tiles_y, 31);
    assert_int_equal(frame.sh_degree, 2);
    assert_true(frame_record_make(&camera, &settings, 5, 1, &frame));
    assert_int_equal(frame.sh_degree, 1);
}

static void the_jacobian_is_clamped_a_margin_outside_each_edge(void **state) {
    (void)state;
    Camera camera = random_scene_camera(1, 200, 100);
    const RenderSettings settings = render_settings_default();
    FrameRecord frame;
    camera.fx = 100, camera.cx = 50;
    assert_true(frame_record_make(&camera, &settings, 0, 0, &frame));
    support_near(frame.ratio_low[0], -0.5 - 0.3, 1e-6, "left");
    support_near(frame.ratio_high[0], 1.5 + 0.3, 1e-6, "right");
}

static void refuse(const Camera *camera, const RenderSettings *settings, const char *because) {
    FrameRecord frame;
    assert_false(frame_record_make(camera, settings, 1, 0, &frame));
    if (!strstr(fail_text(), because)) fail_msg("\"%s\" does not say \"%s\"", fail_text(), because);
}

static void what_the_kernels_cannot_do_is_refused_with_its_value(void **state) {
    (void)state;
    const Camera camera = random_scene_camera(1, 64, 64);
    RenderSettings settings = render_settings_default();
    settings.stop_rule = STOP_BEFORE_BLEND;
    refuse(&camera, &settings, "C reference");
    settings = render_settings_default();
    settings.alpha_max = 1;
    refuse(&camera, &settings, "alpha_max is 1");
    settings = render_settings_default();
    settings.near_depth = 0;
    refuse(&camera, &settings, "near_depth is 0");
    settings = render_settings_default();
    Camera bad = camera;
    bad.width = 0;
    refuse(&bad, &settings, "0 x 64");
    bad = camera;
    bad.fy = -1;
    refuse(&bad, &settings, "focal");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(records_have_the_same_layout_on_the_device),
        cmocka_unit_test(the_picture_is_padded_to_whole_tiles_and_the_degree_is_the_smaller_one),
        cmocka_unit_test(the_jacobian_is_clamped_a_margin_outside_each_edge),
        cmocka_unit_test(what_the_kernels_cannot_do_is_refused_with_its_value),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
