// suspicion.c - the same cases for the answer, for our solution and for each wrong variant, and then a look who agrees.
#include "exercises/harness/suspicion.h"

#include "lab/base/mem.h"
#include "lab/io/file.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SEEDS = 8, CASES = 6, CASES_ALL = SEEDS * CASES };
static const double AGREES_PART = 0.9;                    // of the cases in which an answer differs from ours
static const double SAME[PRECISION_COUNT] = {1e-5, 1e-9}; // two ways to compute one number, relative

// All numbers that an answer gives in one case.
typedef struct {
    double *numbers; // (count), owned
    int count;
} Numbers;

typedef struct {
    Numbers of[CASES_ALL];
} Testimony;

// A rung with few cases for each seed is a slow one: it is asked no more of them here.
static int cases_of(const Rung *rung) { return rung->cases && rung->cases < CASES ? rung->cases : CASES; }

static void testimony_take(const Rung *rung, Precision precision, Subject *subject, Testimony *testimony) {
    int cases = cases_of(rung);
    for (int i = 0; i < SEEDS * cases; i++) {
        double in[RUNG_NUMBERS_MAX];
        Trial trial = {.subject = subject, .precision = precision, .tolerance = INFINITY, .is_traced = true};
        rung_draw(rung, (uint64_t)(1 + i / cases), i % cases, in);
        rung->check(&trial, in);
        testimony->of[i] = (Numbers){trial.trace, trial.trace_count};
        if (trial.failed && trial.failure.trouble.kind != TROUBLE_NONE) return; // the rest stays empty
    }
}

static void testimony_free(Testimony *testimony) {
    for (int i = 0; i < CASES_ALL; i++) mem_free(testimony->of[i].numbers);
    *testimony = (Testimony){0};
}

// Relative to the largest number of the case: what is lost to cancellation there is no difference.
static bool numbers_same(const Numbers *a, const Numbers *b, double tolerance) {
    if (a->count != b->count || a->count == 0) return false;
    double largest = 0;
    for (int i = 0; i < a->count; i++)
        if (isfinite(b->numbers[i])) largest = fmax(largest, fabs(b->numbers[i]));
    for (int i = 0; i < a->count; i++) {
        double x = a->numbers[i], y = b->numbers[i];
        if (!(fabs(x - y) <= tolerance * largest) && x != y && !(isnan(x) && isnan(y))) return false;
    }
    return true;
}

bool suspicion_describe(const char *path, char name[SUSPICION_NAME_BYTES], char text[SUSPICION_BYTES]) {
    char *content;
    size_t size;
    if (!file_read(path, &content, &size)) return false;
    const char *file = strrchr(path, '/');
    file = file ? file + 1 : path;
    snprintf(name, SUSPICION_NAME_BYTES, "%.*s", (int)strcspn(file, "."), file);
    const char *from = strstr(content, " - ");
    size_t used = 0;
    for (from = from ? from + 3 : ""; *from && used + 2 < SUSPICION_BYTES; from++) {
        if (*from != '\n')
            text[used++] = *from;
        else if (strncmp(from, "\n// ", 4) == 0)
            text[used++] = ' ', from += 3;
        else
            break;
    }
    text[used] = 0;
    mem_free(content);
    return true;
}

// Library of each file: ours first, then the variants.
static bool build_variants(const char *root, const Exercise *exercise, Precision precision, char **paths, int count,
                           BuildJob *jobs) {
    char *calls = exercise_path(root, exercise, "check_calls.c"), *solution = exercise_solution(root, exercise);
    for (int i = 0; i <= count; i++)
        jobs[i] =
            (BuildJob){.root = root, .source = i ? paths[i - 1] : solution, .calls = calls, .precision = precision};
    bool good = build_all(jobs, count + 1);
    mem_free(calls);
    mem_free(solution);
    return good;
}

// Of the cases in which `answer` is not `ours`: how many are `variant`'s? And how many of all, which tells a variant from one that
// makes the same mistake and more.
typedef struct {
    int matched, cases, alike;
} Agreement;

static Agreement agree(const Testimony *answer, const Testimony *ours, const Testimony *variant, double same) {
    Agreement a = {0};
    for (int i = 0; i < CASES_ALL; i++) {
        if (answer->of[i].count == 0) continue;
        bool is_variants = numbers_same(&answer->of[i], &variant->of[i], same);
        a.alike += is_variants;
        if (numbers_same(&answer->of[i], &ours->of[i], same)) continue;
        a.cases++;
        a.matched += is_variants;
    }
    return a;
}

// The matched part of the differing cases decides, then that of all.
static double rank_of(const Agreement *a) {
    return a->cases ? (double)a->matched / a->cases + 1e-3 * a->alike / CASES_ALL : 0;
}

// All at once: a worker for kernels takes its time to compile them, and several do so side by side.
static bool start_all(const BuildJob *jobs, int count, Subject **subjects) {
    bool good = true;
    for (int i = 0; good && i < count; i++)
        good = !jobs[i].object || (subjects[i] = subject_start(jobs[i].object, "a wrong variant"));
    return good;
}

bool suspicion_find(const char *root, const Exercise *exercise, const Rung *rung, Precision precision, Subject *subject,
                    Suspicion *suspicion) {
    char **paths;
    int count;
    *suspicion = (Suspicion){0};
    if (!exercise_mutants(root, exercise, &paths, &count)) return false;
    BuildJob *jobs = mem_alloc((size_t)count + 1, sizeof *jobs);
    Subject **subjects = mem_alloc((size_t)count + 1, sizeof(Subject *));
    Testimony answer = {0}, ours = {0};
    bool good = build_variants(root, exercise, precision, paths, count, jobs) && start_all(jobs, count + 1, subjects);
    if (good && subjects[0]) testimony_take(rung, precision, subjects[0], &ours);
    if (good) testimony_take(rung, precision, subject, &answer);
    double best = 0;
    for (int i = 0; good && i < count; i++) {
        Testimony variant = {0};
        if (subjects[i + 1]) testimony_take(rung, precision, subjects[i + 1], &variant);
        Agreement a = agree(&answer, &ours, &variant, SAME[precision]);
        testimony_free(&variant);
        if (a.matched < AGREES_PART * a.cases || rank_of(&a) <= best) continue;
        best = rank_of(&a);
        suspicion->found = true;
        suspicion->matched = a.matched;
        suspicion->cases = a.cases;
        good = suspicion_describe(paths[i], suspicion->name, suspicion->text);
    }
    for (int i = 0; i <= count; i++) {
        subject_stop(subjects[i]);
        build_free(&jobs[i]);
    }
    testimony_free(&answer);
    testimony_free(&ours);
    mem_free(subjects);
    mem_free(jobs);
    file_list_free(paths, count);
    return good;
}
