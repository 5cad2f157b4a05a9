// test_wrong_answers.c - answers that are plausible, wrong, and in nobody's list of wrong variants: tests/exercises/wrong/NN_*.c
// for exercise NN. They were thought up after the claims of the exercises had been written. None may pass.
#include "lab/io/file.h"
#include "tests/support/command.h"
#include "tests/support/support.h"

#include <ctype.h>
#include <jansson.h>
#include <string.h>

static const char *const FOLDER = "tests/exercises/wrong";
enum { ANSWERS_MIN = 10 };

static bool is_answer(const char *name) {
    return isdigit((unsigned char)name[0]) && isdigit((unsigned char)name[1]) && name[2] == '_' &&
           file_has_ending(name, ".c");
}

// It compiles, is tried, and fails: by a wrong number or by what it does, not by having been left unwritten.
static void expect_failure(const char *name) {
    char number[3] = {name[0], name[1], 0}, path[512], failed[64] = "";
    snprintf(path, sizeof path, "%s/%s", FOLDER, name);
    CommandResult result = command_run("exercise", "run", number, "--answer", path, "--json", NULL);
    json_error_t error;
    json_t *root = json_loads(result.out, 0, &error);
    if (!root) fail_msg("%s: no JSON: %s\n%s%s", name, error.text, result.out, result.err);
    bool compiled = json_is_true(json_object_get(root, "compiled"));
    bool not_started = json_is_true(json_object_get(root, "not_started"));
    bool passed = json_is_true(json_object_get(root, "passed"));
    size_t i;
    json_t *rung;
    json_array_foreach(json_object_get(root, "rungs"), i,
                       rung) if (!failed[0] && json_is_false(json_object_get(rung, "passed")))
        snprintf(failed, sizeof failed, "%s", json_string_value(json_object_get(rung, "name")));
    json_decref(root);
    if (!compiled) fail_msg("%s does not compile: %s", name, result.out);
    if (not_started) fail_msg("%s still says NOT_STARTED", name);
    if (passed || result.exit_code != 1) fail_msg("%s passes exercise %s", name, number);
    print_message("%s: caught by '%s'\n", name, failed);
}

static void wrong_answers_that_nobody_listed_are_caught(void **state) {
    (void)state;
    char **names;
    int count, answers = 0;
    assert_true(file_list(FOLDER, &names, &count));
    for (int i = 0; i < count; i++) {
        if (!is_answer(names[i])) continue;
        expect_failure(names[i]);
        answers++;
    }
    file_list_free(names, count);
    assert_true(answers >= ANSWERS_MIN);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_answers_that_nobody_listed_are_caught),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
