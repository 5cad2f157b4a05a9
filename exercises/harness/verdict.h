// verdict.h - one run of an exercise: every claim tried on one answer.
#ifndef SPLATLAB_EXERCISES_HARNESS_VERDICT_H
#define SPLATLAB_EXERCISES_HARNESS_VERDICT_H

#include "exercises/harness/ledger.h"
#include "exercises/harness/suspicion.h"

typedef struct {
    const Exercise *exercise;
    bool compiled, passed;
    bool not_started;  // the first thing that happened was NOT_STARTED
    char *diagnostics; // what the compiler said, owned; "" for nothing
    RungResult rungs[RUNGS_MAX];
    Suspicion suspicions[RUNGS_MAX];
    char printed[1024]; // what the answer printed
    int pictured;       // index of the rung of which pictures were written (pictures.h), -1: none
    uint64_t fresh_seed;
    int seed_count;
    double seconds;
} Verdict;

typedef struct {
    uint64_t seeds[RUNG_SEEDS_MAX];
    int seed_count;
    bool names_mistakes; // look for suspicions, which needs the wrong variants compiled
    bool draws;          // write pictures of the first wrong rung that has one
} VerdictOptions;

// Sixteen fixed seeds and a fresh one; or only `seed` where has_seed.
VerdictOptions verdict_options(bool has_seed, uint64_t seed);

// Eight more, from an instructor's key: the same for each answer, and nobody without the key can try them beforehand.
void verdict_options_add_key(VerdictOptions *options, const char *key);

// source: the file that is judged. verdict is large: allocate it. False with a message only when the harness itself could not do
// its work (no compiler, no worker).
bool verdict_of(const char *root, const Exercise *exercise, const char *source, const Ledger *ledger,
                const VerdictOptions *options, Verdict *verdict);
void verdict_free(Verdict *verdict); // its content; accepts a zeroed one

int verdict_first_failed(const Verdict *verdict); // index of the first rung that did not pass, -1: none

#endif
