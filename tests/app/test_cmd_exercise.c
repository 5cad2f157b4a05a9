// test_cmd_exercise.c - `splatlab exercise` as a person uses it, on a copy of the exercises.
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "lab/io/json_io.h"
#include "tests/support/command.h"
#include "tests/support/exercise_files.h"
#include "tests/support/support.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *root;

static int fresh(void **state) {
    (void)state;
    root = exercise_files_fresh();
    return 0;
}

static bool has(const CommandResult *r, const char *text) {
    if (strstr(r->out, text)) return true;
    fail_msg("'%s' is missing in\n%s%s", text, r->out, r->err);
    return false;
}

static char *in_copy(const char *name) {
    static char path[4096];
    snprintf(path, sizeof path, "%s/%s", root, name);
    return path;
}

static void the_list_lays_the_files_out(void **state) {
    (void)state;
    CommandResult r = command_run("exercise", NULL);
    command_expect(&r, 0);
    has(&r, "E01  cov2");
    has(&r, "E20  adam");
    has(&r, "0 of ");
    assert_true(file_exists(in_copy("01_cov2/cov2.c")) && file_exists(in_copy("20_adam/adam.cl")));
    r = command_run("exercise", "list", "--json", NULL);
    json_t *list = json_loads(r.out, 0, NULL);
    assert_int_equal(
        json_integer_value(json_object_get(json_array_get(json_object_get(list, "exercises"), 0), "number")), 1);
    json_decref(list);
}

static void the_list_fits_the_terminal(void **state) {
    (void)state;
    setenv("COLUMNS", "80", 1);
    CommandResult r = command_run("exercise", NULL);
    unsetenv("COLUMNS");
    command_expect(&r, 0);
    for (const char *line = r.out; line[0] == 'E' || line == r.out || line[0] == ' '; line += strcspn(line, "\n") + 1)
        if (strcspn(line, "\n") > 80) fail_msg("more than 80 columns: %.*s", (int)strcspn(line, "\n"), line);
    has(&r, "E08  cov3");
    has(&r, "\n                                  "); // a title that goes on stands under its beginning
}

static void a_fresh_stub_fails_kindly_and_a_solution_passes(void **state) {
    (void)state;
    CommandResult r = command_run("exercise", "run", "1", NULL);
    command_expect(&r, 1);
    has(&r, "not started yet: this is the place");
    has(&r, "cov2.c:7");
    exercise_files_copy("solutions/cov2.c", "01_cov2/cov2.c");
    r = command_run("exercise", "run", "cov2", NULL);
    command_expect(&r, 0);
    has(&r, "passed, all 6 rungs in float and double, 17 seeds");
    assert_null(strchr(r.out, '\033'));
    r = command_run("exercise", "list", NULL);
    has(&r, "1 of ");
}

static void a_wrong_answer_is_json_and_can_be_replayed(void **state) {
    (void)state;
    exercise_files_copy("01_cov2/mutants/degrees.c", "01_cov2/cov2.c");
    CommandResult r = command_run("exercise", "run", "E01", "--json", NULL);
    command_expect(&r, 1);
    json_t *o = json_loads(r.out, 0, NULL);
    assert_non_null(o);
    const json_t *rung = json_array_get(json_object_get(o, "rungs"), 2);
    assert_true(json_is_false(json_object_get(o, "passed")) && json_is_false(json_object_get(rung, "passed")));
    assert_string_equal(json_string_value(json_object_get(rung, "suspicion")), "degrees");
    char *seed = mem_format("%lld", (long long)json_integer_value(json_object_get(rung, "seed")));
    json_decref(o);
    r = command_run("exercise", "run", "1", "--seed", seed, NULL);
    command_expect(&r, 1);
    has(&r, "the angle is taken for degrees");
    mem_free(seed);
    assert_true(file_exists(in_copy("01_cov2/difference.png")));
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    r = command_run("exercise", "show", "1", NULL);
    command_expect(&r, 0);
    has(&r, "01_cov2/reference.png");
    char *shot = mem_format("%s/shot.png", support_scratch());
    r = command_run("exercise", "show", "1", "--size", "640x320", "--frames", "2", "--screenshot", shot, NULL);
    command_expect(&r, 0);
    assert_true(file_exists(shot));
    mem_free(shot);
    r = command_run("exercise", "show", "20", NULL);
    command_expect_error(&r, 1, "exercise 20 has no picture", NULL);
}

static void the_failing_hit_of_a_long_list_is_shown(void **state) {
    (void)state;
    exercise_files_copy("04_composite/mutants/no_skip.c", "04_composite/composite.c");
    CommandResult r = command_run("exercise", "run", "4", NULL);
    command_expect(&r, 1);
    has(&r, "rung 4 of 7");
    has(&r, " numbers, all 0 but [");
}

static void a_sum_that_begins_nowhere_is_told_so(void **state) {
    (void)state;
    exercise_files_write("01_cov2/cov2.c", "#include \"exercises/exercise.h\"\n"
                                           "void cov2_from_rs(REAL theta, REAL sx, REAL sy, REAL S[3]) {\n"
                                           "    (void)theta, (void)sx, (void)sy;\n"
                                           "    for (int i = 0; i < 3; i++) S[i] += 0;\n"
                                           "}\n");
    CommandResult r = command_run("exercise", "run", "1", NULL);
    command_expect(&r, 1);
    has(&r, "(unwritten)");
    has(&r, "+= needs something to add to");
}

static void hints_come_one_by_one(void **state) {
    (void)state;
    static const char *const counts[] = {"(hint 1 of 4)", "(hint 2 of 4)", "(hint 3 of 4)", "(hint 4 of 4)",
                                         "(hint 4 of 4)"};
    for (int i = 0; i < 5; i++) {
        CommandResult r = command_run("exercise", "hint", "1", NULL);
        command_expect(&r, 0);
        has(&r, counts[i]);
        assert_true((strstr(r.out, "## The line") != NULL) == (i >= 3));
    }
}

static void reset_keeps_what_was_written(void **state) {
    (void)state;
    exercise_files_write("01_cov2/cov2.c", "mine\n");
    CommandResult r = command_run("exercise", "reset", "1", NULL);
    command_expect(&r, 0);
    has(&r, "Your file is kept as ");
    assert_string_equal(exercise_files_text("01_cov2/cov2.c.before-1"), "mine\n");
    assert_non_null(strstr(exercise_files_text("01_cov2/cov2.c"), "NOT_STARTED"));
    exercise_files_write("01_cov2/cov2.c", "mine again\n");
    r = command_run("exercise", "reset", "1", NULL);
    assert_string_equal(exercise_files_text("01_cov2/cov2.c.before-1"), "mine\n");
    assert_string_equal(exercise_files_text("01_cov2/cov2.c.before-2"), "mine again\n");
}

// SHA-256 of "open sesame".
static const char KEY[] = "open sesame",
                  KEY_SHA256[] = "41ef4bb0b23661e66301aac36066912dac037827b4ae63a7b1165a5aa93ed4eb\n";

static void the_solution_opens_by_a_pass_or_the_key(void **state) {
    (void)state;
    CommandResult r = command_run("exercise", "solution", "1", NULL);
    command_expect_error(&r, 1, "opens when yours has passed", NULL);
    r = command_run("exercise", "solution", "1", "--key", KEY, NULL);
    command_expect_error(&r, 1, "no instructor's key is set here", NULL);
    exercise_files_write("instructor.sha256", KEY_SHA256);
    r = command_run("exercise", "solution", "1", "--key", "wrong", NULL);
    command_expect_error(&r, 1, "that is not the key", NULL);
    r = command_run("exercise", "solution", "1", "--key", KEY, NULL);
    command_expect(&r, 0);
    has(&r, "our solution");
    exercise_files_copy("solutions/cov2.c", "01_cov2/cov2.c");
    r = command_run("exercise", "run", "1", NULL);
    r = command_run("exercise", "solution", "1", NULL);
    command_expect(&r, 0);
}

static void the_key_adds_secret_seeds(void **state) {
    (void)state;
    exercise_files_write("instructor.sha256", KEY_SHA256);
    exercise_files_copy("solutions/cov2.c", "01_cov2/cov2.c");
    CommandResult r = command_run("exercise", "run", "1", "--key", "wrong", NULL);
    command_expect_error(&r, 1, "that is not the key", NULL);
    r = command_run("exercise", "run", "1", "--key", KEY, NULL);
    command_expect(&r, 0);
    has(&r, "25 seeds");
}

static void wrong_words_are_wrong_usage(void **state) {
    (void)state;
    CommandResult r = command_run("exercise", "run", NULL);
    command_expect_error(&r, 2, "which one?", NULL);
    r = command_run("exercise", "run", "99", NULL);
    command_expect_error(&r, 2, "there is no exercise '99'", NULL);
    r = command_run("exercise", "wacth", NULL);
    command_expect_error(&r, 2, "did you mean 'watch'?", NULL);
    r = command_run("exercise", "list", "1", NULL);
    command_expect_error(&r, 2, "takes no number", NULL);
    r = command_run("exercise", "run", "1", "--seed", "x", NULL);
    command_expect_error(&r, 2, "--seed x: want a whole number", NULL);
    r = command_run("exercise", "run", "1", "--seed", "18446744073709551616", NULL); // 2^64
    command_expect_error(&r, 2, "want a whole number", NULL);
    r = command_run("exercise", "run", "1", "--sede", "1", NULL);
    command_expect_error(&r, 2, "did you mean --seed?", NULL);
    r = command_run("exercise", "run", "1", "--answer", "no-such.c", NULL);
    command_expect_error(&r, 1, "no-such.c", NULL);
    r = command_run("exercise", "show", "1", "--screenshot", "a.png", NULL);
    command_expect_error(&r, 2, "--frames", NULL);
}

static void what_is_missing_is_said(void **state) {
    (void)state;
    setenv("CC", "no-such-compiler", 1);
    CommandResult r = command_run("exercise", "run", "1", "--answer", in_copy("solutions/cov2.c"), NULL);
    command_expect_error(&r, 1, "cannot start the C compiler 'no-such-compiler'", "set CC", NULL);
    unsetenv("CC");
    support_set_cache("/proc/nowhere");
    r = command_run("exercise", "run", "1", NULL);
    command_expect_error(&r, 1, "set XDG_CACHE_HOME", NULL);
    support_set_cache(NULL);
    setenv("SPLATLAB_WORKERS", "/nowhere", 1);
    exercise_files_write("progress.json", "{");
    r = command_run("exercise", NULL);
    command_expect_error(&r, 1, "progress.json", "remove it", NULL);
}

// A full disk: /dev/full cannot be a folder, so a file stands where the cache should be.
static void a_cache_that_is_no_folder_is_said(void **state) {
    (void)state;
    char *file = mem_format("%s/file", support_scratch());
    FILE *out = fopen(file, "w");
    fclose(out);
    support_set_cache(file);
    CommandResult r = command_run("exercise", "run", "1", NULL);
    command_expect_error(&r, 1, "set XDG_CACHE_HOME to a folder that can be written", NULL);
    support_set_cache(NULL);
    mem_free(file);
}

static void a_folder_that_cannot_be_written_says_what_to_copy(void **state) {
    (void)state;
    if (geteuid() == 0) {
        print_message("skipped: root may write everywhere\n");
        skip();
    }
    assert_int_equal(chmod(in_copy("01_cov2"), 0555), 0);
    CommandResult r = command_run("exercise", "run", "1", NULL);
    chmod(in_copy("01_cov2"), 0755);
    command_expect_error(&r, 1, "to work elsewhere, copy ", NULL);
}

static void the_self_test_keeps_its_json(void **state) {
    (void)state;
    CommandResult r = command_run("exercise", "selftest", "1", "--json", NULL);
    command_expect(&r, 0);
    json_t *o = json_loads(r.out, 0, NULL);
    const json_t *e = json_array_get(json_object_get(o, "exercises"), 0);
    assert_string_equal(json_string_value(json_object_get(e, "name")), "01_cov2");
    assert_true(json_is_true(json_object_get(e, "stub_fails")) && json_is_true(json_object_get(e, "solution_passes")));
    assert_true(json_integer_value(json_object_get(e, "mutants")) >= 4);
    assert_int_equal(json_integer_value(json_object_get(e, "mutants")),
                     json_integer_value(json_object_get(e, "mutants_killed")));
    assert_non_null(json_object_get(e, "mutants_named"));
    assert_non_null(json_object_get(e, "seconds"));
    json_decref(o);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(the_list_lays_the_files_out, fresh),
        cmocka_unit_test_setup(the_list_fits_the_terminal, fresh),
        cmocka_unit_test_setup(a_fresh_stub_fails_kindly_and_a_solution_passes, fresh),
        cmocka_unit_test_setup(a_wrong_answer_is_json_and_can_be_replayed, fresh),
        cmocka_unit_test_setup(the_failing_hit_of_a_long_list_is_shown, fresh),
        cmocka_unit_test_setup(a_sum_that_begins_nowhere_is_told_so, fresh),
        cmocka_unit_test_setup(hints_come_one_by_one, fresh),
        cmocka_unit_test_setup(reset_keeps_what_was_written, fresh),
        cmocka_unit_test_setup(the_solution_opens_by_a_pass_or_the_key, fresh),
        cmocka_unit_test_setup(the_key_adds_secret_seeds, fresh),
        cmocka_unit_test_setup(wrong_words_are_wrong_usage, fresh),
        cmocka_unit_test_setup(what_is_missing_is_said, fresh),
        cmocka_unit_test_setup(a_cache_that_is_no_folder_is_said, fresh),
        cmocka_unit_test_setup(a_folder_that_cannot_be_written_says_what_to_copy, fresh),
        cmocka_unit_test_setup(the_self_test_keeps_its_json, fresh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
