// test_wrong_answers.c - answers to the exercises that are in nobody's list, NN_*.c for exercise NN.
//
// tests/exercises/wrong: plausible, wrong, and not among the wrong variants that the exercise knows by name; they were thought up
// after its claims had been written. None may pass.
// tests/exercises/right: right, but computed by another way than ours, so that roundings fall otherwise. All must pass: the
// tolerances are meant to tell wrong from right, and not other from ours.
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "tests/support/command.h"
#include "tests/support/support.h"

#include <ctype.h>
#include <jansson.h>

enum { WRONG_MIN = 10, RIGHT_MIN = 5 };

typedef struct {
    bool compiled, not_started, passed;
    char failed[64]; // the first claim that does not hold, "" for none
    int exit_code;
} Outcome;

static bool is_answer(const char *name) {
    return isdigit((unsigned char)name[0]) && isdigit((unsigned char)name[1]) && name[2] == '_' &&
           file_has_ending(name, ".c");
}

static bool is_set(const json_t *object, const char *key) { return json_is_true(json_object_get(object, key)); }

static Outcome outcome_of(const char *path, const char *name) {
    const char number[3] = {name[0], name[1], 0};
    CommandResult result = command_run("exercise", "run", number, "--answer", path, "--json", NULL);
    json_error_t error;
    json_t *root = json_loads(result.out, 0, &error), *rung;
    size_t i;
    if (!root) fail_msg("%s: no JSON: %s\n%s%s", path, error.text, result.out, result.err);
    Outcome o = {.compiled = is_set(root, "compiled"),
                 .not_started = is_set(root, "not_started"),
                 .passed = is_set(root, "passed"),
                 .exit_code = result.exit_code};
    json_array_foreach(json_object_get(root, "rungs"), i, rung) {
        if (!o.failed[0] && !is_set(rung, "passed"))
            snprintf(o.failed, sizeof o.failed, "%s", json_string_value(json_object_get(rung, "name")));
    }
    if (!o.compiled) fail_msg("%s does not compile:\n%s", path, result.out);
    json_decref(root);
    return o;
}

// Tries all answers of the folder; returns how many there are.
static int try_all(const char *folder, bool are_right) {
    char **names;
    int count, answers = 0;
    assert_true(file_list(folder, &names, &count));
    for (int i = 0; i < count; i++) {
        if (!is_answer(names[i])) continue;
        char *path = file_join(folder, names[i]);
        Outcome o = outcome_of(path, names[i]);
        if (o.not_started) fail_msg("%s still says NOT_STARTED", path);
        if (o.passed != are_right || o.exit_code != (are_right ? 0 : 1))
            fail_msg("%s %s (%s), exit code %d", path, o.passed ? "passes" : "fails", o.failed, o.exit_code);
        print_message("%s: %s%s\n", path, are_right ? "passes" : "caught by ", o.failed);
        mem_free(path);
        answers++;
    }
    file_list_free(names, count);
    return answers;
}

static void wrong_answers_that_nobody_listed_are_caught(void **state) {
    (void)state;
    assert_true(try_all("tests/exercises/wrong", false) >= WRONG_MIN);
}

static void right_answers_of_another_kind_pass(void **state) {
    (void)state;
    assert_true(try_all("tests/exercises/right", true) >= RIGHT_MIN);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_answers_that_nobody_listed_are_caught),
        cmocka_unit_test(right_answers_of_another_kind_pass),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
