// trial.c - calls, comparisons, and the record of the first that failed.
#include "exercises/harness/trial.h"

#include "lab/base/mem.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void trial_free(Trial *t) {
    mem_free(t->trace);
    t->trace = NULL;
    t->trace_count = t->trace_capacity = 0;
}

// ---- calls ----

static void append(char *text, size_t size, const char *more) {
    size_t have = strlen(text);
    snprintf(text + have, size - have, "%s", more);
}

enum { WHOLE_ARRAY = 18 /* a camera */, SHOWN_OF_LONGER = 4 };

// The numbers that are not 0, where a long array has few of them: "24 numbers, all 0 but [20] = 0.0033". False where it has many.
static bool append_sparse(char *text, size_t size, const Arg *arg) {
    char number[60];
    int found = 0;
    for (int i = 0; i < arg->count; i++) found += arg->numbers[i] != 0;
    if (found > SHOWN_OF_LONGER) return false;
    snprintf(number, sizeof number, "%d numbers, all 0", arg->count);
    append(text, size, number);
    for (int i = 0, said = 0; i < arg->count; i++) {
        if (arg->numbers[i] == 0) continue;
        snprintf(number, sizeof number, "%s[%d] = %.7g", said++ ? ", " : " but ", i, arg->numbers[i]);
        append(text, size, number);
    }
    append(text, size, ")");
    return true;
}

// "theta = 0.5" or "bg = (0, 0, 0)".
static void append_arg(char *text, size_t size, const Arg *arg) {
    char number[40];
    append(text, size, arg->name);
    append(text, size, arg->count == 1 ? " = " : " = (");
    if (arg->count > WHOLE_ARRAY && append_sparse(text, size, arg)) return;
    int shown = arg->count <= WHOLE_ARRAY ? arg->count : SHOWN_OF_LONGER;
    for (int i = 0; i < shown; i++) {
        snprintf(number, sizeof number, "%s%.7g", i ? ", " : "", arg->numbers[i]);
        append(text, size, number);
    }
    if (arg->count > shown) {
        snprintf(number, sizeof number, ", ... %d numbers", arg->count);
        append(text, size, number);
    }
    if (arg->count != 1) append(text, size, ")");
}

static void note_call(Trial *t, const char *function, const Arg *args, int count) {
    t->called[0] = 0;
    append(t->called, sizeof t->called, function);
    append(t->called, sizeof t->called, "(");
    bool first = true;
    for (int k = 0; k < count; k++) {
        if (args[k].is_output && !args[k].is_updated) continue;
        if (!first) append(t->called, sizeof t->called, ", ");
        append_arg(t->called, sizeof t->called, &args[k]);
        first = false;
    }
    append(t->called, sizeof t->called, ")");
}

static void trace_outputs(Trial *t, const Arg *args, int count) {
    for (int k = 0; k < count; k++) {
        if (!args[k].is_output) continue;
        int wanted = t->trace_count + args[k].count;
        if (wanted > t->trace_capacity) {
            int larger = 2 * wanted + 64;
            t->trace = mem_resize(t->trace, (size_t)t->trace_capacity, (size_t)larger, sizeof *t->trace);
            t->trace_capacity = larger;
        }
        memcpy(t->trace + t->trace_count, args[k].numbers, (size_t)args[k].count * sizeof *t->trace);
        t->trace_count = wanted;
    }
}

static void start_failure(Trial *t, const char *claim) {
    t->failed = true;
    t->failure = (Failure){0};
    snprintf(t->failure.claim, sizeof t->failure.claim, "%s", claim);
    memcpy(t->failure.call, t->called, sizeof t->failure.call);
}

static bool is_over(const Trial *t) { return t->failed && t->failure.trouble.kind != TROUBLE_NONE; }

bool trial_call(Trial *t, const char *function, const Arg *args, int count) {
    if (is_over(t)) {
        for (int k = 0; k < count; k++)
            for (int i = 0; args[k].is_output && i < args[k].count; i++) args[k].numbers[i] = NAN;
        return false;
    }
    note_call(t, function, args, count);
    bool good = subject_call(t->subject, function, args, count);
    if (t->is_traced) trace_outputs(t, args, count);
    if (!good && !t->failed) {
        start_failure(t, "the call comes back");
        t->failure.trouble = *subject_trouble(t->subject);
    }
    return good;
}

// ---- comparisons ----

// An error that nothing can excuse: NaN where there should be a number.
static double error_of(double yours, double expected, double scale) {
    if (yours == expected) return 0; // infinities, too
    double error = fabs(yours - expected) / scale;
    return isnan(error) ? INFINITY : error;
}

static void compare(Trial *t, const char *claim, const double *yours, const double *expected, int count, double scale,
                    double tolerance, bool is_ledger) {
    double worst_error = 0;
    int worst = 0;
    if (is_over(t)) return;
    for (int i = 0; i < count; i++) {
        double error = error_of(yours[i], expected[i], scale);
        if (error > worst_error) worst_error = error, worst = i;
    }
    if (is_ledger && worst_error > t->own_error) t->own_error = worst_error;
    if (t->failed || worst_error <= tolerance) return;
    start_failure(t, claim);
    Failure *f = &t->failure;
    f->count = count;
    int first = worst >= TRIAL_SHOWN_MAX ? worst - TRIAL_SHOWN_MAX + 1 : 0; // the worst one is among those kept
    for (int i = 0; i < TRIAL_SHOWN_MAX && first + i < count; i++) {
        f->yours[i] = yours[first + i];
        f->expected[i] = expected[first + i];
    }
    f->worst = worst - first;
    f->error = worst_error;
    f->tolerance = tolerance;
}

void trial_near(Trial *t, const char *claim, const double *yours, const double *expected, int count, double scale) {
    compare(t, claim, yours, expected, count, scale, t->tolerance, true);
}

void trial_near1(Trial *t, const char *claim, double yours, double expected, double scale) {
    trial_near(t, claim, &yours, &expected, 1, scale);
}

void trial_within(Trial *t, const char *claim, const double *yours, const double *expected, int count,
                  double tolerance) {
    compare(t, claim, yours, expected, count, 1, tolerance, false);
}

void trial_equal(Trial *t, const char *claim, double yours, double expected) {
    compare(t, claim, &yours, &expected, 1, 1, 0, false);
}

void trial_at_most(Trial *t, const char *claim, double yours, double limit) {
    if (t->failed || yours <= limit) return;
    start_failure(t, claim);
    Failure *f = &t->failure;
    f->count = 1;
    f->yours[0] = yours;
    f->expected[0] = limit;
    f->is_limit = true;
    f->error = isnan(yours) ? INFINITY : yours - limit;
}
