// exercise_run.c - the list of exercises with what was reached, and one run.
#include "lab/app/exercise_options.h"

#include "exercises/harness/report.h"
#include "exercises/harness/standing.h"
#include "lab/app/command_line.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/json_io.h"

#include <errno.h>
#include <stdlib.h>
#include <unistd.h>

// ---- list ----

static void print_list(const char *root, const Standing standings[EXERCISE_COUNT]) {
    Page page = page_for(STDOUT_FILENO, stdout);
    int solved = 0;
    printf("%-4s %-12s %-8s %5s\n", "", "", "rungs", "min");
    for (int i = 0; i < EXERCISE_COUNT; i++) {
        const Exercise *e = EXERCISES[i];
        solved += standings[i].solved;
        int column = printf("E%02d  %-12s %2d of %-2d %s %3d  ", e->number, e->name, standing_rungs(&standings[i], e),
                            e->rung_count, standings[i].solved ? "*" : " ", e->minutes);
        page_wrap(&page, column, column, e->title);
    }
    printf("%d of %d solved (*)\n", solved, EXERCISE_COUNT);
    for (int i = 0; i < EXERCISE_COUNT; i++) {
        if (standings[i].solved) continue;
        printf("Next: read %s/%02d_%s/README.md, then splatlab exercise watch %d\n", root, EXERCISES[i]->number,
               EXERCISES[i]->name, EXERCISES[i]->number);
        return;
    }
}

static void print_list_json(const Standing standings[EXERCISE_COUNT]) {
    json_t *list = json_array();
    for (int i = 0; i < EXERCISE_COUNT; i++) {
        const Exercise *e = EXERCISES[i];
        json_array_append_new(list, json_pack("{si ss ss si si si sb si}", "number", e->number, "name", e->name,
                                              "title", e->title, "minutes", e->minutes, "rungs", e->rung_count,
                                              "rungs_passed", standing_rungs(&standings[i], e), "solved",
                                              standings[i].solved, "runs", standings[i].runs));
    }
    json_t *root = json_pack("{so}", "exercises", list);
    json_print(root);
    json_decref(root);
}

int exercise_list(const char *root, const Exercise *e, const ExerciseOptions *o) {
    Standing standings[EXERCISE_COUNT];
    (void)e;
    if (!standing_load(root, standings)) return command_failed();
    for (int i = 0; i < EXERCISE_COUNT; i++)
        if (!exercise_lay_out(root, EXERCISES[i])) return command_failed();
    if (o->json)
        print_list_json(standings);
    else
        print_list(root, standings);
    return 0;
}

// ---- run ----

static bool note(const char *root, const Verdict *v) {
    Standing standings[EXERCISE_COUNT];
    if (!standing_load(root, standings)) return false;
    standing_note(&standings[exercise_index(v->exercise)], v);
    return standing_save(root, standings);
}

static bool parse_seed(const ExerciseOptions *o, uint64_t *seed) {
    char *end;
    errno = 0;
    *seed = strtoull(o->seed, &end, 10);
    if (!o->seed[0] || (!*end && o->seed[0] != '-' && errno == 0)) return true;
    return fail_usage("exercise: --seed %s: want a whole number, as a failed run prints it", o->seed);
}

bool exercise_judge(const char *root, const Exercise *e, const ExerciseOptions *o, Verdict *v) {
    uint64_t seed;
    Ledger ledger;
    if (!parse_seed(o, &seed) || (o->key[0] && !exercise_key_check(root, o->key))) return false;
    if (!ledger_load(root, &ledger) || !exercise_lay_out(root, e)) return false;
    VerdictOptions options = verdict_options(o->seed[0] != 0, seed);
    if (o->key[0]) verdict_options_add_key(&options, o->key);
    options.draws = !o->answer[0];
    char *source = o->answer[0] ? mem_text(o->answer) : exercise_source(root, e);
    bool good = verdict_of(root, e, source, &ledger, &options, v) && (o->answer[0] || o->seed[0] || note(root, v));
    mem_free(source);
    return good;
}

int exercise_run(const char *root, const Exercise *e, const ExerciseOptions *o) {
    Verdict *v = mem_alloc(1, sizeof *v);
    bool good = exercise_judge(root, e, o, v), passed = v->passed;
    if (good && o->json) {
        json_t *report = report_json(root, v);
        json_print(report);
        json_decref(report);
    } else if (good) {
        Page page = page_for(STDOUT_FILENO, stdout);
        report_text(root, v, &page);
    }
    verdict_free(v);
    mem_free(v);
    if (!good) return command_failed();
    return passed ? 0 : 1;
}
