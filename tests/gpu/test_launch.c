#include "lab/base/fail.h"
#include "lab/gpu/gpu.h"
#include "tests/support/support.h"

#include <string.h>

typedef struct {
    int width;
    float scale;
    unsigned offset;
} TestRecord;

static const char SOURCE[] =
    "typedef struct { int width; float scale; uint offset; } TestRecord;\n"
    "__kernel void number(__global int *out, const int n, const uint step, const float scale) {\n"
    "    int i = (int)get_global_id(0);\n"
    "    if (i < n) out[i] = (int)((float)(i * (int)step) * scale);\n"
    "}\n"
    "__kernel void grid(__global int *out, const TestRecord r, const int height) {\n"
    "    int x = (int)get_global_id(0), y = (int)get_global_id(1);\n"
    "    if (x < r.width && y < height) out[y * r.width + x] = (int)(r.scale * (float)(100 * y + x)) + (int)r.offset;\n"
    "}\n"
    "__kernel void sizes(__global int *out) { out[0] = (int)sizeof(TestRecord); out[1] = (int)get_global_size(0); }\n"
    "__kernel void add_one(__global int *out) { out[get_global_id(0)] += 1; }\n";

static struct {
    Gpu *gpu;
    GpuProgram *program;
    GpuBuffer *out;
} at;

static int set_up(void **state) {
    (void)state;
    const char *folder = support_scratch();
    FILE *file = fopen(support_path(folder, "launch.cl"), "w");
    if (!file) return -1;
    fputs(SOURCE, file);
    fclose(file);
    gpu_set_kernel_folder(folder);
    bool good = gpu_open("", &at.gpu) && gpu_program_create(at.gpu, "launch.cl", "", &at.program) &&
                gpu_buffer_create(at.gpu, "out", 4096, &at.out);
    if (!good) print_message("%s\n", fail_text());
    return good ? 0 : -1;
}

static int tear_down(void **state) {
    (void)state;
    gpu_buffer_destroy(at.out);
    gpu_program_destroy(at.program);
    gpu_close(at.gpu);
    return 0;
}

static GpuKernel *kernel_named(const char *name) {
    GpuKernel *kernel;
    if (!gpu_kernel(at.program, name, &kernel)) fail_msg("%s", fail_text());
    return kernel;
}

static void every_kind_of_argument_reaches_the_kernel_and_ranges_are_rounded_up(void **state) {
    (void)state;
    int out[200];
    assert_true(gpu_buffer_zero(at.out));
    assert_true(gpu_launch(kernel_named("number"), gpu_range(100, 64), gpu_buffer_arg(at.out), gpu_int_arg(100),
                           gpu_uint_arg(6), gpu_float_arg(0.5f)));
    assert_true(gpu_buffer_read(at.out, out, sizeof out));
    for (int i = 0; i < 200; i++) assert_int_equal(out[i], i < 100 ? 3 * i : 0);
}

static void a_two_dimensional_launch_with_a_record_covers_the_grid(void **state) {
    (void)state;
    enum { WIDTH = 19, HEIGHT = 7 };
    int out[WIDTH * HEIGHT + 40];
    TestRecord record = {WIDTH, 2.0f, 5};
    assert_true(gpu_buffer_zero(at.out));
    assert_true(gpu_launch(kernel_named("grid"), gpu_range_2d(WIDTH, HEIGHT, 16, 4), gpu_buffer_arg(at.out),
                           gpu_record_arg(&record, sizeof record), gpu_int_arg(HEIGHT)));
    assert_true(gpu_buffer_read(at.out, out, sizeof out));
    for (int i = 0; i < WIDTH * HEIGHT + 40; i++)
        assert_int_equal(out[i], i < WIDTH * HEIGHT ? 2 * (100 * (i / WIDTH) + i % WIDTH) + 5 : 0);
}

static void a_record_has_the_same_size_on_both_sides(void **state) {
    (void)state;
    int out[2];
    assert_true(gpu_launch(kernel_named("sizes"), gpu_range(5, 8), gpu_buffer_arg(at.out)));
    assert_true(gpu_buffer_read(at.out, out, sizeof out));
    assert_int_equal(out[0], sizeof(TestRecord));
    assert_int_equal(out[1], 8);
}

static void a_wrong_number_of_arguments_fails_with_both_numbers(void **state) {
    (void)state;
    assert_false(gpu_launch(kernel_named("number"), gpu_range(1, 1), gpu_buffer_arg(at.out)));
    assert_non_null(strstr(fail_text(), "number"));
    assert_non_null(strstr(fail_text(), "4 arguments"));
}

static void an_empty_range_launches_nothing(void **state) {
    (void)state;
    assert_true(gpu_launch(kernel_named("add_one"), gpu_range(0, 64), gpu_buffer_arg(at.out)));
}

static void launches_are_done_in_order_and_their_time_goes_to_their_stage(void **state) {
    (void)state;
    enum { LAUNCHES = 700 }; // more than there is room for events
    int out;
    const GpuStageTime *times;
    int count;
    GpuKernel *add_one = kernel_named("add_one");
    assert_true(gpu_buffer_zero(at.out));
    for (int i = 0; i < LAUNCHES; i++) {
        gpu_stage(at.gpu, i % 2 ? "odd" : "even");
        assert_true(gpu_launch(add_one, gpu_range(64, 64), gpu_buffer_arg(at.out)));
    }
    gpu_stage_host(at.gpu, 12.5);
    gpu_stage(at.gpu, NULL);
    assert_true(gpu_launch(add_one, gpu_range(64, 64), gpu_buffer_arg(at.out)));
    assert_true(gpu_buffer_read(at.out, &out, sizeof out));
    assert_int_equal(out, LAUNCHES + 1);
    assert_true(gpu_stage_times(at.gpu, &times, &count));
    assert_int_equal(count, 2);
    assert_string_equal(times[0].stage, "even");
    assert_string_equal(times[1].stage, "odd");
    assert_true(times[0].device_ms > 0 && times[1].device_ms > 0);
    assert_true(times[0].device_ms < 10000);
    support_near(times[0].host_ms, 0, 0, "host time of the first stage");
    support_near(times[1].host_ms, 12.5, 0, "host time of the second stage");
    // They begin anew.
    assert_true(gpu_stage_times(at.gpu, &times, &count));
    support_near(times[0].device_ms, 0, 0, "device time of a stage that was not used");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_of_argument_reaches_the_kernel_and_ranges_are_rounded_up),
        cmocka_unit_test(a_two_dimensional_launch_with_a_record_covers_the_grid),
        cmocka_unit_test(a_record_has_the_same_size_on_both_sides),
        cmocka_unit_test(a_wrong_number_of_arguments_fails_with_both_numbers),
        cmocka_unit_test(an_empty_range_launches_nothing),
        cmocka_unit_test(launches_are_done_in_order_and_their_time_goes_to_their_stage),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
