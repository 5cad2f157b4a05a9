#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/gpu/gpu.h"
#include "tests/support/support.h"

#include <string.h>

static Gpu *open_device(const char *spec) {
    Gpu *gpu;
    if (!gpu_open(spec, &gpu)) fail_msg("device '%s': %s", spec, fail_text());
    return gpu;
}

static void the_list_describes_every_device(void **state) {
    (void)state;
    GpuInfo *infos;
    int count;
    assert_true(gpu_list(&infos, &count));
    for (int i = 0; i < count; i++) {
        assert_true(strlen(infos[i].name) > 0 && strlen(infos[i].platform) > 0);
        assert_true(infos[i].compute_units > 0);
        assert_true(infos[i].memory_bytes >= infos[i].max_alloc_bytes && infos[i].max_alloc_bytes > 0);
    }
    mem_free(infos);
}

static void the_list_has_the_same_order_each_time(void **state) {
    (void)state;
    GpuInfo *first, *second;
    int first_count, second_count;
    assert_true(gpu_list(&first, &first_count) && gpu_list(&second, &second_count));
    assert_int_equal(first_count, second_count);
    for (int i = 0; i < first_count; i++) assert_string_equal(first[i].name, second[i].name);
    mem_free(first);
    mem_free(second);
}

static void auto_and_the_empty_name_open_the_same_device(void **state) {
    (void)state;
    Gpu *by_auto = open_device("auto"), *by_empty = open_device("");
    assert_string_equal(gpu_info(by_auto)->name, gpu_info(by_empty)->name);
    gpu_close(by_auto);
    gpu_close(by_empty);
}

static void a_device_opens_by_number_and_by_part_of_its_name(void **state) {
    (void)state;
    GpuInfo *infos;
    int count;
    assert_true(gpu_list(&infos, &count));
    for (int i = 0; i < count; i++) {
        char number[16], part[8];
        snprintf(number, sizeof number, "%d", i);
        Gpu *gpu = open_device(number);
        assert_string_equal(gpu_info(gpu)->name, infos[i].name);
        gpu_close(gpu);
        snprintf(part, sizeof part, "%.7s", infos[i].name);
        gpu = open_device(part);
        assert_non_null(strstr(gpu_info(gpu)->name, part));
        gpu_close(gpu);
    }
    mem_free(infos);
}

static void cpu_opens_a_cpu(void **state) {
    (void)state;
    Gpu *gpu = open_device("cpu");
    assert_true(gpu_info(gpu)->is_cpu);
    gpu_close(gpu);
}

static void an_unknown_name_fails_with_the_list(void **state) {
    (void)state;
    GpuInfo *infos;
    int count;
    assert_true(gpu_list(&infos, &count));
    assert_true(count > 0);
    const char *wrong[] = {"no such device", "999", "-1", "99999999999999999999"};
    for (int i = 0; i < 4; i++) {
        Gpu *gpu;
        assert_false(gpu_open(wrong[i], &gpu));
        assert_null(gpu);
        assert_non_null(strstr(fail_text(), wrong[i]));
        assert_non_null(strstr(fail_text(), infos[0].name));
        assert_int_equal(fail_exit_code(), 2);
    }
    mem_free(infos);
}

static void closing_nothing_is_fine(void **state) {
    (void)state;
    gpu_close(NULL);
}

// A kernel that answers wrongly stands in for a device that computes wrongly.
static void a_wrong_answer_of_the_self_test_names_what_was_expected(void **state) {
    (void)state;
    const char *folder = support_scratch();
    FILE *file = fopen(support_path(folder, "self_test.cl"), "w");
    assert_non_null(file);
    fputs("__kernel void self_test(__global uint *answers, float s) { answers[get_local_id(0) * 5] = 0x1234; }\n",
          file);
    fclose(file);
    gpu_set_kernel_folder(folder);
    Gpu *gpu;
    bool opened = gpu_open("", &gpu);
    gpu_set_kernel_folder(NULL);
    assert_false(opened);
    assert_non_null(strstr(fail_text(), "self-test"));
    assert_non_null(strstr(fail_text(), "0x00001234, want 0x"));
}

int main(void) {
    // The self-test runs once per device and process, so its own test comes first.
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_wrong_answer_of_the_self_test_names_what_was_expected),
        cmocka_unit_test(the_list_describes_every_device),
        cmocka_unit_test(the_list_has_the_same_order_each_time),
        cmocka_unit_test(auto_and_the_empty_name_open_the_same_device),
        cmocka_unit_test(a_device_opens_by_number_and_by_part_of_its_name),
        cmocka_unit_test(cpu_opens_a_cpu),
        cmocka_unit_test(an_unknown_name_fails_with_the_list),
        cmocka_unit_test(closing_nothing_is_fine),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
