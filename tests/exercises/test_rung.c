// test_rung.c - cases, the search for the smallest one, and what a trial keeps of it; with the compiler and the worker underneath.
#include "exercises/harness/rung.h"

#include "exercises/harness/catalogue.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "tests/support/exercise_files.h"
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static Subject *subjects[PRECISION_COUNT];
static const double TOLERANCE[PRECISION_COUNT] = {1e-5, 1e-12};
static const uint64_t SEEDS[] = {1, 2, 3};

// Compiles cov2.c with that body and starts it.
static void answer(const char *body) {
    const char *root = exercise_files_fresh();
    char *text = mem_format("#include \"exercises/exercise.h\"\n"
                            "void cov2_from_rs(REAL theta, REAL sx, REAL sy, REAL S[3]) {\n%s\n"
                            "    (void)theta, (void)sx, (void)sy, (void)S;\n}\n",
                            body);
    exercise_files_write("01_cov2/cov2.c", text);
    mem_free(text);
    char *source = exercise_path(root, EXERCISES[0], "cov2.c"),
         *calls = exercise_path(root, EXERCISES[0], "check_calls.c");
    for (int p = 0; p < PRECISION_COUNT; p++) {
        BuildJob job = {.root = root, .source = source, .calls = calls, .precision = (Precision)p};
        assert_true(build_all(&job, 1));
        if (!job.object) fail_msg("%s", job.diagnostics);
        assert_non_null(subjects[p] = subject_start(job.object, "cov2.c"));
        build_free(&job);
    }
    mem_free(source);
    mem_free(calls);
}

static int stop(void **state) {
    (void)state;
    for (int p = 0; p < PRECISION_COUNT; p++) {
        subject_stop(subjects[p]);
        subjects[p] = NULL;
    }
    return 0;
}

static void draw(Rng *rng, int k, double *in) {
    (void)k;
    for (int i = 0; i < 3; i++) in[i] = rng_range(rng, 1, 100);
}

static bool is_positive(const double *in) { return in[1] > 0 && in[2] > 0; }

static void sum_of_squares(Trial *t, const double *in) {
    double theta = in[0], sx = in[1], sy = in[2], S[3];
    CALL(trial_call, t, "cov2_from_rs", IN(theta), IN(sx), IN(sy), OUT_ARRAY(S, 3));
    trial_near1(t, "S[0]", S[0], sx * sx + sy * sy, 1e4);
}

static Rung rung_of(bool (*allows)(const double *)) {
    return (Rung){.name = "sum", .claim = "", .count = 3, .draw = draw, .allows = allows, .check = sum_of_squares};
}

static RungResult run(const Rung *rung) {
    RungResult result;
    rung_run(rung, subjects, TOLERANCE, SEEDS, 3, &result);
    return result;
}

static void a_right_answer_passes_all_cases_in_both_precisions(void **state) {
    (void)state;
    answer("S[0] = sx * sx + sy * sy, S[1] = S[2] = 0;");
    Rung rung = rung_of(NULL);
    RungResult r = run(&rung);
    assert_true(r.ran && r.passed);
    assert_int_equal(r.cases, 2 * 3 * RUNG_CASES);
    assert_int_equal(r.failed_cases, 0);
    assert_true(r.own_error[PRECISION_FLOAT] > 0 && r.own_error[PRECISION_FLOAT] < 1e-6);
}

static void a_failing_case_is_made_small(void **state) {
    (void)state;
    answer("S[0] = sy > 10 ? 0 : sx * sx + sy * sy, S[1] = S[2] = 0;");
    Rung rung = rung_of(is_positive);
    RungResult r = run(&rung);
    assert_false(r.passed);
    assert_int_equal(r.precision, PRECISION_DOUBLE);
    support_near(r.in[0], 0, 0, "what does not matter becomes 0");
    support_near(r.in[1], 1, 0, "what must be positive becomes 1");
    assert_true(r.in[2] > 10 && r.in[2] <= 20 && r.in[2] == floor(r.in[2])); // as small as it still fails
    assert_non_null(strstr(r.failure.call, "cov2_from_rs(theta = 0, sx = 1, sy = "));
}

static void a_smaller_case_stays_a_case(void **state) {
    (void)state;
    answer("S[0] = S[1] = S[2] = 0;");
    Rung rung = rung_of(is_positive);
    RungResult r = run(&rung);
    assert_true(is_positive(r.in));
    assert_true(r.in[1] == 1 && r.in[2] == 1);
}

static void what_fails_in_float_alone_is_told_so(void **state) {
    (void)state;
    answer("S[0] = sizeof(REAL) == 4 ? 0 : sx * sx + sy * sy, S[1] = S[2] = 0;");
    Rung rung = rung_of(NULL);
    RungResult r = run(&rung);
    assert_false(r.passed);
    assert_int_equal(r.precision, PRECISION_FLOAT);
    rung.double_only = true;
    assert_true(run(&rung).passed);
}

static void numbers_that_nobody_wrote_and_nan_never_pass(void **state) {
    (void)state;
    answer("S[1] = S[2] = 0;");
    Rung rung = rung_of(NULL);
    RungResult r = run(&rung);
    assert_false(r.passed);
    assert_true(number_is_unwritten(r.failure.yours[0]));
    stop(NULL);
    answer("S[0] = 0 * (sx / 0), S[1] = S[2] = 0;");
    r = run(&rung);
    assert_false(r.passed);
    assert_true(isnan(r.failure.yours[0]) && !number_is_unwritten(r.failure.yours[0]) && isinf(r.failure.error));
}

static void the_same_seed_draws_the_same_case_and_floats(void **state) {
    (void)state;
    Rung rung = rung_of(NULL);
    double a[RUNG_NUMBERS_MAX], b[RUNG_NUMBERS_MAX];
    rung_draw(&rung, 7, 3, a);
    rung_draw(&rung, 7, 3, b);
    assert_memory_equal(a, b, sizeof a);
    assert_true(a[0] == (double)(float)a[0]);
    rung_draw(&rung, 8, 3, b);
    assert_true(a[0] != b[0]);
}

static void a_compiler_error_names_the_students_line(void **state) {
    (void)state;
    const char *root = exercise_files_fresh();
    exercise_files_write("01_cov2/cov2.c",
                         "#include \"exercises/exercise.h\"\nvoid cov2_from_rs(REAL theta) {\n    oops;\n}\n");
    char *source = exercise_path(root, EXERCISES[0], "cov2.c"),
         *calls = exercise_path(root, EXERCISES[0], "check_calls.c");
    BuildJob job = {.root = root, .source = source, .calls = calls, .precision = PRECISION_DOUBLE};
    assert_true(build_all(&job, 1));
    assert_null(job.object);
    assert_non_null(strstr(job.diagnostics, "cov2.c:3:5: error: "));
    build_free(&job);
    setenv("CC", "no-such-compiler", 1);
    job = (BuildJob){.root = root, .source = source, .calls = calls};
    assert_false(build_all(&job, 1));
    assert_non_null(strstr(fail_text(), "cannot start the C compiler 'no-such-compiler'"));
    unsetenv("CC");
    build_free(&job);
    mem_free(source);
    mem_free(calls);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_right_answer_passes_all_cases_in_both_precisions, stop),
        cmocka_unit_test_teardown(a_failing_case_is_made_small, stop),
        cmocka_unit_test_teardown(a_smaller_case_stays_a_case, stop),
        cmocka_unit_test_teardown(what_fails_in_float_alone_is_told_so, stop),
        cmocka_unit_test_teardown(numbers_that_nobody_wrote_and_nan_never_pass, stop),
        cmocka_unit_test(the_same_seed_draws_the_same_case_and_floats),
        cmocka_unit_test(a_compiler_error_names_the_students_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
