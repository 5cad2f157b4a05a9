// ledger.h - what our own solution misses each claim by: exercises/ledger.txt. From it come the tolerances.
//
// A tolerance is ten times the solution's own largest error over all cases, and at least 64 units in the last place; nobody
// writes one by hand. `splatlab exercise selftest --write-ledger` measures them anew.
#ifndef SPLATLAB_EXERCISES_HARNESS_LEDGER_H
#define SPLATLAB_EXERCISES_HARNESS_LEDGER_H

#include "exercises/harness/catalogue.h"

typedef struct {
    double own_error[EXERCISE_COUNT][RUNGS_MAX][PRECISION_COUNT]; // < 0: not measured
} Ledger;

// Every claim of every exercise must stand in the file.
bool ledger_load(const char *root, Ledger *ledger);
bool ledger_save(const char *root, const Ledger *ledger);

double ledger_tolerance(double own_error, Precision precision);

// Is that what a solution that misses by `measured` would be noted with? Seeds differ by one, so within a factor of ten; what is far
// below the smallest tolerance says nothing.
bool ledger_agrees(double own_error, double measured, Precision precision);

// An empty one, with which everything is measured and nothing fails.
void ledger_clear(Ledger *ledger);

// The exercise's place in EXERCISES.
int exercise_index(const Exercise *exercise);

#endif
