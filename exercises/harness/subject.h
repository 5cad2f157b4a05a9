// subject.h - a worker process that runs one library of a student's functions, as the judge sees it.
//
//     Subject *subject = subject_start(library, "cov2.c");
//     double theta = 0.3, sx = 2, sy = 1, S[3];
//     bool good = CALL(subject_call, subject, "cov2_from_rs", IN(theta), IN(sx), IN(sy), OUT_ARRAY(S, 3));
//     subject_stop(subject);
//
// Whatever the code does, a call comes back: with the numbers, or with subject_trouble(). A worker that died is started anew by
// the next call.
#ifndef SPLATLAB_EXERCISES_HARNESS_SUBJECT_H
#define SPLATLAB_EXERCISES_HARNESS_SUBJECT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// One argument. Names are those that a message shows.
typedef struct {
    const char *name;
    double *numbers; // (sets, count); outputs are written, or NaN where the code wrote nothing
    int count;
    bool is_output;
    bool is_updated; // an output that is an input first: kernels alone
} Arg;

#define IN(x)                                                                                                          \
    { #x, (double *)&(x), 1, false, false }
#define OUT(x)                                                                                                         \
    { #x, &(x), 1, true, false }
#define IN_ARRAY(x, count)                                                                                             \
    { #x, (double *)(x), (count), false, false }
#define OUT_ARRAY(x, count)                                                                                            \
    { #x, (x), (count), true, false }
#define UPDATED_ARRAY(x, count)                                                                                        \
    { #x, (x), (count), true, true }
// With a name that is not the variable's.
#define ARG_IN(name, numbers, count)                                                                                   \
    { name, (double *)(numbers), (count), false, false }
#define ARG_OUT(name, numbers, count)                                                                                  \
    { name, (numbers), (count), true, false }
// `f(object, name, args, number of args)` with the arguments written in a row.
#define CALL(f, object, name, ...)                                                                                     \
    f(object, name, (Arg[]){__VA_ARGS__}, (int)(sizeof((Arg[]){__VA_ARGS__}) / sizeof(Arg)))

typedef enum {
    TROUBLE_NONE,
    TROUBLE_NOT_STARTED,   // NOT_STARTED still stands there
    TROUBLE_NO_FUNCTION,   // renamed, or made static
    TROUBLE_WROTE_OUTSIDE, // behind or before an array
    TROUBLE_CHANGED_INPUT,
    TROUBLE_CRASHED,
    TROUBLE_MEMORY,   // crashed after malloc had refused
    TROUBLE_TIMEOUT,  // did not come back
    TROUBLE_FLOOD,    // printed without end
    TROUBLE_ENDED,    // the process ended itself
    TROUBLE_MEDDLING, // wrote into the judge's socket
    // Of kernels alone:
    TROUBLE_ORDER,    // the result depends on the order in which work-items run
    TROUBLE_REPORTED, // Oclgrind has seen something
    TROUBLE_DEVICE,   // OpenCL refused
} TroubleKind;

enum { TROUBLE_BYTES = 400 };

typedef struct {
    TroubleKind kind;
    char text[TROUBLE_BYTES]; // one sentence that names function, place and values
} Trouble;

typedef struct Subject Subject;

// library: a shared object, or the text of kernels (.cl), as build.h makes them. file: the source's name, for messages. NULL with
// a message when the worker program cannot be started.
Subject *subject_start(const char *library, const char *file);

// Kernels on Oclgrind's device, which interprets each work-item and sees races and wrong addresses; about a thousand times as slow.
Subject *subject_again_oclgrind(const Subject *subject); // another one of the same text
bool subject_has_oclgrind(void);                         // is it installed?
bool subject_is_kernel(const Subject *subject);
void subject_stop(Subject *subject); // accepts NULL

// Calls the function once, or `sets` times in one go. False when it did not come back with numbers: subject_trouble().
bool subject_call(Subject *subject, const char *function, const Arg *args, int count);
bool subject_call_sets(Subject *subject, const char *function, const Arg *args, int count, int sets);

const Trouble *subject_trouble(const Subject *subject); // of the last call
const char *subject_printed(const Subject *subject);    // the beginning of what the code printed so far

// Did the code leave this number unwritten?
bool number_is_unwritten(double value);

#endif
