// calls.h - how the harness calls the functions of an exercise: by name, each argument a pointer to numbers.
//
// NN_name/check_calls.c is compiled together with the answer and ends in the table
//     const Call CALLS[] = {{"cov2_from_rs", call_cov2_from_rs}, {0}};
// in which a[k] is the k-th argument as NN_name/check.c names them: an array of REAL, one number where it is one number.
// Outputs are filled with NaN beforehand and stand between guard words, so that what is not written, or written outside,
// is seen. A result that a function returns is one more output.
#ifndef SPLATLAB_EXERCISES_CALLS_H
#define SPLATLAB_EXERCISES_CALLS_H

#include "exercises/exercise.h"

typedef struct {
    const char *name;
    void (*call)(REAL **a);
} Call;

extern const Call CALLS[]; // ends with a zeroed one

// Tells the worker what the library was compiled for; check_calls.c is the only file of it that includes this one.
const int REAL_BYTES = sizeof(REAL);

#endif
