// selftest.c - runs the stub, our solution and each wrong variant through the same judge as a person's answer.
#include "exercises/harness/selftest.h"

#include "exercises/harness/verdict.h"
#include "lab/base/clock.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"

#include <stdio.h>
#include <string.h>

enum { MUTANTS_MIN = 4 };

static bool judge(const char *root, const Exercise *e, const char *source, const Ledger *ledger, bool names,
                  Verdict *v) {
    VerdictOptions options = verdict_options(false, 0);
    options.names_mistakes = names;
    if (!verdict_of(root, e, source, ledger, &options, v)) return fail_context("%s", source);
    if (v->compiled) return true;
    return fail("%s does not compile:\n%s", source, v->diagnostics);
}

static bool try_stub(const char *root, const Exercise *e, const Ledger *ledger, Verdict *v, SelftestResult *result) {
    char *stub = exercise_stub(root, e);
    bool good = judge(root, e, stub, ledger, false, v);
    result->stub_fails = good && !v->passed && v->not_started;
    verdict_free(v);
    mem_free(stub);
    return good;
}

static bool try_solution(const char *root, const Exercise *e, const Ledger *ledger, Verdict *v,
                         SelftestResult *result) {
    char *solution = exercise_solution(root, e);
    bool good = judge(root, e, solution, ledger, false, v);
    result->solution_passes = good && v->passed;
    result->verdict_seconds = v->seconds;
    result->ledger_agrees = true;
    for (int r = 0; r < e->rung_count; r++)
        for (int p = e->rungs[r].double_only ? PRECISION_DOUBLE : PRECISION_FLOAT; p < PRECISION_COUNT; p++)
            result->ledger_agrees &=
                ledger_agrees(ledger->own_error[exercise_index(e)][r][p], v->rungs[r].own_error[p], (Precision)p);
    for (int r = 0; r < e->rung_count; r++)
        memcpy(result->own_error[r], v->rungs[r].own_error, sizeof result->own_error[r]);
    verdict_free(v);
    mem_free(solution);
    return good;
}

// Named: among the rungs that failed with wrong numbers, the first names this very mistake; trouble (a crash, an index outside) is its own
// name.
static void note_mutant(const Verdict *v, MutantResult *m) {
    int failed = verdict_first_failed(v);
    m->killed = !v->passed;
    m->by = failed >= 0 ? v->exercise->rungs[failed].name : "";
    m->named = failed >= 0 && (v->rungs[failed].failure.trouble.kind != TROUBLE_NONE ||
                               strcmp(v->suspicions[failed].name, m->name) == 0);
}

static bool try_mutants(const char *root, const Exercise *e, const Ledger *ledger, Verdict *v, SelftestResult *result) {
    char **paths;
    int count;
    if (!exercise_mutants(root, e, &paths, &count)) return false;
    bool good =
        count <= MUTANTS_MAX || fail("exercise %d: %d wrong variants, at most %d", e->number, count, MUTANTS_MAX);
    for (int i = 0; good && i < count; i++) {
        MutantResult *m = &result->mutant[result->mutants++];
        char text[SUSPICION_BYTES];
        good = suspicion_describe(paths[i], m->name, text) && judge(root, e, paths[i], ledger, true, v);
        if (good) note_mutant(v, m);
        verdict_free(v);
        result->mutants_killed += m->killed;
        result->mutants_named += m->named;
    }
    file_list_free(paths, count);
    return good;
}

bool selftest_run(const char *root, const Exercise *exercise, const Ledger *ledger, SelftestResult *result) {
    double began_s = clock_seconds();
    Verdict *v = mem_alloc(1, sizeof *v);
    *result = (SelftestResult){0};
    bool good = try_stub(root, exercise, ledger, v, result) && try_solution(root, exercise, ledger, v, result) &&
                try_mutants(root, exercise, ledger, v, result);
    mem_free(v);
    result->seconds = clock_seconds() - began_s;
    return good;
}

bool selftest_is_sound(const SelftestResult *r) {
    return r->stub_fails && r->solution_passes && r->ledger_agrees && r->mutants >= MUTANTS_MIN &&
           r->mutants_killed == r->mutants;
}
