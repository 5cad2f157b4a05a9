#include "lab/base/fail.h"
#include "lab/gpu/gpu.h"
#include "tests/support/support.h"

#include <string.h>

static int open_device(void **state) {
    Gpu *gpu;
    if (!gpu_open("", &gpu)) print_message("%s\n", fail_text());
    *state = gpu;
    return gpu ? 0 : -1;
}

static int close_device(void **state) {
    gpu_close(*state);
    return 0;
}

static void a_new_buffer_is_zero(void **state) {
    unsigned char bytes[1003];
    GpuBuffer *buffer;
    memset(bytes, 1, sizeof bytes);
    assert_true(gpu_buffer_create(*state, "test", sizeof bytes, &buffer));
    assert_int_equal(gpu_buffer_bytes(buffer), sizeof bytes);
    assert_true(gpu_buffer_read(buffer, bytes, sizeof bytes));
    for (size_t i = 0; i < sizeof bytes; i++) assert_int_equal(bytes[i], 0);
    gpu_buffer_destroy(buffer);
}

static void what_is_written_is_read_back(void **state) {
    int written[300], got[300];
    GpuBuffer *buffer;
    for (int i = 0; i < 300; i++) written[i] = i * i - 7;
    assert_true(gpu_buffer_create(*state, "test", sizeof written, &buffer));
    assert_true(gpu_buffer_write(buffer, written, sizeof written));
    assert_true(gpu_buffer_read(buffer, got, sizeof got));
    assert_memory_equal(got, written, sizeof got);
    // A shorter write leaves the rest.
    assert_true(gpu_buffer_write(buffer, &(int){5}, sizeof(int)));
    assert_true(gpu_buffer_read(buffer, got, sizeof got));
    assert_int_equal(got[0], 5);
    assert_memory_equal(got + 1, written + 1, sizeof got - sizeof *got);
    assert_true(gpu_buffer_zero(buffer));
    assert_true(gpu_buffer_read(buffer, got, sizeof got));
    for (int i = 0; i < 300; i++) assert_int_equal(got[i], 0);
    gpu_buffer_destroy(buffer);
}

static void a_mapping_shows_and_changes_the_content(void **state) {
    GpuBuffer *buffer;
    void *pointer;
    int got[4];
    assert_true(gpu_buffer_create(*state, "test", sizeof got, &buffer));
    assert_true(gpu_buffer_map(buffer, GPU_WRITE, &pointer));
    memcpy(pointer, (int[]){1, 2, 3, 4}, sizeof got);
    assert_true(gpu_buffer_unmap(buffer));
    assert_true(gpu_buffer_map(buffer, GPU_READ_WRITE, &pointer));
    assert_int_equal(((int *)pointer)[2], 3);
    ((int *)pointer)[2] = 30;
    assert_true(gpu_buffer_unmap(buffer));
    assert_true(gpu_buffer_read(buffer, got, sizeof got));
    assert_memory_equal(got, ((int[]){1, 2, 30, 4}), sizeof got);
    gpu_buffer_destroy(buffer);
}

static void several_are_mapped_with_one_wait(void **state) {
    const int written[2] = {12, 34};
    int got;
    GpuMap maps[2] = {{.access = GPU_READ}, {.access = GPU_READ_WRITE}};
    for (int i = 0; i < 2; i++) {
        assert_true(gpu_buffer_create(*state, "test", sizeof *written, &maps[i].buffer));
        assert_true(gpu_buffer_write(maps[i].buffer, &written[i], sizeof *written));
    }
    const long waits = gpu_counts(*state).waits;
    assert_true(gpu_buffers_map(maps, 2));
    assert_int_equal(gpu_counts(*state).waits, waits + 1);
    for (int i = 0; i < 2; i++) assert_int_equal(*(int *)maps[i].pointer, written[i]);
    *(int *)maps[1].pointer = 56;
    for (int i = 0; i < 2; i++) assert_true(gpu_buffer_unmap(maps[i].buffer));
    assert_true(gpu_buffer_read(maps[1].buffer, &got, sizeof got));
    assert_int_equal(got, 56);
    for (int i = 0; i < 2; i++) gpu_buffer_destroy(maps[i].buffer);
}

static void a_buffer_grows_by_half_and_never_shrinks(void **state) {
    GpuBuffer *buffer;
    assert_true(gpu_buffer_create(*state, "test", 1000, &buffer));
    assert_true(gpu_buffer_write(buffer, "abc", 4));
    assert_true(gpu_buffer_reserve(buffer, 900));
    assert_int_equal(gpu_buffer_bytes(buffer), 900);
    char text[4];
    assert_true(gpu_buffer_read(buffer, text, 4));
    assert_string_equal(text, "abc"); // the same memory
    assert_true(gpu_buffer_reserve(buffer, 1001));
    assert_int_equal(gpu_buffer_bytes(buffer), 1001);
    assert_true(gpu_buffer_write(buffer, "def", 4));
    assert_true(gpu_buffer_reserve(buffer, 1500)); // inside the capacity that 1001 brought
    assert_int_equal(gpu_buffer_bytes(buffer), 1500);
    assert_true(gpu_buffer_read(buffer, text, 4));
    assert_string_equal(text, "def");
    gpu_buffer_destroy(buffer);
}

static void an_empty_buffer_has_one_byte(void **state) {
    GpuBuffer *buffer;
    assert_true(gpu_buffer_create(*state, "test", 0, &buffer));
    assert_int_equal(gpu_buffer_bytes(buffer), 1);
    gpu_buffer_destroy(buffer);
    gpu_buffer_destroy(NULL);
}

static void a_part_is_the_same_memory_as_the_whole(void **state) {
    enum { STEP = GPU_PART_STEP / sizeof(int), COUNT = 3 * STEP };
    static int all[COUNT];
    int middle[5] = {1, 2, 3, 4, 5};
    GpuBuffer *whole, *part;
    assert_true(gpu_buffer_create(*state, "whole", sizeof all, &whole));
    assert_true(gpu_buffer_part(whole, "part", GPU_PART_STEP, sizeof middle, &part));
    assert_int_equal(gpu_buffer_bytes(part), sizeof middle);
    assert_true(gpu_buffer_write(part, middle, sizeof middle));
    assert_true(gpu_buffer_read(whole, all, sizeof all));
    for (int i = 0; i < COUNT; i++) assert_int_equal(all[i], i >= STEP && i < STEP + 5 ? i - STEP + 1 : 0);
    gpu_buffer_destroy(part);
    gpu_buffer_destroy(whole);
}

static void a_buffer_that_does_not_fit_fails_with_its_name_and_size(void **state) {
    GpuBuffer *buffer;
    size_t bytes = gpu_info(*state)->max_alloc_bytes + 1000000;
    assert_false(gpu_buffer_create(*state, "pair records", bytes, &buffer));
    assert_null(buffer);
    assert_non_null(strstr(fail_text(), "pair records"));
    assert_non_null(strstr(fail_text(), "MB"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_new_buffer_is_zero),
        cmocka_unit_test(what_is_written_is_read_back),
        cmocka_unit_test(a_mapping_shows_and_changes_the_content),
        cmocka_unit_test(several_are_mapped_with_one_wait),
        cmocka_unit_test(a_buffer_grows_by_half_and_never_shrinks),
        cmocka_unit_test(an_empty_buffer_has_one_byte),
        cmocka_unit_test(a_part_is_the_same_memory_as_the_whole),
        cmocka_unit_test(a_buffer_that_does_not_fit_fails_with_its_name_and_size),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
