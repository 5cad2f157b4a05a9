// rung.h - one claim about an answer, tried on random cases; a case that fails is made as small as it can be.
#ifndef SPLATLAB_EXERCISES_HARNESS_RUNG_H
#define SPLATLAB_EXERCISES_HARNESS_RUNG_H

#include "exercises/harness/trial.h"
#include "lab/base/image.h"
#include "lab/base/rng.h"

enum {
    RUNG_NUMBERS_MAX = 320,
    RUNG_CASES = 12,
    RUNG_SEEDS = 17,       // sixteen fixed ones and a fresh one
    RUNG_SECRET_SEEDS = 8, // that come from an instructor's key
    RUNG_SEEDS_MAX = RUNG_SEEDS + RUNG_SECRET_SEEDS,
};

typedef struct {
    const char *name;  // "psd": for ledger, progress and JSON
    const char *claim; // "both eigenvalues are the squares of the scales"; what is asked, in one sentence
    int cases;         // for each seed; 0: RUNG_CASES
    int count;         // numbers of a case, 1..RUNG_NUMBERS_MAX
    bool double_only;  // gradients: float is too coarse to tell right from nearly right
    bool is_watched;   // of kernels: under Oclgrind, with double_only and one seed, since it takes long
    // Case k of a seed. Cases with small k are good for edges: zero, equal, huge. Numbers are rounded to float afterwards, so
    // that float and double see the same.
    void (*draw)(Rng *rng, int k, double *in);
    bool (*allows)(const double *in); // is this still a case? (asked of smaller ones); NULL: any finite numbers are
    void (*check)(Trial *trial, const double *in);
    // What the answer and the reference draw of a case, both created here with the same size, 3 channels; NULL: no picture.
    // False when the answer did not come back.
    bool (*picture)(Subject *subject, const double *in, ImageF *yours, ImageF *reference);
} Rung;

typedef struct {
    bool ran, passed;
    const char *skipped;               // passed untried: why; else NULL
    int cases, failed_cases;           // in both precisions together
    double own_error[PRECISION_COUNT]; // the largest of trial_near() over all cases
    // Of the first failure, after it was made small:
    Precision precision;
    uint64_t seed;
    Failure failure;
    double in[RUNG_NUMBERS_MAX];
} RungResult;

// The numbers of case k.
void rung_draw(const Rung *rung, uint64_t seed, int k, double *in);

// index: of the rung in its exercise. tolerance: by precision. Stops early at trouble that every case would meet.
void rung_run(const Rung *rung, Subject *const subjects[PRECISION_COUNT], const double tolerance[PRECISION_COUNT],
              const uint64_t *seeds, int seed_count, RungResult *result);

#endif
