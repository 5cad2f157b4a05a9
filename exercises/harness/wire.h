// wire.h - what the judge and the worker say to each other over a socket: one request, one answer.
//
// The judge (subject.c) knows what is right and runs in the program; the worker (worker.c) is a process of its own that
// holds nothing but the student's code and sends back the numbers which that code made. So nothing that the code does to
// its process can make a wrong number right: it can only end the process, keep it busy, or answer.
#ifndef SPLATLAB_EXERCISES_HARNESS_WIRE_H
#define SPLATLAB_EXERCISES_HARNESS_WIRE_H

#include <stdint.h>

enum {
    WIRE_FD = 3, // the worker's end of the socket
    WIRE_ARGS_MAX = 16,
    WIRE_NAME_BYTES = 48,
    WIRE_TEXT_BYTES = 256,
    WIRE_GUARD = 16, // guard words on either side of each argument
};

// A number that nobody wrote: a NaN with a payload of its own.
static const uint64_t WIRE_UNWRITTEN = 0x7ff8dead0000beefULL;

// is_input, is_output: numbers go in, come out, or both; an input that is no output must come back unchanged.
typedef struct {
    uint16_t is_input, is_output;
    uint32_t count; // numbers of one set
} WireArg;

// Behind it: `sets` times the numbers (double) of all inputs, in their order. The function is called once a set.
typedef struct {
    uint64_t ticket; // comes back in the answer
    char function[WIRE_NAME_BYTES];
    uint32_t arg_count, sets;
    WireArg args[WIRE_ARGS_MAX];
} WireRequest;

// Numbers of one set that go in, and that come out.
static inline uint64_t wire_inputs(const WireRequest *request) {
    uint64_t sum = 0;
    for (uint32_t k = 0; k < request->arg_count; k++) sum += request->args[k].is_input ? request->args[k].count : 0;
    return sum;
}

static inline uint64_t wire_outputs(const WireRequest *request) {
    uint64_t sum = 0;
    for (uint32_t k = 0; k < request->arg_count; k++) sum += request->args[k].is_output ? request->args[k].count : 0;
    return sum;
}

typedef enum {
    ANSWER_DONE,
    ANSWER_NOT_STARTED,   // text, line: the file and place of NOT_STARTED
    ANSWER_NO_FUNCTION,   // the library has no such function; text says why
    ANSWER_WROTE_OUTSIDE, // arg, element: where a guard word was changed (element < 0 or >= count)
    ANSWER_CHANGED_INPUT, // arg, element
    ANSWER_CRASHED,       // signal, offset: place in the library; text: what was asked of malloc when it refused
    // Of kernels alone:
    ANSWER_ORDER,    // arg, element: another number when the work-items run in another order; text: which
    ANSWER_REPORTED, // text: what Oclgrind has seen
    ANSWER_DEVICE,   // text: why OpenCL did not do it
} WireOutcome;

// Behind it when done: `sets` times the numbers of all outputs.
typedef struct {
    uint64_t ticket;
    uint64_t offset; // ANSWER_CRASHED: of the instruction, from the library's start; 0: elsewhere
    uint64_t address;
    uint64_t refused_bytes; // the largest request that malloc refused; 0: none
    int32_t outcome, line, arg, element, signal;
    char text[WIRE_TEXT_BYTES];
} WireAnswer;

#endif
