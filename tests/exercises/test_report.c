// test_report.c - what a person reads: lines that fit, colours only where there are some, and the JSON of a verdict.
#include "exercises/harness/report.h"

#include "exercises/harness/catalogue.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "tests/support/exercise_files.h"
#include "tests/support/support.h"

#include <stdlib.h>
#include <string.h>

static Verdict *verdict;
static const char *root;

static int judge(void **state) {
    Ledger ledger;
    (void)state;
    root = exercise_files_fresh();
    exercise_files_copy("01_cov2/mutants/turned_backwards.c", "01_cov2/cov2.c");
    char *source = exercise_source(root, EXERCISES[0]);
    verdict = mem_alloc(1, sizeof *verdict);
    VerdictOptions options = verdict_options(false, 0);
    options.draws = true;
    if (!ledger_load(root, &ledger) || !verdict_of(root, EXERCISES[0], source, &ledger, &options, verdict))
        fail_msg("%s", fail_text());
    mem_free(source);
    return 0;
}

static int drop(void **state) {
    (void)state;
    verdict_free(verdict);
    mem_free(verdict);
    return 0;
}

static char *text_of(int columns, bool has_colour) {
    char *text = NULL;
    size_t size;
    Page page = {.columns = columns, .has_colour = has_colour, .out = open_memstream(&text, &size)};
    report_text(root, verdict, &page);
    fclose(page.out);
    return text;
}

static void a_failure_says_all_in_its_order(void **state) {
    (void)state;
    char *text = text_of(100, false), *at = text;
    static const char *const parts[] = {
        "ok   unturned", "FAIL direction", "E01 cov2  rung 3 of 6", "  case       cov2_from_rs(",
        "  compared ",   "  yours ",       "  expected ",           "  off by ",
        "  right ",      "  looks like ",  "  pictures ",           "  next ",
        "hint 1",        "--seed 1"};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        at = strstr(at, parts[i]);
        if (!at) fail_msg("'%s' is missing, or too early, in\n%s", parts[i], text);
    }
    free(text);
}

static void lines_fit_the_terminal(void **state) {
    (void)state;
    static const int columns[] = {60, 80, 120};
    for (int i = 0; i < 3; i++) {
        char *text = text_of(columns[i], false);
        for (const char *line = text; *line; line += strcspn(line, "\n") + 1) {
            int length = (int)strcspn(line, "\n");
            bool is_word = strchr(line + 13, ' ') == NULL || strchr(line + 13, ' ') > line + length; // a long path
            if (length > columns[i] && !is_word)
                fail_msg("%d columns, want %d: %.*s", length, columns[i], length, line);
        }
        free(text);
    }
}

static void colours_only_where_they_are_wanted(void **state) {
    (void)state;
    char *plain = text_of(80, false), *coloured = text_of(80, true);
    assert_null(strchr(plain, '\033'));
    assert_non_null(strchr(coloured, '\033'));
    free(plain);
    free(coloured);
    setenv("COLUMNS", "77", 1);
    FILE *file = fopen(support_path(support_scratch(), "page"), "w");
    Page page = page_for(fileno(file), file);
    assert_false(page.has_colour);
    assert_int_equal(page.columns, 77);
    fclose(file);
    unsetenv("COLUMNS");
}

static void the_json_has_what_was_promised(void **state) {
    (void)state;
    json_t *o = report_json(root, verdict);
    assert_true(json_is_false(json_object_get(o, "passed")));
    const json_t *rungs = json_object_get(o, "rungs");
    assert_int_equal(json_array_size(rungs), EXERCISES[0]->rung_count);
    const json_t *good = json_array_get(rungs, 0), *bad = json_array_get(rungs, 2);
    assert_true(json_is_true(json_object_get(good, "passed")));
    assert_string_equal(json_string_value(json_object_get(bad, "name")), "direction");
    assert_true(json_is_false(json_object_get(bad, "passed")));
    static const char *const keys[] = {"expected", "actual", "error", "tolerance", "suspicion", "seed"};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (!json_object_get(bad, keys[i])) fail_msg("no %s", keys[i]);
    assert_string_equal(json_string_value(json_object_get(bad, "suspicion")), "turned_backwards");
    assert_true(json_real_value(json_object_get(bad, "error")) > json_real_value(json_object_get(bad, "tolerance")));
    assert_non_null(json_string_value(json_object_get(o, "picture_difference")));
    json_decref(o);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_failure_says_all_in_its_order),
        cmocka_unit_test(lines_fit_the_terminal),
        cmocka_unit_test(colours_only_where_they_are_wanted),
        cmocka_unit_test(the_json_has_what_was_promised),
    };
    return cmocka_run_group_tests(tests, judge, drop);
}
