#include "lab/base/mem.h"
#include "tests/support/command.h"
#include "tests/support/support.h"

#include <stdlib.h>
#include <string.h>

static const char *const COMMANDS[] = {"scene", "info", "train", "eval", "render", "devices"};
enum { COMMAND_COUNT = sizeof COMMANDS / sizeof COMMANDS[0] };

static void without_arguments_and_with_help_the_commands_are_listed(void **state) {
    (void)state;
    static const char *const ways[] = {NULL, "--help", "-h", "help"};
    for (int w = 0; w < 4; w++) {
        CommandResult r = command_run(ways[w], NULL);
        command_expect(&r, 0);
        for (int c = 0; c < COMMAND_COUNT; c++) assert_non_null(strstr(r.out, COMMANDS[c]));
        assert_string_equal(r.err, "");
    }
}

static void every_command_has_its_help_on_stdout(void **state) {
    (void)state;
    for (int c = 0; c < COMMAND_COUNT; c++) {
        CommandResult r = command_run(COMMANDS[c], "--help", NULL);
        command_expect(&r, 0);
        assert_string_equal(r.err, "");
        char *usage = mem_format("Usage: splatlab %s", COMMANDS[c]);
        assert_true(strncmp(r.out, usage, strlen(usage)) == 0);
        assert_non_null(strstr(r.out, "--json"));
        assert_non_null(strstr(r.out, "  splatlab ")); // an example
        mem_free(usage);

        char *same = mem_text(r.out);
        r = command_run("help", COMMANDS[c], NULL);
        command_expect(&r, 0);
        assert_string_equal(r.out, same);
        mem_free(same);
    }
}

static void the_version_is_one_line(void **state) {
    (void)state;
    CommandResult r = command_run("--version", NULL);
    command_expect(&r, 0);
    assert_true(strncmp(r.out, "splatlab ", 9) == 0);
    assert_ptr_equal(strchr(r.out, '\n'), r.out + strlen(r.out) - 1);
}

static void an_unknown_command_is_wrong_usage_with_a_suggestion(void **state) {
    (void)state;
    CommandResult r = command_run("trian", NULL);
    command_expect_error(&r, 2, "no command 'trian'", "did you mean 'train'?", NULL);
    r = command_run("xyzzy", NULL);
    command_expect_error(&r, 2, "no command 'xyzzy'", "--help", NULL);
    r = command_run("help", "rendr", NULL);
    command_expect_error(&r, 2, "did you mean 'render'?", NULL);
}

static void every_command_refuses_an_unknown_option(void **state) {
    (void)state;
    for (int c = 0; c < COMMAND_COUNT; c++) {
        CommandResult r = command_run(COMMANDS[c], "--jsno", NULL);
        command_expect_error(&r, 2, COMMANDS[c], "did you mean --json?", NULL);
    }
}

static void what_a_command_works_on_must_be_named(void **state) {
    (void)state;
    static const char *const commands[] = {"scene", "info", "train", "eval", "render"};
    for (size_t c = 0; c < sizeof commands / sizeof commands[0]; c++) {
        CommandResult r = command_run(commands[c], NULL);
        command_expect_error(&r, 2, "splatlab ", NULL);
        r = command_run(commands[c], "a", "b", NULL);
        command_expect_error(&r, 2, "'b' is one argument too many", NULL);
    }
}

static void a_result_that_cannot_be_written_is_a_failure(void **state) {
    (void)state;
    const char *program = getenv("SPLATLAB");
    char *command = mem_format("'%s' --help >/dev/full 2>/dev/null", program ? program : "./splatlab");
    assert_int_equal(WEXITSTATUS(system(command)), 1);
    mem_free(command);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_arguments_and_with_help_the_commands_are_listed),
        cmocka_unit_test(every_command_has_its_help_on_stdout),
        cmocka_unit_test(the_version_is_one_line),
        cmocka_unit_test(an_unknown_command_is_wrong_usage_with_a_suggestion),
        cmocka_unit_test(every_command_refuses_an_unknown_option),
        cmocka_unit_test(what_a_command_works_on_must_be_named),
        cmocka_unit_test(a_result_that_cannot_be_written_is_a_failure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
