// selftest.h - do the exercises keep their promises? The stub fails kindly, our solution passes, every wrong variant fails and is
// named.
#ifndef SPLATLAB_EXERCISES_HARNESS_SELFTEST_H
#define SPLATLAB_EXERCISES_HARNESS_SELFTEST_H

#include "exercises/harness/ledger.h"
#include "exercises/harness/suspicion.h"

enum { MUTANTS_MAX = 24 };

typedef struct {
    char name[SUSPICION_NAME_BYTES];
    bool killed, named;
    const char *by; // name of the rung that failed; "" for none
} MutantResult;

typedef struct {
    bool stub_fails, solution_passes; // the stub: with its friendly first message
    bool ledger_agrees;               // the tolerances are those of this solution
    int mutants, mutants_killed, mutants_named;
    MutantResult mutant[MUTANTS_MAX];
    double seconds;
    double verdict_seconds;                       // of the solution: from save to verdict
    double own_error[RUNGS_MAX][PRECISION_COUNT]; // of the solution
} SelftestResult;

// False with a message only when the harness could not do its work.
bool selftest_run(const char *root, const Exercise *exercise, const Ledger *ledger, SelftestResult *result);

// All is as promised: every mutant is killed, and at least four there are.
bool selftest_is_sound(const SelftestResult *result);

#endif
