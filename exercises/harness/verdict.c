// verdict.c - compile for both precisions, climb the rungs.
#include "exercises/harness/verdict.h"

#include "exercises/harness/pictures.h"
#include "lab/base/clock.h"
#include "lab/base/mem.h"

#include <sha256.h>
#include <stdio.h>
#include <string.h>
#include <sys/random.h>

VerdictOptions verdict_options(bool has_seed, uint64_t seed) {
    VerdictOptions o = {.names_mistakes = true};
    if (has_seed) {
        o.seeds[o.seed_count++] = seed;
        return o;
    }
    for (; o.seed_count < RUNG_SEEDS - 1; o.seed_count++) o.seeds[o.seed_count] = (uint64_t)o.seed_count + 1;
    uint32_t fresh = 0;
    if (getrandom(&fresh, sizeof fresh, 0) < 0) fresh = (uint32_t)(clock_seconds() * 1e6);
    o.seeds[o.seed_count++] = 1000 + fresh % 1000000; // short enough to type
    return o;
}

void verdict_options_add_key(VerdictOptions *o, const char *key) {
    for (int i = 0; i < RUNG_SECRET_SEEDS; i++) {
        uint8_t digest[SHA256_DIGEST_LENGTH];
        SHA2_CTX hash;
        SHA256Init(&hash);
        SHA256Update(&hash, (const uint8_t *)key, strlen(key));
        SHA256Update(&hash, (const uint8_t *)":seed:", 6);
        SHA256Update(&hash, &(uint8_t){(uint8_t)i}, 1);
        SHA256Final(digest, &hash);
        uint64_t seed = 0;
        for (int k = 0; k < 6; k++) seed = seed << 8 | digest[k]; // 48 bits: what JSON and doubles hold
        o->seeds[o->seed_count++] = seed;
    }
}

int verdict_first_failed(const Verdict *v) {
    for (int r = 0; r < v->exercise->rung_count; r++)
        if (!v->rungs[r].passed) return r;
    return -1;
}

// It came back with wrong numbers.
static bool is_wrong(const RungResult *result) {
    return result->ran && !result->passed && result->failure.trouble.kind == TROUBLE_NONE;
}

// Under Oclgrind, where it is installed; not before the answer is started.
static bool run_watched(const Rung *rung, const Subject *subject, const double tolerance[PRECISION_COUNT],
                        const VerdictOptions *options, RungResult *result) {
    *result = (RungResult){.ran = true, .passed = true, .skipped = "skipped, oclgrind is not installed"};
    if (!subject_has_oclgrind()) return true;
    Subject *watched[PRECISION_COUNT] = {[PRECISION_DOUBLE] = subject_again_oclgrind(subject)};
    if (!watched[PRECISION_DOUBLE]) return false;
    rung_run(rung, watched, tolerance, options->seeds, 1, result);
    subject_stop(watched[PRECISION_DOUBLE]);
    return true;
}

// A mistake is named once, from the first wrong rung that tells it; a verdict shall not be waited for. (Kernels take a while to start:
// one search alone.)
enum { SEARCHES_MAX = 2 };

// One after another until trouble that the next would meet as well.
static bool climb(const char *root, const Ledger *ledger, const VerdictOptions *options,
                  Subject *const subjects[PRECISION_COUNT], Verdict *v) {
    const Exercise *e = v->exercise;
    bool good = true, was_wrong = false;
    int searches = e->is_kernel ? 1 : SEARCHES_MAX;
    for (int r = 0; good && r < e->rung_count; r++) {
        RungResult *result = &v->rungs[r];
        if (e->rungs[r].is_watched && was_wrong) continue; // numbers first
        double tolerance[PRECISION_COUNT];
        for (int p = 0; p < PRECISION_COUNT; p++)
            tolerance[p] = ledger_tolerance(ledger->own_error[exercise_index(e)][r][p], (Precision)p);
        if (e->rungs[r].is_watched)
            good = run_watched(&e->rungs[r], subjects[PRECISION_DOUBLE], tolerance, options, result);
        else
            rung_run(&e->rungs[r], subjects, tolerance, options->seeds, options->seed_count, result);
        if (options->names_mistakes && is_wrong(result) && searches-- > 0) {
            if (!suspicion_find(root, e, &e->rungs[r], result->precision, subjects[result->precision],
                                &v->suspicions[r]))
                return false;
            if (v->suspicions[r].found) searches = 0;
        }
        if (options->draws && v->pictured < 0 && is_wrong(result) && e->rungs[r].picture &&
            pictures_write(root, e, &e->rungs[r], result, subjects[result->precision]))
            v->pictured = r;
        was_wrong |= is_wrong(result);
        TroubleKind kind = result->failure.trouble.kind;
        if (e->is_kernel && kind != TROUBLE_NONE && kind != TROUBLE_NOT_STARTED) break; // each new worker costs a while
        if (kind == TROUBLE_TIMEOUT || kind == TROUBLE_FLOOD || kind == TROUBLE_ENDED || kind == TROUBLE_MEDDLING)
            break;
    }
    return good;
}

bool verdict_of(const char *root, const Exercise *exercise, const char *source, const Ledger *ledger,
                const VerdictOptions *options, Verdict *v) {
    double began_s = clock_seconds();
    *v = (Verdict){.exercise = exercise,
                   .pictured = -1,
                   .fresh_seed = options->seeds[options->seed_count - 1],
                   .seed_count = options->seed_count};
    char *calls = exercise_path(root, exercise, "check_calls.c"), *file = exercise_file_name(exercise);
    BuildJob jobs[PRECISION_COUNT];
    Subject *subjects[PRECISION_COUNT] = {NULL};
    for (int p = 0; p < PRECISION_COUNT; p++)
        jobs[p] = (BuildJob){.root = root, .source = source, .calls = calls, .precision = (Precision)p};
    bool good = build_all(jobs, PRECISION_COUNT);
    v->compiled = good && jobs[0].object && jobs[1].object;
    v->diagnostics = mem_text(good ? jobs[jobs[0].object ? 1 : 0].diagnostics : "");
    for (int p = 0; good && v->compiled && p < PRECISION_COUNT; p++)
        good = (subjects[p] = subject_start(jobs[p].object, file)) != NULL;
    if (good && v->compiled) good = climb(root, ledger, options, subjects, v);
    v->passed = good && v->compiled && verdict_first_failed(v) < 0;
    v->not_started = v->rungs[0].failure.trouble.kind == TROUBLE_NOT_STARTED;
    for (int p = 0; p < PRECISION_COUNT; p++) {
        if (subjects[p] && !v->printed[0]) snprintf(v->printed, sizeof v->printed, "%s", subject_printed(subjects[p]));
        subject_stop(subjects[p]);
        build_free(&jobs[p]);
    }
    mem_free(calls);
    mem_free(file);
    v->seconds = clock_seconds() - began_s;
    return good;
}

void verdict_free(Verdict *v) {
    mem_free(v->diagnostics);
    v->diagnostics = NULL;
}
