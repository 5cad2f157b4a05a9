// rung.c - cases by seed, and the search for the smallest one that still fails.
#include "exercises/harness/rung.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SHRINK_TRIALS = 300, SHRINK_CRASHES = 20, SHRINK_KERNEL_CRASHES = 2 };

static void round_numbers(double *in, int count) {
    for (int i = 0; i < count; i++) in[i] = (double)(float)in[i];
}

// Each claim draws numbers of its own: the name is part of the key.
static uint32_t name_key(const char *name) {
    uint32_t key = 2166136261u; // FNV-1a
    for (; *name; name++) key = (key ^ (unsigned char)*name) * 16777619u;
    return key;
}

void rung_draw(const Rung *rung, uint64_t seed, int k, double *in) {
    Rng rng = rng_at(seed, RNG_EXERCISE, name_key(rung->name), (uint32_t)k);
    memset(in, 0, RUNG_NUMBERS_MAX * sizeof *in);
    rung->draw(&rng, k, in);
    round_numbers(in, rung->count);
}

static Trial try_case(const Rung *rung, Subject *subject, Precision precision, double tolerance, const double *in) {
    Trial trial = {.subject = subject, .precision = precision, .tolerance = tolerance};
    rung->check(&trial, in);
    return trial;
}

// ---- smaller cases ----

// How much there is to read in a number: its digits, and a little for its size.
static double complexity(double x) {
    char text[40];
    if (x == 0) return 0;
    snprintf(text, sizeof text, "%.9g", x);
    return (double)strlen(text) + fabs(log10(fabs(x))) / 4;
}

enum { CANDIDATES = 8 };

// Simpler numbers than x, simplest first.
static int candidates_of(double x, double candidates[CANDIDATES]) {
    double power = pow(10, floor(log10(fabs(x))));
    const double all[CANDIDATES] = {0,
                                    1,
                                    -1,
                                    floor(x / 2),
                                    round(x),
                                    round(x / power) * power,
                                    round(x / power * 10) / 10 * power,
                                    x - copysign(1, x)};
    int n = 0;
    for (int i = 0; i < CANDIDATES; i++)
        if (isfinite(all[i]) && complexity((double)(float)all[i]) < complexity(x))
            candidates[n++] = (double)(float)all[i];
    return n;
}

// Replaces numbers by simpler ones as long as the case fails in the same way (with trouble, or with a wrong number).
typedef struct {
    const Rung *rung;
    Subject *subject;
    double tolerance;
    RungResult *result;
    int trials, crashes;
} Shrink;

static bool still_fails(Shrink *s, const double *in) {
    if (s->rung->allows && !s->rung->allows(in)) return false;
    int crashes = subject_is_kernel(s->subject) ? SHRINK_KERNEL_CRASHES : SHRINK_CRASHES;
    if (s->trials++ >= SHRINK_TRIALS || s->crashes >= crashes) return false;
    Trial trial = try_case(s->rung, s->subject, s->result->precision, s->tolerance, in);
    bool fails = trial.failed && trial.failure.trouble.kind == s->result->failure.trouble.kind;
    if (trial.failure.trouble.kind == TROUBLE_CRASHED) s->crashes++;
    if (fails) {
        s->result->failure = trial.failure;
        memcpy(s->result->in, in, sizeof s->result->in);
    }
    trial_free(&trial);
    return fails;
}

static bool shrink_number(Shrink *s, int i) {
    double in[RUNG_NUMBERS_MAX], candidates[CANDIDATES];
    int n = candidates_of(s->result->in[i], candidates);
    memcpy(in, s->result->in, sizeof in);
    for (int k = 0; k < n; k++) {
        in[i] = candidates[k];
        if (still_fails(s, in)) return true;
    }
    return false;
}

static void shrink(Shrink *s) {
    for (bool smaller = true; smaller;) {
        smaller = false;
        for (int i = 0; i < s->rung->count; i++) smaller |= shrink_number(s, i);
    }
}

// ---- all cases ----

// False after trouble, which may cost seconds each time.
static bool run_case(const Rung *rung, Subject *subject, Precision precision, double tolerance, uint64_t seed, int k,
                     RungResult *result) {
    double in[RUNG_NUMBERS_MAX];
    rung_draw(rung, seed, k, in);
    Trial trial = try_case(rung, subject, precision, tolerance, in);
    result->cases++;
    if (trial.own_error > result->own_error[precision]) result->own_error[precision] = trial.own_error;
    if (trial.failed && result->failed_cases++ == 0) {
        result->passed = false;
        result->precision = precision;
        result->seed = seed;
        result->failure = trial.failure;
        memcpy(result->in, in, sizeof in);
        Shrink s = {.rung = rung, .subject = subject, .tolerance = tolerance, .result = result};
        TroubleKind kind = trial.failure.trouble.kind;
        if (kind == TROUBLE_NONE || kind == TROUBLE_WROTE_OUTSIDE || kind == TROUBLE_CHANGED_INPUT ||
            kind == TROUBLE_CRASHED)
            shrink(&s);
    }
    bool goes_on = trial.failure.trouble.kind == TROUBLE_NONE;
    trial_free(&trial);
    return goes_on;
}

void rung_run(const Rung *rung, Subject *const subjects[PRECISION_COUNT], const double tolerance[PRECISION_COUNT],
              const uint64_t *seeds, int seed_count, RungResult *result) {
    *result = (RungResult){.ran = true, .passed = true};
    int cases = rung->cases ? rung->cases : RUNG_CASES;
    // Double first: what fails there is wrong, what fails in float alone is a loss of digits.
    for (int p = PRECISION_DOUBLE; p >= (rung->double_only ? PRECISION_DOUBLE : PRECISION_FLOAT); p--)
        for (int s = 0; s < seed_count; s++)
            for (int k = 0; k < cases; k++)
                if (!run_case(rung, subjects[p], (Precision)p, tolerance[p], seeds[s], k, result)) return;
}
