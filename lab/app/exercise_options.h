// exercise_options.h - what `splatlab exercise` was asked for, and what its actions share.
#ifndef SPLATLAB_LAB_APP_EXERCISE_OPTIONS_H
#define SPLATLAB_LAB_APP_EXERCISE_OPTIONS_H

#include "exercises/harness/verdict.h"
#include "lab/app/window_options.h"
#include "lab/base/options.h"

#include <stdint.h>

typedef struct {
    bool json, write_ledger, has_seed;
    char seed[OPTION_TEXT_BYTES];   // "" for the usual seventeen
    char key[OPTION_TEXT_BYTES];    // the instructor's
    char answer[OPTION_TEXT_BYTES]; // another file than the person's own
    WindowOptions window;           // of `show`
} ExerciseOptions;

// One thing that can be done with an exercise; e is NULL where none was named. Returns the exit code.
typedef int ExerciseAction(const char *root, const Exercise *e, const ExerciseOptions *o);

ExerciseAction exercise_list, exercise_run;                           // exercise_run.c
ExerciseAction exercise_hint, exercise_reset, exercise_solution_show; // exercise_help.c
ExerciseAction exercise_selftest;                                     // exercise_selftest.c
ExerciseAction exercise_watch;                                        // exercise_watch.c
ExerciseAction exercise_show;                                         // exercise_show.c

// One run of the person's file (or of o->answer), noted in the progress unless it is a replay; in exercise_run.c. The caller frees
// the verdict's content, also after false.
bool exercise_judge(const char *root, const Exercise *e, const ExerciseOptions *o, Verdict *verdict);

// Is it the instructor's key? Its SHA-256 stands in instructor.sha256 in the exercises' folder. Fails with a message when not.
bool exercise_key_check(const char *root, const char *key);

#endif
