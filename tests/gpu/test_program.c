#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/gpu/gpu.h"
#include "tests/support/support.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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

static int forget_folder(void **state) {
    (void)state;
    gpu_set_kernel_folder(NULL);
    unsetenv("SPLATLAB_KERNELS");
    support_set_cache(NULL);
    return 0;
}

static void put_file(const char *folder, const char *name, const char *text) {
    FILE *file = fopen(support_path(folder, name), "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static int run_answer(Gpu *gpu, const char *file, const char *options) {
    GpuProgram *program;
    GpuKernel *kernel;
    GpuBuffer *buffer;
    int answer = 0;
    if (!gpu_program_create(gpu, file, options, &program)) fail_msg("%s", fail_text());
    assert_true(gpu_kernel(program, "answer", &kernel));
    assert_true(gpu_buffer_create(gpu, "answer", sizeof answer, &buffer));
    assert_true(gpu_launch(kernel, gpu_range(1, 1), gpu_buffer_arg(buffer)));
    assert_true(gpu_buffer_read(buffer, &answer, sizeof answer));
    gpu_buffer_destroy(buffer);
    gpu_program_destroy(program);
    return answer;
}

static void a_compile_error_names_file_and_line(void **state) {
    const char *folder = support_scratch();
    put_file(folder, "broken.cl", "// one\n__kernel void answer(__global int *a) {\n    a[0] = undeclared_name;\n}\n");
    gpu_set_kernel_folder(folder);
    GpuProgram *program;
    assert_false(gpu_program_create(*state, "broken.cl", "", &program));
    assert_null(program);
    assert_non_null(strstr(fail_text(), "broken.cl:3:"));
    assert_non_null(strstr(fail_text(), "undeclared_name"));
}

static void an_error_in_an_included_file_names_that_file(void **state) {
    const char *folder = support_scratch();
    put_file(folder, "part.h", "// one\n\nint broken(void) { return undeclared_name; }\n");
    put_file(folder, "whole.cl", "#include \"part.h\"\n__kernel void answer(__global int *a) { a[0] = broken(); }\n");
    gpu_set_kernel_folder(folder);
    GpuProgram *program;
    assert_false(gpu_program_create(*state, "whole.cl", "", &program));
    assert_non_null(strstr(fail_text(), "part.h:3:"));
}

static void a_line_after_an_include_keeps_its_number(void **state) {
    const char *folder = support_scratch();
    put_file(folder, "part.h", "#define TWO 2\n#define THREE 3\n#define FOUR 4"); // and no newline at its end
    put_file(folder, "whole.cl",
             "// one\n#include \"part.h\"\n__kernel void answer(__global int *a) { a[0] = __LINE__; }");
    gpu_set_kernel_folder(folder);
    assert_int_equal(run_answer(*state, "whole.cl", ""), 3);
}

static void includes_and_options_reach_the_kernel_in_a_folder_with_a_space(void **state) {
    const char *folder = support_scratch();
    char *spaced = mem_format("%s/my kernels", folder);
    char *command = mem_format("mkdir '%s'", spaced);
    assert_int_equal(system(command), 0);
    put_file(spaced, "part.h", "#define BASE 40\n");
    put_file(spaced, "sum.cl",
             "  #  include \"part.h\"\n__kernel void answer(__global int *a) { a[0] = BASE + ADD; }\n");
    gpu_set_kernel_folder(spaced);
    assert_int_equal(run_answer(*state, "sum.cl", "-D ADD=2"), 42);
    mem_free(command);
    mem_free(spaced);
}

static void a_set_folder_comes_before_the_environment_and_both_before_the_usual_folder(void **state) {
    const char *set = support_scratch(), *environment = support_scratch();
    put_file(environment, "which.cl", "__kernel void answer(__global int *a) { a[0] = 1; }\n");
    setenv("SPLATLAB_KERNELS", environment, 1);
    assert_int_equal(run_answer(*state, "which.cl", ""), 1);
    put_file(set, "which.cl", "__kernel void answer(__global int *a) { a[0] = 2; }\n");
    gpu_set_kernel_folder(set);
    assert_int_equal(run_answer(*state, "which.cl", ""), 2);
    // The usual folder still serves what the others do not hold.
    char *path;
    assert_true(gpu_kernel_path("shared.h", &path));
    assert_non_null(strstr(path, "kernels/shared.h"));
    mem_free(path);
}

static void a_missing_file_says_where_it_was_looked_for(void **state) {
    const char *folder = support_scratch();
    gpu_set_kernel_folder(folder);
    GpuProgram *program;
    assert_false(gpu_program_create(*state, "no_such.cl", "", &program));
    assert_non_null(strstr(fail_text(), "no_such.cl"));
    assert_non_null(strstr(fail_text(), folder));
    put_file(folder, "wants.cl", "\n\n#include \"no_such.h\"\n");
    assert_false(gpu_program_create(*state, "wants.cl", "", &program));
    assert_non_null(strstr(fail_text(), "wants.cl, line 3"));
}

static void a_file_that_includes_itself_fails(void **state) {
    const char *folder = support_scratch();
    put_file(folder, "snake.cl", "#include \"snake.cl\"\n");
    gpu_set_kernel_folder(folder);
    GpuProgram *program;
    assert_false(gpu_program_create(*state, "snake.cl", "", &program));
    assert_non_null(strstr(fail_text(), "snake.cl"));
}

static void an_unknown_kernel_name_fails_with_file_and_name(void **state) {
    GpuProgram *program;
    GpuKernel *kernel;
    assert_true(gpu_program_create(*state, "self_test.cl", "", &program));
    assert_false(gpu_kernel(program, "no_such_kernel", &kernel));
    assert_null(kernel);
    assert_non_null(strstr(fail_text(), "no_such_kernel"));
    assert_non_null(strstr(fail_text(), "self_test.cl"));
    gpu_program_destroy(program);
    gpu_program_destroy(NULL);
}

static void a_kernel_tells_what_its_arguments_are(void **state) {
    const char *folder = support_scratch();
    put_file(folder, "arguments.cl",
             "kernel void f(int n, global const float *x, local int *y, uint u) { if (n) y[u] = (int)x[0]; }\n");
    gpu_set_kernel_folder(folder);
    GpuProgram *program;
    GpuKernel *kernel;
    assert_true(gpu_program_create(*state, "arguments.cl", "-cl-kernel-arg-info", &program));
    assert_true(gpu_kernel(program, "f", &kernel));
    assert_int_equal(gpu_kernel_parameters(kernel), 4);
    static const GpuParameter expected[] = {
        {"int", false, false}, {"float", true, false}, {"int", false, true}, {"uint", false, false}};
    for (int i = 0; i < 4; i++) {
        GpuParameter p;
        assert_true(gpu_kernel_parameter(kernel, i, &p));
        assert_string_equal(p.type, expected[i].type);
        assert_true(p.is_buffer == expected[i].is_buffer && p.is_local == expected[i].is_local);
    }
    gpu_program_destroy(program);
}

static void ids_can_begin_elsewhere(void **state) {
    const char *folder = support_scratch();
    put_file(folder, "first.cl",
             "kernel void first(global int *x) { if (get_local_id(0) == 0) x[0] = (int)get_global_id(0); }\n");
    gpu_set_kernel_folder(folder);
    GpuProgram *program;
    GpuKernel *kernel;
    GpuBuffer *buffer;
    int got;
    assert_true(gpu_program_create(*state, "first.cl", "", &program) && gpu_kernel(program, "first", &kernel));
    assert_true(gpu_buffer_create(*state, "x", sizeof got, &buffer));
    const GpuArg arg = gpu_buffer_arg(buffer);
    assert_true(gpu_launch_args_from(kernel, gpu_range(64, 64), 3, &arg, 1) &&
                gpu_buffer_read(buffer, &got, sizeof got));
    assert_int_equal(got, 3);
    assert_true(gpu_launch_args(kernel, gpu_range(64, 64), &arg, 1) && gpu_buffer_read(buffer, &got, sizeof got));
    assert_int_equal(got, 0);
    gpu_buffer_destroy(buffer);
    gpu_program_destroy(program);
}

// The one file in the cache of compiled programs; NULL: there is none.
static char *kept_file(const char *cache) {
    char *folder = mem_format("%s/splatlab/kernels", cache), *path = NULL;
    DIR *directory = opendir(folder);
    for (struct dirent *entry; directory && (entry = readdir(directory));)
        if (entry->d_name[0] != '.') {
            assert_null(path);
            path = mem_format("%s/%s", folder, entry->d_name);
        }
    if (directory) closedir(directory);
    mem_free(folder);
    return path;
}

static const char ANSWER_7[] = "__kernel void answer(__global int *a) { a[0] = 7; }\n";

// Compiles kept.cl of the folder, with that cache; returns the kept file, or NULL.
static char *keep_answer_7(Gpu *gpu, const char *folder, const char *cache) {
    support_set_cache(cache);
    gpu_set_kernel_folder(folder);
    put_file(folder, "kept.cl", ANSWER_7);
    assert_int_equal(run_answer(gpu, "kept.cl", ""), 7);
    return kept_file(cache);
}

static void a_compiled_program_is_kept_until_its_text_changes(void **state) {
    if (strcmp(gpu_info(*state)->platform, "Portable Computing Language") != 0) {
        print_message("skipped: %s keeps compiled programs by itself\n", gpu_info(*state)->platform);
        skip();
    }
    const char *folder = support_scratch(), *cache = support_path(folder, "cache");
    char *path = keep_answer_7(*state, folder, cache);
    assert_non_null(path);
    assert_int_equal(run_answer(*state, "kept.cl", ""), 7); // from there
    put_file(folder, "kept.cl", "__kernel void answer(__global int *a) { a[0] = 8; }\n");
    assert_int_equal(run_answer(*state, "kept.cl", ""), 8);
    mem_free(kept_file(cache)); // still one
    // A person's own program, of which the arguments' names are asked, is not kept.
    assert_int_equal(unlink(path), 0);
    assert_int_equal(run_answer(*state, "kept.cl", "-cl-kernel-arg-info"), 8);
    assert_null(kept_file(cache));
    mem_free(path);
}

static void a_damaged_kept_program_is_not_believed(void **state) {
    const char *folder = support_scratch(), *cache = support_path(folder, "cache");
    char *path = keep_answer_7(*state, folder, cache);
    if (path) {
        FILE *file = fopen(path, "r+b");
        assert_non_null(file);
        assert_int_equal(fseek(file, -5, SEEK_END), 0);
        fputc('?', file);
        fclose(file);
        assert_int_equal(run_answer(*state, "kept.cl", ""), 7);
        assert_int_equal(truncate(path, 100), 0);
        assert_int_equal(run_answer(*state, "kept.cl", ""), 7);
        assert_int_equal(truncate(path, 0), 0);
        assert_int_equal(run_answer(*state, "kept.cl", ""), 7);
    }
    mem_free(path);
    support_set_cache("/proc/nowhere"); // a place where nothing can be kept
    assert_int_equal(run_answer(*state, "kept.cl", ""), 7);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_compile_error_names_file_and_line, forget_folder),
        cmocka_unit_test_teardown(an_error_in_an_included_file_names_that_file, forget_folder),
        cmocka_unit_test_teardown(a_line_after_an_include_keeps_its_number, forget_folder),
        cmocka_unit_test_teardown(includes_and_options_reach_the_kernel_in_a_folder_with_a_space, forget_folder),
        cmocka_unit_test_teardown(a_set_folder_comes_before_the_environment_and_both_before_the_usual_folder,
                                  forget_folder),
        cmocka_unit_test_teardown(a_missing_file_says_where_it_was_looked_for, forget_folder),
        cmocka_unit_test_teardown(a_file_that_includes_itself_fails, forget_folder),
        cmocka_unit_test(an_unknown_kernel_name_fails_with_file_and_name),
        cmocka_unit_test(a_kernel_tells_what_its_arguments_are),
        cmocka_unit_test(ids_can_begin_elsewhere),
        cmocka_unit_test_teardown(a_compiled_program_is_kept_until_its_text_changes, forget_folder),
        cmocka_unit_test_teardown(a_damaged_kept_program_is_not_believed, forget_folder),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
