// test_suspicion.c - mistakes written by other hands: the same misconception in other code must get the name of the wrong variant.
//
// `selftest` compares the wrong variants with themselves, which is easy; these are the honest measure.
#include "exercises/harness/suspicion.h"

#include "exercises/harness/verdict.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "tests/support/exercise_files.h"
#include "tests/support/support.h"

#include <stdlib.h>
#include <string.h>

typedef struct {
    const char *exercise, *mistake; // the name that is hoped for
    const char *body;               // of the function, or of the kernel
} Rewriting;

static const Rewriting REWRITINGS[] = {
    {"cov2", "scale_is_variance",
     "REAL c = cos(theta), s = sin(theta), a = (sx + sy) / 2, d = (sx - sy) / 2;\n"
     "S[0] = a + d * (c * c - s * s); S[1] = 2 * d * s * c; S[2] = a - d * (c * c - s * s);"},
    {"cov2", "scale_is_variance",
     "REAL R[4] = {cos(theta), -sin(theta), sin(theta), cos(theta)}, D[2] = {sx, sy};\n"
     "S[0] = S[1] = S[2] = 0;\n"
     "for (int k = 0; k < 2; k++) S[0] += R[k] * D[k] * R[k], S[1] += R[k] * D[k] * R[2 + k], S[2] += R[2 + k] * D[k] "
     "* R[2 + k];"},
    {"cov2", "turned_backwards",
     "REAL a = (sx * sx + sy * sy) / 2, d = (sx * sx - sy * sy) / 2;\n"
     "S[0] = a + d * cos(2 * theta); S[1] = -d * sin(2 * theta); S[2] = a - d * cos(2 * theta);"},
    {"cov2", "turned_backwards",
     "REAL ux = cos(theta) * sx, uy = -sin(theta) * sx, vx = sin(theta) * sy, vy = cos(theta) * sy;\n"
     "S[0] = ux * ux + vx * vx; S[1] = ux * uy + vx * vy; S[2] = uy * uy + vy * vy;"},
    {"cov2", "degrees",
     "REAL a = (sx * sx + sy * sy) / 2, d = (sx * sx - sy * sy) / 2, t = theta * (REAL)M_PI / 90;\n"
     "S[0] = a + d * cos(t); S[1] = d * sin(t); S[2] = a - d * cos(t);"},
    {"cov2", "degrees",
     "REAL t = theta / 180 * (REAL)M_PI, ux = cos(t) * sx, uy = sin(t) * sx, vx = -sin(t) * sy, vy = cos(t) * sy;\n"
     "S[0] = ux * ux + vx * vx; S[1] = ux * uy + vx * vy; S[2] = uy * uy + vy * vy;"},
    {"cov2", "off_diagonal_sum",
     "REAL c = cos(theta), s = sin(theta), x = sx * sx, y = sy * sy;\n"
     "S[0] = x - s * s * (x - y); S[1] = (x + y) * sin(2 * theta) / 2; S[2] = y + s * s * (x - y); (void)c;"},
    {"cov2", "rotated_once",
     "REAL c = cos(theta), s = sin(theta);\n"
     "S[0] = pow(sx, 2) * c; S[2] = pow(sy, 2) * c; S[1] = -pow(sy, 2) * s;"},
    {"cov2", "off_diagonal_sum",
     "REAL ux = cos(theta) * sx, uy = sin(theta) * sx, vx = sin(theta) * sy, vy = cos(theta) * sy;\n"
     "S[0] = ux * ux + vx * vx; S[1] = ux * uy + vx * vy; S[2] = uy * uy + vy * vy;"},
    {"adam", "no_bias_correction",
     "m[i] += (1 - b1) * (g[i] - m[i]); v[i] = mix(g[i] * g[i], v[i], b2); p[i] = fma(-lr, m[i] / (eps + sqrt(v[i])), "
     "p[i]);"},
    {"adam", "eps_inside_root",
     "REAL a = m[i] * b1 + g[i] * (1 - b1), b = v[i] * b2 + g[i] * g[i] * (1 - b2); m[i] = a; v[i] = b;\n"
     "p[i] = p[i] - lr * rsqrt(eps + b / (1 - pow(b2, (REAL)t))) * a / (1 - pow(b1, (REAL)t));"},
    {"adam", "old_moments",
     "REAL a = m[i], b = v[i]; p[i] -= lr * (a / (1 - pown(b1, t))) / (sqrt(b / (1 - pown(b2, t))) + eps);\n"
     "m[i] = a + (1 - b1) * (g[i] - a); v[i] = b + (1 - b2) * (g[i] * g[i] - b);"},
};
enum { REWRITING_COUNT = sizeof REWRITINGS / sizeof *REWRITINGS };
static const double NAMED_PART = 0.9;

static char *source_of(const Rewriting *r) {
    if (strcmp(r->exercise, "adam") == 0)
        return mem_format(
            "kernel void adam(int n, global REAL *p, global const REAL *g, global REAL *m, global REAL *v, "
            "REAL lr, REAL b1, REAL b2, REAL eps, int t) {\nint i = get_global_id(0);\nif (i >= n) return;\n%s\n}\n",
            r->body);
    return mem_format(
        "#include \"exercises/exercise.h\"\nvoid cov2_from_rs(REAL theta, REAL sx, REAL sy, REAL S[3]) {\n%s\n}\n",
        r->body);
}

// The name that the first wrong rung gives; "" for none.
static void name_of(const Rewriting *r, int number, char name[SUSPICION_NAME_BYTES]) {
    const char *build = getenv("BUILD");
    const Exercise *exercise;
    Ledger ledger;
    Verdict *v = mem_alloc(1, sizeof *v);
    VerdictOptions options = verdict_options(false, 0);
    assert_true(exercise_find(r->exercise, &exercise) && ledger_load("exercises", &ledger));
    // Under the same name each time, so that it is compiled once.
    char *text = source_of(r), *path = mem_format("%s/tests/exercises/rewriting_%d%s", build ? build : "build/release",
                                                  number, exercise->is_kernel ? ".cl" : ".c");
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    fputs(text, out);
    fclose(out);
    if (!verdict_of("exercises", exercise, path, &ledger, &options, v)) fail_msg("%s", fail_text());
    if (!v->compiled) fail_msg("%s", v->diagnostics);
    if (v->passed) fail_msg("this passes:\n%s", text);
    snprintf(name, SUSPICION_NAME_BYTES, "%s", v->suspicions[verdict_first_failed(v)].name);
    mem_free(text);
    mem_free(path);
    verdict_free(v);
    mem_free(v);
}

static void mistakes_of_other_hands_are_named(void **state) {
    (void)state;
    int named = 0;
    for (int i = 0; i < REWRITING_COUNT; i++) {
        char name[SUSPICION_NAME_BYTES];
        name_of(&REWRITINGS[i], i, name);
        bool is_right = strcmp(name, REWRITINGS[i].mistake) == 0;
        named += is_right;
        if (!is_right)
            print_message("%s %d is called '%s', want '%s'\n", REWRITINGS[i].exercise, i, name, REWRITINGS[i].mistake);
    }
    print_message("%d of %d named rightly\n", named, REWRITING_COUNT);
    assert_true(named >= NAMED_PART * REWRITING_COUNT);
}

static void what_is_no_known_mistake_gets_no_name(void **state) {
    (void)state;
    static const Rewriting unknown[] = {{"cov2", "", "S[0] = sx; S[1] = theta; S[2] = sy * sy;"},
                                        {"cov2", "",
                                         "REAL c = cos(theta), s = sin(theta); S[0] = c * c * sx * sx; S[1] = c * s * "
                                         "sx * sx; S[2] = s * s * sx * sx; (void)sy;"}};
    for (int i = 0; i < 2; i++) {
        char name[SUSPICION_NAME_BYTES];
        name_of(&unknown[i], 100 + i, name);
        assert_string_equal(name, "");
    }
}

static void a_variant_speaks_by_its_first_comment(void **state) {
    (void)state;
    char name[SUSPICION_NAME_BYTES], text[SUSPICION_BYTES];
    const char *path = support_path(support_scratch(), "wrong.c");
    static const char content[] = "// wrong.c - what is\n// wrong here.\n\nint x;\n";
    FILE *out = fopen(path, "w");
    fputs(content, out);
    fclose(out);
    assert_true(suspicion_describe(path, name, text));
    assert_string_equal(name, "wrong");
    assert_string_equal(text, "what is wrong here.");
}

int main(void) {
    exercise_files_fresh(); // for the workers' place; the exercises themselves are read in the tree
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mistakes_of_other_hands_are_named),
        cmocka_unit_test(what_is_no_known_mistake_gets_no_name),
        cmocka_unit_test(a_variant_speaks_by_its_first_comment),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
