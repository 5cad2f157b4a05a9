#include "splat3d/device_gaussians.h"

#include "kernels/shared.h"
#include "tests/support/random_scene.h"
#include "tests/support/support.h"

#include <string.h>

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

static void a_model_comes_back_as_it_was_written(void **state) {
    for (int degree = 0; degree <= SH_DEGREE_MAX; degree++) {
        RandomScene scene = random_scene_default(3);
        scene.sh_degree = degree;
        const Camera camera = random_scene_camera(3, 64, 64);
        Gaussians model = random_scene_gaussians(&scene, &camera), back;
        DeviceGaussians device;
        assert_true(device_gaussians_create(*state, "model", 7, degree, &device));
        assert_true(device_gaussians_write(&device, &model));
        assert_int_equal(device.count, model.count);
        assert_true(device_gaussians_read(&device, &back));
        assert_int_equal(back.sh_degree, degree);
        for (int id = 0; id < FIELD_COUNT; id++) {
            assert_int_equal(back.field[id] != NULL, GAUSSIAN_FIELDS[id].sh_degree <= degree);
            if (back.field[id])
                assert_memory_equal(back.field[id], model.field[id],
                                    (size_t)model.count * (size_t)GAUSSIAN_FIELDS[id].width * sizeof(float));
        }
        gaussians_destroy(&back);
        gaussians_destroy(&model);
        device_gaussians_destroy(&device);
    }
}

static void groups_and_their_ends_keep_every_number(void **state) {
    const int counts[] = {1, 15, 16, 17, 33000};
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
        const int n = counts[c];
        Gaussians model = gaussians_create(n, SH_DEGREE_MAX), back;
        DeviceGaussians device;
        for (int id = 0; id < FIELD_COUNT; id++)
            for (int k = 0; k < n * GAUSSIAN_FIELDS[id].width; k++) model.field[id][k] = (float)(k + id);
        assert_true(device_gaussians_create(*state, "model", 0, SH_DEGREE_MAX, &device));
        assert_true(device_gaussians_write(&device, &model) && device_gaussians_read(&device, &back));
        for (int id = 0; id < FIELD_COUNT; id++)
            assert_memory_equal(back.field[id], model.field[id],
                                (size_t)n * (size_t)GAUSSIAN_FIELDS[id].width * sizeof(float));
        // The layout that kernels/splat_lanes.h describes: number k of splat i.
        void *mapped;
        assert_true(gpu_buffer_map(device.field[FIELD_SH2], GPU_READ, &mapped));
        const float *sh2 = mapped;
        const int i = n - 1, k = 7, at = i / SPLAT_GROUP * SPLAT_GROUP * 15 + k * SPLAT_GROUP + i % SPLAT_GROUP;
        assert_true(sh2[at] == gaussians_at(&model, FIELD_SH2, i)[k]);
        assert_true(gpu_buffer_unmap(device.field[FIELD_SH2]));
        gaussians_destroy(&back);
        gaussians_destroy(&model);
        device_gaussians_destroy(&device);
    }
}

static void a_new_one_is_zero_and_an_empty_one_is_allowed(void **state) {
    DeviceGaussians device;
    Gaussians back;
    assert_true(device_gaussians_create(*state, "moment", 9, 1, &device));
    assert_true(device_gaussians_read(&device, &back));
    for (int k = 0; k < 9 * 9; k++) assert_true(back.field[FIELD_SH1][k] == 0);
    gaussians_destroy(&back);
    assert_true(device_gaussians_resize(&device, 0));
    assert_true(device_gaussians_read(&device, &back));
    assert_int_equal(back.count, 0);
    assert_true(device_gaussians_write(&device, &back));
    gaussians_destroy(&back);
    device_gaussians_destroy(&device);
    device_gaussians_destroy(&device);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_model_comes_back_as_it_was_written),
        cmocka_unit_test(groups_and_their_ends_keep_every_number),
        cmocka_unit_test(a_new_one_is_zero_and_an_empty_one_is_allowed),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
