// test_build_includes.c - what an answer includes is part of what it is compiled from.
#include "exercises/harness/build.h"

#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "tests/support/support.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void write_text(const char *path, const char *text) { assert_true(file_write(path, text, strlen(text))); }

// A folder of exercises with the real headers.
static const char *make_root(const char *scratch) {
    char *here = realpath("exercises", NULL);
    static const char *const NAMES[] = {"exercise.h", "calls.h", "solutions"};
    const char *root = support_path(scratch, "exercises");
    assert_true(file_make_folder(root));
    for (size_t i = 0; i < sizeof NAMES / sizeof *NAMES; i++) {
        char *from = file_join(here, NAMES[i]), *to = file_join(root, NAMES[i]);
        assert_int_equal(symlink(from, to), 0);
        mem_free(from);
        mem_free(to);
    }
    free(here);
    return root;
}

// The library's path, owned by the caller.
static char *library_of(const char *root, const char *source) {
    BuildJob job = {
        .root = root, .source = source, .calls = "exercises/01_cov2/check_calls.c", .precision = PRECISION_DOUBLE};
    assert_true(build_all(&job, 1));
    if (!job.object) fail_msg("%s", job.diagnostics);
    char *library = mem_text(job.object);
    build_free(&job);
    return library;
}

static void a_change_in_what_an_answer_includes_is_seen(void **state) {
    (void)state;
    static const char PART[] = "static REAL part(REAL x) { return x; }\n";
    static const char OTHER[] = "static REAL part(REAL x) { return 2 * x; }\n";
    static const char ANSWER[] = "#include \"exercises/exercise.h\"\n#include \"exercises/part.c\"\n"
                                 "void cov2_from_rs(REAL theta, REAL sx, REAL sy, REAL S[3]) {\n"
                                 "    S[0] = part(theta), S[1] = sx, S[2] = sy;\n}\n";
    const char *scratch = support_scratch(), *root = make_root(scratch);
    const char *part = support_path(root, "part.c"), *source = support_path(scratch, "answer.c");
    write_text(part, PART);
    write_text(source, ANSWER);
    char *first = library_of(root, source), *again = library_of(root, source);
    assert_string_equal(first, again);
    write_text(part, OTHER);
    char *changed = library_of(root, source);
    assert_string_not_equal(first, changed);
    mem_free(first);
    mem_free(again);
    mem_free(changed);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_change_in_what_an_answer_includes_is_seen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
