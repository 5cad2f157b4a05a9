#include "lab/io/file.h"
#include "tests/support/command.h"
#include "tests/support/support.h"

#include <jansson.h>
#include <stdbool.h>
#include <string.h>

static void a_scene_is_written_and_understood(void **state) {
    (void)state;
    const char *folder = support_path(support_scratch(), "studio");
    CommandResult r = command_run("scene", "studio", "-o", folder, "--size", "48x32", "--views", "9", "--json", NULL);
    command_expect(&r, 0);
    json_t *root = json_loads(r.out, 0, NULL); // exactly one document: anything behind it is refused
    assert_non_null(root);
    assert_int_equal(json_integer_value(json_object_get(root, "views")), 9);
    assert_string_equal(json_string_value(json_object_get(root, "folder")), folder);
    json_decref(root);

    r = command_run("info", folder, "--json", NULL);
    command_expect(&r, 0);
    root = json_loads(r.out, 0, NULL);
    assert_int_equal(json_integer_value(json_object_get(root, "views")), 9);
    assert_int_equal(json_integer_value(json_object_get(root, "held_out")), 2);
    assert_int_equal(json_integer_value(json_object_get(json_object_get(root, "resolutions_px"), "48x32")), 9);
    json_decref(root);
}

static void help_lists_the_scenes(void **state) {
    (void)state;
    CommandResult r = command_run("scene", "--help", NULL);
    command_expect(&r, 0);
    static const char *const names[] = {"studio", "fence", "courtyard"};
    for (int i = 0; i < 3; i++) assert_non_null(strstr(r.out, names[i]));
}

static void wrong_usage_ends_with_exit_code_2(void **state) {
    (void)state;
    CommandResult r = command_run("scene", "studoi", "-o", "x", NULL);
    command_expect_error(&r, 2, "no scene 'studoi'", "did you mean studio?", NULL);
    r = command_run("scene", "moon", "-o", "x", NULL);
    command_expect_error(&r, 2, "no scene 'moon'", "fence", NULL);
    r = command_run("scene", "studio", NULL);
    command_expect_error(&r, 2, "-o DIR", NULL);
    r = command_run("scene", "studio", "-o", "x", "--size", "48", NULL);
    command_expect_error(&r, 2, "WxH", NULL);
    r = command_run("scene", "studio", "-o", "x", "--views", "1", NULL);
    command_expect_error(&r, 2, "--views 1", NULL);
    assert_false(file_exists("x"));
}

static void a_folder_that_cannot_be_written_is_a_failure(void **state) {
    (void)state;
    CommandResult r = command_run("scene", "studio", "-o", "/proc/none", NULL);
    command_expect_error(&r, 1, "/proc/none", NULL);
    const char *file = support_path(support_scratch(), "file");
    assert_true(file_write(file, "x", 1));
    r = command_run("scene", "studio", "-o", file, NULL);
    command_expect_error(&r, 1, file, NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scene_is_written_and_understood),
        cmocka_unit_test(help_lists_the_scenes),
        cmocka_unit_test(wrong_usage_ends_with_exit_code_2),
        cmocka_unit_test(a_folder_that_cannot_be_written_is_a_failure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
