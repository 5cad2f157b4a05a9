// catalogue.h - the exercises: what each asks, and where its files lie.
#ifndef SPLATLAB_EXERCISES_HARNESS_CATALOGUE_H
#define SPLATLAB_EXERCISES_HARNESS_CATALOGUE_H

#include "exercises/harness/rung.h"

#include <stdbool.h>

// Each exercise is one of these, at the end of its NN_name/check.c. Files, below the root:
//     NN_name/README.md      the page              NN_name/stub.c         what a person begins with
//     NN_name/name.c         the person's own      NN_name/check_calls.c  how its functions are called
//     NN_name/hints.md       four hints            NN_name/mutants/       wrong variants; the first comment names the mistake
//     solutions/name.c       ours
typedef struct {
    int number;       // 1 for E01
    const char *name; // "cov2"
    const char *title;
    int minutes;
    const char *unlocks; // what can be done in the lab with it
    const Rung *rungs;
    int rung_count;
    bool is_kernel; // OpenCL C: .cl in place of .c, and no check_calls.c
} Exercise;

enum { EXERCISE_COUNT = 13, RUNGS_MAX = 12 };
extern const Exercise *const EXERCISES[EXERCISE_COUNT]; // by number

// The one of that number ("7", "07", "E07"), name ("quat") or folder ("07_quat"). Fails (fail_usage) with what there is.
bool exercise_find(const char *text, const Exercise **exercise);

// The folder that holds all exercises, owned by the caller: $SPLATLAB_EXERCISES, exercises/ below the current folder, beside the
// program, or where it was installed. False with a message that names them.
bool exercises_root(char **root);

// Paths, owned by the caller. exercise_path(): of a file in the exercise's folder.
char *exercise_path(const char *root, const Exercise *exercise, const char *file);
char *exercise_source(const char *root, const Exercise *exercise);   // NN_name/name.c
char *exercise_solution(const char *root, const Exercise *exercise); // solutions/name.c
char *exercise_file_name(const Exercise *exercise);                  // "cov2.c", "adam.cl"
char *exercise_stub(const char *root, const Exercise *exercise);     // NN_name/stub.c

// Lays the person's file out from the stub where there is none yet. False with a message when it cannot be written.
bool exercise_lay_out(const char *root, const Exercise *exercise);

// The wrong variants: paths of mutants/*.c (or .cl), sorted, all owned by the caller (file_list_free()).
bool exercise_mutants(const char *root, const Exercise *exercise, char ***paths, int *count);

#endif
