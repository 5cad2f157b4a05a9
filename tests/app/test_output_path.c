#include "lab/app/output_path.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "tests/support/support.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *const ENDINGS[] = {".png", ".exr", NULL};

static void a_path_that_can_be_written_is_fine_and_is_not_touched(void **state) {
    (void)state;
    const char *path = support_path(support_scratch(), "out.PNG");
    assert_true(output_path_check("output", path, ENDINGS));
    assert_int_equal(access(path, F_OK), -1);
}

static void a_wrong_ending_is_wrong_usage(void **state) {
    (void)state;
    assert_false(output_path_check("output", "a.txt", ENDINGS));
    assert_string_equal(fail_text(), "--output a.txt: the name must end in .png or .exr");
    assert_int_equal(fail_exit_code(), 2);
}

static void a_folder_that_is_not_there_or_is_the_target_is_a_failure(void **state) {
    (void)state;
    const char *scratch = support_scratch();
    assert_false(output_path_check("output", support_path(scratch, "none/out.png"), ENDINGS));
    assert_int_equal(fail_exit_code(), 1);
    assert_non_null(strstr(fail_text(), "none"));
    const char *folder = support_path(scratch, "folder.png");
    char *command = mem_format("mkdir -p '%s'", folder);
    assert_int_equal(system(command), 0);
    mem_free(command);
    assert_false(output_path_check("output", folder, ENDINGS));
    assert_non_null(strstr(fail_text(), "it is a folder"));
}

static void numbers_stand_before_the_ending(void **state) {
    (void)state;
    static const char *const cases[][2] = {
        {"a.png", "a_0012.png"}, {"out/a.b.png", "out/a.b_0012.png"}, {"out.d/a", "out.d/a_0012"}, {"a", "a_0012"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char *path = output_path_numbered(cases[i][0], 12);
        assert_string_equal(path, cases[i][1]);
        mem_free(path);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_path_that_can_be_written_is_fine_and_is_not_touched),
        cmocka_unit_test(a_wrong_ending_is_wrong_usage),
        cmocka_unit_test(a_folder_that_is_not_there_or_is_the_target_is_a_failure),
        cmocka_unit_test(numbers_stand_before_the_ending),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
