// trial.h - one case of one rung: calls of the student's functions, and what their numbers are compared with.
//
// A check is a function of the case's numbers that calls and compares:
//
//     static void same_matrix(Trial *t, const double *in) {
//         double theta = in[0], sx = in[1], sy = in[2], S[3];
//         CALL(trial_call, t, "cov2_from_rs", IN(theta), IN(sx), IN(sy), OUT_ARRAY(S, 3));
//         Sym2 want = covariance_from_angle(theta, sx, sy);
//         trial_near(t, "S = xx, xy, yy", S, (double[]){want.xx, want.xy, want.yy}, 3, sx * sx + sy * sy);
//     }
//
// After the first thing that is wrong the trial has failed: later comparisons are not looked at, so a check needs no `if`.
// Outputs are NaN after a call that did not come back, and where nothing was written; NaN is never near anything, itself neither.
#ifndef SPLATLAB_EXERCISES_HARNESS_TRIAL_H
#define SPLATLAB_EXERCISES_HARNESS_TRIAL_H

#include "exercises/harness/build.h"
#include "exercises/harness/subject.h"

#include <stdbool.h>

enum { TRIAL_SHOWN_MAX = 12, TRIAL_CLAIM_BYTES = 240, TRIAL_CALL_BYTES = 1200 };

// What went wrong in a trial.
typedef struct {
    Trouble trouble;               // kind TROUBLE_NONE: the call came back, with a wrong number
    char claim[TRIAL_CLAIM_BYTES]; // what was compared
    char call[TRIAL_CALL_BYTES];   // "cov2_from_rs(theta = 0.5, sx = 1, sy = 1)": the last call before
    int count;                     // numbers compared; the first TRIAL_SHOWN_MAX are kept
    double yours[TRIAL_SHOWN_MAX], expected[TRIAL_SHOWN_MAX];
    bool is_limit;    // `expected` is an upper limit, not a value
    int worst;        // index of the largest error
    double error;     // the largest, over its scale
    double tolerance; // of that
} Failure;

typedef struct {
    Subject *subject;
    Precision precision;
    double tolerance; // of trial_near() in this rung, from the ledger; see ledger.h
    bool failed;
    Failure failure;
    double own_error;              // the largest error of any comparison so far, as a multiple of its scale
    char called[TRIAL_CALL_BYTES]; // the last call
    bool is_traced;                // keep all outputs: to compare two answers
    double *trace;                 // (trace_count), owned; free with trial_free()
    int trace_count, trace_capacity;
} Trial;

void trial_free(Trial *trial);

bool trial_call(Trial *trial, const char *function, const Arg *args, int count);

// |yours - expected| <= tolerance * scale for each number. scale > 0: what an error has to be compared with, such as the
// largest number expected; claim: what they are, "S = xx, xy, yy".
void trial_near(Trial *trial, const char *claim, const double *yours, const double *expected, int count, double scale);
void trial_near1(Trial *trial, const char *claim, double yours, double expected, double scale);

// As trial_near(), with a tolerance of its own in place of the ledger's: for what is not exact even in a right answer, such
// as a Monte Carlo estimate (then: a multiple of its standard error).
void trial_within(Trial *trial, const char *claim, const double *yours, const double *expected, int count,
                  double tolerance);

// yours == expected: for whole numbers and flags.
void trial_equal(Trial *trial, const char *claim, double yours, double expected);

// yours <= limit.
void trial_at_most(Trial *trial, const char *claim, double yours, double limit);

#endif
