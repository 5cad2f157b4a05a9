// build.h - from a student's C file to a shared object, by the system's compiler, and from kernels to a text that OpenCL takes.
#ifndef SPLATLAB_EXERCISES_HARNESS_BUILD_H
#define SPLATLAB_EXERCISES_HARNESS_BUILD_H

#include <stdbool.h>

typedef enum { PRECISION_FLOAT, PRECISION_DOUBLE, PRECISION_COUNT } Precision;

extern const char *const PRECISION_NAMES[PRECISION_COUNT]; // "float", "double"

// One shared object to build: `source` with `calls`, REAL as `precision`.
typedef struct {
    const char *root;   // of the exercises; its parent is what includes begin from
    const char *source; // path of the .c or .cl file
    const char *calls;  // path of check_calls.c; kernels need none
    Precision precision;
    char *object;      // path of the result; owned, NULL before and when it does not compile
    char *diagnostics; // what the compiler said, "" for nothing; owned
} BuildJob;

// All jobs, on all cores. False with a message when there is no compiler, or nowhere to put the results; a source that does
// not compile is no failure: its `object` stays NULL and `diagnostics` says why, in the compiler's words.
bool build_all(BuildJob *jobs, int count);

void build_free(BuildJob *job); // accepts a zeroed one

#endif
