// mine.c - one subject for each exercise that passes.
#include "exercises/harness/mine.h"

#include "exercises/harness/verdict.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

static const char *const NAMES[MINE_COUNT] = {"cov2", "conic", "popping", "composite", "cov3", "camera", "ewa", "sh"};

typedef struct {
    const Exercise *exercise; // NULL: this lab does not have it
    struct timespec saved;    // of the file that was judged
    Subject *subject;         // NULL: the reference does it
    char why[TROUBLE_BYTES];  // then
} Part;

struct Mine {
    char *root;
    Ledger ledger;
    Part parts[MINE_COUNT];
};

static void say(Part *part, const char *text) { snprintf(part->why, sizeof part->why, "%s", text); }

// The file's own time, zero where there is none.
static struct timespec saved_at(const Mine *mine, const Exercise *exercise) {
    char *source = exercise_source(mine->root, exercise);
    struct stat entry = {0};
    if (stat(source, &entry) < 0) entry = (struct stat){0};
    mem_free(source);
    return entry.st_mtim;
}

static void say_verdict(Part *part, const Verdict *v) {
    int failed = verdict_first_failed(v);
    if (!v->compiled)
        say(part, "it does not compile");
    else if (v->not_started)
        say(part, "not started yet");
    else
        snprintf(part->why, sizeof part->why, "rung %d of %d fails", failed + 1, v->exercise->rung_count);
}

static Subject *open_library(const Mine *mine, const Exercise *e, const char *source) {
    char *calls = exercise_path(mine->root, e, "check_calls.c"), *file = exercise_file_name(e);
    BuildJob job = {.root = mine->root, .source = source, .calls = calls, .precision = PRECISION_DOUBLE};
    Subject *subject = build_all(&job, 1) && job.object ? subject_start(job.object, file) : NULL;
    build_free(&job);
    mem_free(calls);
    mem_free(file);
    return subject;
}

static bool judge(Mine *mine, Part *part) {
    const Exercise *e = part->exercise;
    VerdictOptions options = verdict_options(false, 0);
    options.names_mistakes = false;
    Verdict *v = mem_alloc(1, sizeof *v);
    char *source = exercise_source(mine->root, e);
    subject_stop(part->subject);
    part->subject = NULL;
    part->saved = saved_at(mine, e);
    bool good = verdict_of(mine->root, e, source, &mine->ledger, &options, v);
    if (good && v->passed)
        good = (part->subject = open_library(mine, e, source)) != NULL;
    else if (good)
        say_verdict(part, v);
    verdict_free(v);
    mem_free(v);
    mem_free(source);
    return good;
}

Mine *mine_open(void) {
    Mine *mine = mem_alloc(1, sizeof *mine);
    bool good = exercises_root(&mine->root) && ledger_load(mine->root, &mine->ledger);
    for (int i = 0; good && i < MINE_COUNT; i++) {
        Part *part = &mine->parts[i];
        for (int e = 0; e < EXERCISE_COUNT; e++)
            if (strcmp(EXERCISES[e]->name, NAMES[i]) == 0) part->exercise = EXERCISES[e];
        if (part->exercise) good = exercise_lay_out(mine->root, part->exercise) && judge(mine, part);
    }
    if (good) return mine;
    mine_close(mine);
    return NULL;
}

void mine_close(Mine *mine) {
    if (!mine) return;
    for (int i = 0; i < MINE_COUNT; i++) subject_stop(mine->parts[i].subject);
    mem_free(mine->root);
    mem_free(mine);
}

bool mine_refresh(Mine *mine) {
    bool any = false;
    for (int i = 0; i < MINE_COUNT; i++) {
        Part *part = &mine->parts[i];
        if (!part->exercise) continue;
        struct timespec now = saved_at(mine, part->exercise);
        if (now.tv_sec == part->saved.tv_sec && now.tv_nsec == part->saved.tv_nsec) continue;
        any = true;
        if (!judge(mine, part)) say(part, fail_text());
    }
    return any;
}

bool mine_is_used(const Mine *mine, MinePart part) { return mine->parts[part].subject != NULL; }

bool mine_call(Mine *mine, MinePart which, const char *function, const Arg *args, int count, int sets) {
    Part *part = &mine->parts[which];
    if (!part->subject) return false;
    if (subject_call_sets(part->subject, function, args, count, sets)) return true;
    say(part, subject_trouble(part->subject)->text);
    subject_stop(part->subject);
    part->subject = NULL;
    return false;
}

void mine_state(const Mine *mine, MinePart which, char text[MINE_STATE_BYTES]) {
    const Part *part = &mine->parts[which];
    if (!part->exercise)
        snprintf(text, MINE_STATE_BYTES, "%s: the reference", NAMES[which]);
    else if (part->subject)
        snprintf(text, MINE_STATE_BYTES, "E%02d %s: yours", part->exercise->number, NAMES[which]);
    else
        snprintf(text, MINE_STATE_BYTES, "E%02d %s: the reference (%s)", part->exercise->number, NAMES[which],
                 part->why);
}

int mine_sets(int numbers) {
    enum { NUMBERS_PER_CALL = 200000 };
    return numbers < NUMBERS_PER_CALL ? NUMBERS_PER_CALL / (numbers > 0 ? numbers : 1) : 1;
}
