// standing.h - what a person has reached so far: progress.json in the exercises' folder, a file to read.
#ifndef SPLATLAB_EXERCISES_HARNESS_STANDING_H
#define SPLATLAB_EXERCISES_HARNESS_STANDING_H

#include "exercises/harness/verdict.h"

typedef struct {
    bool passed[RUNGS_MAX]; // in the last run
    bool solved;            // all of them, once: the solution stays open
    int runs, hints;        // how often; hints shown so far
} Standing;

// Where there is no file yet, nothing has been reached. A file that is none fails with its place and what to do.
bool standing_load(const char *root, Standing all[EXERCISE_COUNT]);
bool standing_save(const char *root, const Standing all[EXERCISE_COUNT]);

// Takes a run over.
void standing_note(Standing *standing, const Verdict *verdict);

int standing_rungs(const Standing *standing, const Exercise *exercise); // how many passed in the last run

#endif
