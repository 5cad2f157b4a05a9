// test_attacks.c - code that crashes, hangs, floods, ends its process, forges or meddles: it is named, nobody passes by it, and the
// runner goes on.
#include "exercises/harness/verdict.h"
#include "lab/base/clock.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "tests/support/support.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct {
    const char *name;
    const char *outside, *inside; // of the function; THIS: its number
    TroubleKind kind;             // TROUBLE_NONE: the call came back, without the right numbers
    const char *text;             // what the message says
} Attack;

static const Attack ATTACKS[] = {
    {"a segfault", "", "*(volatile int *)8 = 1;", TROUBLE_CRASHED, "a NULL pointer was followed"},
    {"an endless loop", "", "for (volatile int i = 0;; i++) continue;", TROUBLE_TIMEOUT,
     "did not come back within 2 s"},
    {"a sleep", "", "sleep(60);", TROUBLE_TIMEOUT, "did not come back within 2 s"},
    {"a sleep with its output closed", "", "close(1); close(2); sleep(60);", TROUBLE_TIMEOUT,
     "did not come back within 2 s"},
    {"4 GB", "", "volatile char *p = malloc((size_t)4 << 30); p[0] = 1; S[0] = p[0];", TROUBLE_MEMORY,
     "4.29e+03 MB of memory, which was refused"},
    {"a flood", "", "for (;;) puts(\"flood flood flood\");", TROUBLE_FLOOD, "printed more than 1 MB"},
    {"exit(0)", "", "exit(0);", TROUBLE_ENDED, "ended the whole process with exit code 0"},
    {"_exit(0)", "", "_exit(0);", TROUBLE_ENDED, "ended the whole process with exit code 0"},
    {"exit(0) before the first call",
     "__attribute__((constructor)) static void first(void) { if (atoi(getenv(\"ATTACK\")) == THIS) _exit(0); }", "",
     TROUBLE_ENDED, "ended the whole process"},
    {"abort()", "", "abort();", TROUBLE_CRASHED, "Aborted"},
    {"a stack overflow", "int deep(volatile int *p) { volatile int a[999]; a[0] = *p + 1; return deep(a) + a[0]; }",
     "volatile int z = 0; S[0] = deep(&z);", TROUBLE_CRASHED, "Segmentation fault"},
    {"a division by zero", "", "volatile int z = 0; S[0] = 7 % z;", TROUBLE_CRASHED, "divided an integer by zero"},
    {"a kill of the judge", "", "kill(getppid(), SIGKILL);", TROUBLE_NONE, ""},
    {"a kill of everybody", "", "kill(0, SIGTERM); kill(-getppid(), SIGTERM);", TROUBLE_NONE, ""},
    {"a fork bomb", "", "for (int i = 0; i < 20; i++) fork();", TROUBLE_NONE, ""},
    {"a shell", "", "if (system(\"echo x >FORGED\") == 0) S[0] = 1;", TROUBLE_NONE, ""},
    {"a file written", "", "FILE *f = fopen(\"FORGED\", \"w\"); if (f) fputs(\"x\", f), fclose(f);", TROUBLE_NONE, ""},
    {"a forged verdict on stdout", "", "puts(\"{\\\"passed\\\": true}\\nE01 cov2: passed, all 6 rungs\");",
     TROUBLE_NONE, ""},
    {"forged answers in the channel", "", "char z[4096] = {0}; if (write(3, z, sizeof z) < 0) S[0] = 1;",
     TROUBLE_MEDDLING, "wrote into the channel"},
    {"a number behind the output", "", "S[0] = S[1] = S[2] = 0; S[3] = 1;", TROUBLE_WROTE_OUTSIDE, "S[3]"},
    {"a number before the output", "", "S[0] = S[1] = S[2] = 0; S[-1] = 1;", TROUBLE_WROTE_OUTSIDE, "S[-1]"},
    {"a jump to nowhere", "#include <setjmp.h>\nstatic jmp_buf b;", "longjmp(b, 1);", TROUBLE_ENDED,
     "Segmentation fault"},
    {"all files closed", "", "for (int i = 0; i < 256; i++) close(i);", TROUBLE_ENDED, ""},
    {"ignored signals", "", "signal(SIGSEGV, SIG_IGN); *(volatile int *)8 = 1;", TROUBLE_ENDED, "Segmentation fault"},
    {"a handler that returns", "static void h(int n) { (void)n; _exit(0); }",
     "signal(SIGSEGV, h); *(volatile int *)8 = 1;", TROUBLE_ENDED, "exit code 0"},
    {"an alarm", "", "alarm(1); for (volatile int i = 0;; i++) continue;", TROUBLE_ENDED, "Alarm clock"},
    {"a kill of itself", "", "kill(getpid(), SIGKILL);", TROUBLE_ENDED, "Killed"},
};
enum { ATTACK_COUNT = sizeof ATTACKS / sizeof *ATTACKS };

static Ledger ledger;
static const char *build; // sources lie there under the same names each time, so that they are compiled once

static const char *source_path(const char *name) {
    static char path[4096];
    snprintf(path, sizeof path, "%s/tests/exercises/%s", build, name);
    return path;
}

static int set_up(void **state) {
    (void)state;
    build = getenv("BUILD");
    if (!build) build = "build/release";
    setenv("SPLATLAB_WORKERS", build, 1);
    if (!ledger_load("exercises", &ledger)) fail_msg("%s", fail_text());
    return 0;
}

static Verdict *judge(const char *source, const char *exercise_name) {
    const Exercise *exercise;
    Verdict *v = mem_alloc(1, sizeof *v);
    VerdictOptions options = verdict_options(true, 1);
    options.names_mistakes = false;
    assert_true(exercise_find(exercise_name, &exercise));
    if (!verdict_of("exercises", exercise, source, &ledger, &options, v)) fail_msg("%s", fail_text());
    return v;
}

static void drop(Verdict *v) {
    verdict_free(v);
    mem_free(v);
}

static void write_with(FILE *out, const char *text, const char *forged, int number) {
    while (*text)
        if (strncmp(text, "FORGED", 6) == 0)
            fputs(forged, out), text += 6;
        else if (strncmp(text, "THIS", 4) == 0)
            fprintf(out, "%d", number), text += 4;
        else
            fputc(*text++, out);
}

// All attacks in one file, so that it is compiled once: $ATTACK says which one is on. FORGED is a path in the scratch folder.
static void write_attacks(const Attack *attacks, int count, const char *path, const char *forged) {
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    fputs("#include \"exercises/exercise.h\"\n#include <signal.h>\n#include <stdio.h>\n#include <stdlib.h>\n"
          "#include <string.h>\n#include <unistd.h>\n",
          out);
    for (int i = 0; i < count; i++) {
        write_with(out, attacks[i].outside, forged, i);
        fputc('\n', out);
    }
    fputs(
        "void cov2_from_rs(REAL theta, REAL sx, REAL sy, REAL S[3]) {\n    (void)theta, (void)sx, (void)sy, (void)S;\n"
        "    switch (atoi(getenv(\"ATTACK\"))) {\n",
        out);
    for (int i = 0; i < count; i++) {
        fprintf(out, "    case %d: {\n", i);
        write_with(out, attacks[i].inside, forged, i);
        fputs("\n    } break;\n", out);
    }
    fputs("    }\n}\n", out);
    fclose(out);
}

static void each_attack_is_named_and_none_passes(void **state) {
    (void)state;
    const char *source = source_path("attack.c"), *forged = "build/forged";
    unlink(forged);
    write_attacks(ATTACKS, ATTACK_COUNT, source, forged);
    for (int i = 0; i < ATTACK_COUNT; i++) {
        const Attack *a = &ATTACKS[i];
        char number[16];
        snprintf(number, sizeof number, "%d", i);
        setenv("ATTACK", number, 1);
        double began_s = clock_seconds();
        Verdict *v = judge(source, "cov2");
        if (!v->compiled) fail_msg("%s: %s", a->name, v->diagnostics);
        const Failure *f = &v->rungs[0].failure;
        if (v->passed || v->rungs[0].passed) fail_msg("%s passes", a->name);
        if (f->trouble.kind != a->kind || !strstr(f->trouble.text, a->text))
            fail_msg("%s: kind %d '%s', want %d '%s'", a->name, f->trouble.kind, f->trouble.text, a->kind, a->text);
        if (a->kind == TROUBLE_NONE) assert_true(number_is_unwritten(f->yours[0]));
        if (clock_seconds() - began_s > 15) fail_msg("%s takes %.1f s", a->name, clock_seconds() - began_s);
        assert_false(file_exists(forged));
        drop(v);
    }
}

static void what_is_printed_is_shown_and_never_believed(void **state) {
    (void)state;
    const char *source = source_path("print.c");
    const Attack a = {"", "", "puts(\"passed\");", TROUBLE_NONE, ""};
    setenv("ATTACK", "0", 1);
    write_attacks(&a, 1, source, "");
    Verdict *v = judge(source, "cov2");
    assert_false(v->passed);
    assert_non_null(strstr(v->printed, "passed"));
    drop(v);
}

static void the_tables_of_the_harness_cannot_be_replaced(void **state) {
    (void)state;
    const char *source = source_path("table.c");
    static const char *const tables[] = {"int CALLS[9];", "int REAL_BYTES = 4;"};
    for (int i = 0; i < 2; i++) {
        const Attack a = {"", tables[i], "", TROUBLE_NONE, ""};
        write_attacks(&a, 1, source, "");
        Verdict *v = judge(source, "cov2");
        assert_false(v->compiled || v->passed);
        assert_non_null(strstr(v->diagnostics, "multiple definition"));
        drop(v);
    }
}

static void a_crash_is_told_with_its_line(void **state) {
    (void)state;
    const char *source = source_path("crash.c");
    setenv("ATTACK", "0", 1);
    write_attacks(ATTACKS, 1, source, "");
    Verdict *v = judge(source, "cov2");
    assert_non_null(strstr(v->rungs[0].failure.trouble.text, "at crash.c:12"));
    drop(v);
}

// {what stands in the place of the last line of our solution, kind, text}
static void kernels_cannot_do_it_either(void **state) {
    (void)state;
    static const struct {
        const char *line;
        TroubleKind kind;
        const char *text;
    } KERNELS[] = {
        {"((global REAL *)g)[i] = 0;", TROUBLE_CHANGED_INPUT, "changed its input g[0]"},
        {"p[-1] = 0;", TROUBLE_WROTE_OUTSIDE, "p[-1]"},
        {"((global REAL *)8)[0] = 1;", TROUBLE_CRASHED, "crashed"},
        {"while (n) p[i] += 1;", TROUBLE_TIMEOUT, "did not come back within 3 s"},
        {"p[i] = p[(i + 1) % n];", TROUBLE_ORDER, "when its work-items run in another order"},
    };
    char *ours, *last;
    size_t size;
    assert_true(file_read("exercises/solutions/adam.cl", &ours, &size));
    assert_non_null(last = strstr(ours, "    p[i] -="));
    for (size_t i = 0; i < sizeof KERNELS / sizeof *KERNELS; i++) {
        char *text = mem_format("%.*s    %s\n}\n", (int)(last - ours), ours, KERNELS[i].line);
        char name[32];
        snprintf(name, sizeof name, "attack_%d.cl", (int)i);
        const char *source = source_path(name);
        assert_true(file_write(source, text, strlen(text)));
        Verdict *v = judge(source, "adam");
        const Trouble *t = &v->rungs[0].failure.trouble;
        assert_true(v->compiled && !v->passed);
        if (t->kind != KERNELS[i].kind || !strstr(t->text, KERNELS[i].text))
            fail_msg("%s: kind %d, '%s'", KERNELS[i].line, t->kind, t->text);
        drop(v);
        mem_free(text);
    }
    mem_free(ours);
}

static void after_all_that_a_right_answer_passes(void **state) {
    (void)state;
    Verdict *v = judge("exercises/solutions/cov2.c", "cov2");
    assert_true(v->passed);
    drop(v);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_attack_is_named_and_none_passes),
        cmocka_unit_test(what_is_printed_is_shown_and_never_believed),
        cmocka_unit_test(the_tables_of_the_harness_cannot_be_replaced),
        cmocka_unit_test(a_crash_is_told_with_its_line),
        cmocka_unit_test(kernels_cannot_do_it_either),
        cmocka_unit_test(after_all_that_a_right_answer_passes),
    };
    return cmocka_run_group_tests(tests, set_up, NULL);
}
