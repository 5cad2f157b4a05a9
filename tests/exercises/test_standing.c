// test_standing.c - the files that are read back: progress, ledger, hints. What is malformed is said and stays as it is.
#include "exercises/harness/standing.h"

#include "exercises/harness/hints.h"
#include "exercises/harness/kernel_scan.h"
#include "exercises/harness/oclgrind_report.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "tests/support/exercise_files.h"
#include "tests/support/support.h"

#include <string.h>

static void progress_comes_back(void **state) {
    (void)state;
    const char *root = exercise_files_fresh();
    Standing all[EXERCISE_COUNT], again[EXERCISE_COUNT];
    assert_true(standing_load(root, all));
    for (int i = 0; i < EXERCISE_COUNT; i++) assert_int_equal(all[i].runs, 0);
    all[0] = (Standing){.passed = {true, false, true}, .solved = true, .runs = 3, .hints = 2};
    assert_true(standing_save(root, all) && standing_load(root, again));
    assert_memory_equal(all, again, sizeof all);
    assert_int_equal(standing_rungs(&again[0], EXERCISES[0]), 2);
}

static void a_broken_progress_file_is_said_and_kept(void **state) {
    (void)state;
    const char *root = exercise_files_fresh();
    static const char *const broken[] = {
        "{", "{\"01_cov2\": {\"passed\": 3, \"solved\": true}}",
        "{\"01_cov2\": {\"passed\": [], \"solved\": true, \"runs\": \"x\", \"hints\": 0}}"};
    for (int i = 0; i < 3; i++) {
        Standing all[EXERCISE_COUNT];
        exercise_files_write("progress.json", broken[i]);
        assert_false(standing_load(root, all));
        assert_non_null(strstr(fail_text(), "progress.json"));
        assert_non_null(strstr(fail_text(), "mend the file, or remove it"));
        assert_string_equal(exercise_files_text("progress.json"), broken[i]);
    }
}

static void a_broken_ledger_is_said_with_its_line(void **state) {
    (void)state;
    const char *root = exercise_files_fresh();
    Ledger ledger;
    assert_true(ledger_load(root, &ledger));
    assert_true(ledger.own_error[0][0][PRECISION_DOUBLE] >= 0);
    exercise_files_write("ledger.txt", "# a comment\n01_cov2 unturned float x double 1\n");
    assert_false(ledger_load(root, &ledger));
    assert_non_null(strstr(fail_text(), "ledger.txt, line 2: want"));
    exercise_files_write("ledger.txt", "01_cov2 unturned float 1e-7 double 1e-16\n");
    assert_false(ledger_load(root, &ledger));
    assert_non_null(strstr(fail_text(), "has no line for 01_cov2 eigenvalues"));
    assert_non_null(strstr(fail_text(), "--write-ledger"));
}

static void tolerances_come_from_the_ledger(void **state) {
    (void)state;
    support_near(ledger_tolerance(1e-3, PRECISION_DOUBLE), 1e-2, 1e-12, "ten times");
    assert_true(ledger_tolerance(0, PRECISION_DOUBLE) > 1e-14 && ledger_tolerance(0, PRECISION_DOUBLE) < 2e-14);
    assert_true(ledger_tolerance(0, PRECISION_FLOAT) > 5e-6 && ledger_tolerance(0, PRECISION_FLOAT) < 1e-5);
}

static void every_exercise_has_four_hints_a_page_and_its_files(void **state) {
    (void)state;
    const char *root = exercise_files_fresh();
    static const char *const HEADS[HINT_COUNT] = {"## A question\n", "## The formula\n", "## Where\n", "## The line\n"};
    for (int i = 0; i < EXERCISE_COUNT; i++)
        for (int h = 0; h < HINT_COUNT; h++) {
            char *text;
            if (!hints_read(root, EXERCISES[i], h, &text)) fail_msg("%s", fail_text());
            if (strncmp(text, HEADS[h], strlen(HEADS[h])) != 0)
                fail_msg("hint %d of %s: %s", h, EXERCISES[i]->name, text);
            mem_free(text);
        }
    char *text;
    exercise_files_write("01_cov2/hints.md", "# Hints\n\n## A question\n");
    assert_false(hints_read(root, EXERCISES[0], 0, &text));
    assert_non_null(strstr(fail_text(), "has 1 hints, want 4 sections"));
}

static void what_is_not_started_is_found_in_its_kernel(void **state) {
    (void)state;
    static const char text[] = "// NOT_STARTED\n/* kernel void a( NOT_STARTED { */\n"
                               "kernel void a(int n) {\n    if (n) { n++; }\n}\n"
                               "__kernel void b(int n) {\n    NOT_STARTED; // here\n}\n";
    int line = 0;
    assert_false(kernel_scan_not_started(text, "a", &line));
    assert_true(kernel_scan_not_started(text, "b", &line));
    assert_int_equal(line, 7);
    // A function that both may call.
    assert_true(
        kernel_scan_not_started("float f(float x) { NOT_STARTED; return x; }\nkernel void a() { }", "a", &line));
    assert_int_equal(line, 1);
}

static void an_oclgrind_report_becomes_a_sentence(void **state) {
    (void)state;
    static const char log[] =
        "\nRead-write data race at global memory address 0x2000000000008\n\tKernel: adam\n\n"
        "\tFirst entity:  Global(2,0,0) Local(2,0,0) Group(0,0,0)\n\t  store double\n"
        "\tAt line 10 (column 10) of /somewhere/adam.cl:\n\n"
        "\tSecond entity: Global(1,0,0) Local(1,0,0) Group(0,0,0)\n\tAt line 9 (column 1) of adam.cl\n";
    FILE *stream = fmemopen((void *)log, strlen(log), "r");
    char text[256];
    assert_true(oclgrind_report_read(stream, text, sizeof text));
    assert_string_equal(text, "Read-write data race, work-items (2,0,0) and (1,0,0), line 10 of adam.cl");
    assert_false(oclgrind_report_read(stream, text, sizeof text)); // nothing new
    fclose(stream);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(progress_comes_back),
        cmocka_unit_test(a_broken_progress_file_is_said_and_kept),
        cmocka_unit_test(a_broken_ledger_is_said_with_its_line),
        cmocka_unit_test(tolerances_come_from_the_ledger),
        cmocka_unit_test(every_exercise_has_four_hints_a_page_and_its_files),
        cmocka_unit_test(what_is_not_started_is_found_in_its_kernel),
        cmocka_unit_test(an_oclgrind_report_becomes_a_sentence),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
