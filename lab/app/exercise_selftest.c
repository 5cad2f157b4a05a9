// exercise_selftest.c - the table of `splatlab exercise selftest`.
#include "lab/app/exercise_options.h"

#include "exercises/harness/selftest.h"
#include "lab/app/command_line.h"
#include "lab/base/mem.h"
#include "lab/base/progress.h"
#include "lab/io/json_io.h"

#include <stdio.h>
#include <string.h>

static json_t *mutants_json(const SelftestResult *r) {
    json_t *list = json_array();
    for (int i = 0; i < r->mutants; i++)
        json_array_append_new(list, json_pack("{ss sb sb ss}", "name", r->mutant[i].name, "killed", r->mutant[i].killed,
                                              "named", r->mutant[i].named, "by", r->mutant[i].by));
    return list;
}

static json_t *result_json(const Exercise *e, const SelftestResult *r) {
    char *name = mem_format("%02d_%s", e->number, e->name);
    json_t *o = json_pack("{ss sb sb si si si sf sf so}", "name", name, "stub_fails", r->stub_fails, "solution_passes",
                          r->solution_passes, "mutants", r->mutants, "mutants_killed", r->mutants_killed,
                          "mutants_named", r->mutants_named, "seconds", r->seconds, "verdict_seconds",
                          r->verdict_seconds, "mutant", mutants_json(r));
    mem_free(name);
    return o;
}

static void print_result(const Exercise *e, const SelftestResult *r) {
    printf("E%02d %-12s %-9s %-13s %3d %9d %8d %9.2f %8.1f\n", e->number, e->name, r->stub_fails ? "fails" : "NO",
           r->solution_passes ? "passes" : "NO", r->mutants, r->mutants_killed, r->mutants_named, r->verdict_seconds,
           r->seconds);
    if (!r->ledger_agrees) printf("    ledger.txt is not this solution's: splatlab exercise selftest --write-ledger\n");
    for (int i = 0; i < r->mutants; i++)
        if (!r->mutant[i].killed)
            printf("    %s survives\n", r->mutant[i].name);
        else if (!r->mutant[i].named)
            printf("    %s is killed by '%s', not named\n", r->mutant[i].name, r->mutant[i].by);
}

static void print_sums(const SelftestResult *results) {
    int mutants = 0, killed = 0, named = 0, sound = 0;
    for (int i = 0; i < EXERCISE_COUNT; i++) {
        mutants += results[i].mutants;
        killed += results[i].mutants_killed;
        named += results[i].mutants_named;
        sound += selftest_is_sound(&results[i]);
    }
    printf("%d of %d exercises sound; %d of %d wrong variants killed, %d named\n", sound, EXERCISE_COUNT, killed,
           mutants, named);
}

static bool run_all(const char *root, const Exercise *only, const ExerciseOptions *o, SelftestResult *results,
                    Ledger *ledger) {
    Progress progress = progress_begin("selftest", 0, EXERCISE_COUNT);
    bool good = true;
    for (int i = 0; good && i < EXERCISE_COUNT; i++) {
        if (only && EXERCISES[i] != only) continue;
        good = selftest_run(root, EXERCISES[i], ledger, &results[i]);
        progress_update(&progress, i + 1, EXERCISES[i]->name);
        if (o->write_ledger) memcpy(ledger->own_error[i], results[i].own_error, sizeof results[i].own_error);
    }
    progress_end(&progress, NULL);
    return good;
}

static void print_all(const Exercise *only, const ExerciseOptions *o, const SelftestResult *results) {
    json_t *list = json_array();
    if (!o->json)
        printf("%-16s %-9s %-13s %3s %9s %8s %9s %8s\n", "", "stub", "solution", "wrong", "killed", "named",
               "verdict s", "s");
    for (int i = 0; i < EXERCISE_COUNT; i++) {
        if (only && EXERCISES[i] != only) continue;
        json_array_append_new(list, result_json(EXERCISES[i], &results[i]));
        if (!o->json) print_result(EXERCISES[i], &results[i]);
    }
    json_t *root = json_pack("{so}", "exercises", list);
    if (o->json) json_print(root);
    json_decref(root);
    if (!o->json && !only) print_sums(results);
}

int exercise_selftest(const char *root, const Exercise *e, const ExerciseOptions *o) {
    SelftestResult *results = mem_alloc(EXERCISE_COUNT, sizeof *results);
    Ledger ledger;
    if (o->write_ledger) ledger_clear(&ledger);
    bool good = (o->write_ledger || ledger_load(root, &ledger)) && run_all(root, e, o, results, &ledger);
    bool sound = good;
    for (int i = 0; i < EXERCISE_COUNT; i++) sound &= (e && EXERCISES[i] != e) || selftest_is_sound(&results[i]);
    if (good && o->write_ledger) good = ledger_save(root, &ledger), sound = good;
    if (good && !o->write_ledger) print_all(e, o, results);
    mem_free(results);
    if (!good) return command_failed();
    return sound ? 0 : 1;
}
