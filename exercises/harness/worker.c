// worker.c - the program `splatlab-worker LIBRARY SECONDS MEGABYTES`: runs a student's functions for the judge (wire.h).
//
// A process of its own, started afresh for each library, with limits on memory and processor time. Standard output and
// error are the student's; the judge is spoken to through the socket WIRE_FD alone.
#include "exercises/harness/wire.h"
#include "exercises/harness/worker_channel.h"
#include "exercises/harness/worker_fence.h"
#include "exercises/harness/worker_guard.h"
#include "exercises/harness/worker_number.h"

#include <dlfcn.h>
#include <setjmp.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <unistd.h>

// The library is compiled for float or double; it says which by its symbol REAL_BYTES.
typedef struct {
    const char *name;
    void (*call)(void **a);
} AnyCall;

typedef struct {
    const AnyCall *calls;
    NumberType type;
} Library;

static jmp_buf not_started_jump;
static WireAnswer not_started_answer;

// The answer's functions call it through NOT_STARTED.
void exercise_not_started(const char *file, int line);
void exercise_not_started(const char *file, int line) {
    not_started_answer.outcome = ANSWER_NOT_STARTED;
    not_started_answer.line = line;
    snprintf(not_started_answer.text, sizeof not_started_answer.text, "%s", file);
    longjmp(not_started_jump, 1);
}

static void *need(void *p) {
    if (!p) _exit(3);
    return p;
}

// ---- arguments between guard words ----

// All arguments of a request, each between its guards.
typedef struct {
    char *memory[WIRE_ARGS_MAX]; // guard, numbers, guard; owned
    void *numbers[WIRE_ARGS_MAX];
} Frame;

static Frame frame_create(const WireRequest *request, NumberType type) {
    Frame frame = {0};
    for (uint32_t k = 0; k < request->arg_count; k++) {
        frame.memory[k] = need(calloc(request->args[k].count + 2 * WIRE_GUARD, number_bytes(type)));
        frame.numbers[k] = frame.memory[k] + WIRE_GUARD * number_bytes(type);
    }
    return frame;
}

static void frame_destroy(Frame *frame) {
    for (int k = 0; k < WIRE_ARGS_MAX; k++) free(frame->memory[k]);
}

// Inputs, poison and guards of one set; returns where the next set's inputs begin.
static const double *frame_fill(Frame *frame, const WireRequest *request, NumberType type, const double *in) {
    for (uint32_t k = 0; k < request->arg_count; k++) {
        size_t count = request->args[k].count;
        for (size_t i = 0; i < WIRE_GUARD; i++) {
            number_set(frame->memory[k], i, type, 0, true);
            number_set(frame->memory[k], WIRE_GUARD + count + i, type, 0, true);
        }
        for (size_t i = 0; i < count; i++) {
            if (request->args[k].is_input)
                number_set(frame->numbers[k], i, type, *in++, false);
            else
                number_poison(frame->numbers[k], i, type);
        }
    }
    return in;
}

// Sets outcome, arg and element where the call wrote what it must not.
static bool frame_check(const Frame *frame, const WireRequest *request, NumberType type, const double *in,
                        WireAnswer *head) {
    for (uint32_t k = 0; k < request->arg_count; k++) {
        size_t count = request->args[k].count;
        for (size_t i = 0; i < count + 2 * WIRE_GUARD; i++) {
            bool is_guard = i < WIRE_GUARD || i >= WIRE_GUARD + count;
            if (!is_guard && request->args[k].is_output) continue;
            if (number_is(frame->memory[k], i, type, is_guard ? 0 : in[i - WIRE_GUARD], is_guard)) continue;
            head->outcome = is_guard ? ANSWER_WROTE_OUTSIDE : ANSWER_CHANGED_INPUT;
            head->arg = (int32_t)k;
            head->element = (int32_t)i - WIRE_GUARD;
            return false;
        }
        if (request->args[k].is_input) in += count;
    }
    return true;
}

// ---- one request ----

static const AnyCall *find_call(const Library *library, const char *name) {
    for (const AnyCall *call = library->calls; call->name; call++)
        if (strcmp(call->name, name) == 0) return call;
    return NULL;
}

// False when the function is not started yet. (A function of its own: setjmp() leaves nothing else of a caller's certain.)
static bool call_once(const AnyCall *call, Frame *frame) {
    if (setjmp(not_started_jump) != 0) return false;
    call->call(frame->numbers);
    return true;
}

static double *take_outputs(const Frame *frame, const WireRequest *request, NumberType type, double *out) {
    for (uint32_t k = 0; k < request->arg_count; k++)
        for (size_t i = 0; request->args[k].is_output && i < request->args[k].count; i++)
            *out++ = number_get(frame->numbers[k], i, type);
    return out;
}

// Calls the function for each set; false with the outcome in *head when something was wrong.
static bool call_all(const Library *library, const AnyCall *call, const WireRequest *request, const double *in,
                     double *out, WireAnswer *head) {
    Frame frame = frame_create(request, library->type);
    bool good = true;
    for (uint32_t set = 0; good && set < request->sets; set++) {
        const double *next = frame_fill(&frame, request, library->type, in);
        if (call_once(call, &frame)) {
            good = frame_check(&frame, request, library->type, in, head);
        } else {
            not_started_answer.ticket = head->ticket;
            *head = not_started_answer;
            good = false;
        }
        if (good) out = take_outputs(&frame, request, library->type, out);
        in = next;
    }
    frame_destroy(&frame);
    return good;
}

static void serve(const Library *library) {
    WireRequest request;
    channel_receive(&request, sizeof request);
    size_t in_count = wire_inputs(&request) * request.sets, out_count = wire_outputs(&request) * request.sets;
    double *in = need(calloc(in_count + 1, sizeof *in)), *out = need(calloc(out_count + 1, sizeof *out));
    channel_receive(in, in_count * sizeof *in);

    WireAnswer head = {.ticket = request.ticket, .outcome = ANSWER_DONE};
    const AnyCall *call = find_call(library, request.function);
    bool good = call != NULL;
    if (!call) head.outcome = ANSWER_NO_FUNCTION;
    worker_guard_ticket(request.ticket);
    if (call) good = call_all(library, call, &request, in, out, &head);
    fflush(stdout);
    channel_answer(&head, out, good ? out_count : 0);
    free(in);
    free(out);
}

// What cannot be loaded is told when the first request comes.
static void refuse(const char *why) {
    WireRequest request;
    channel_receive(&request, sizeof request);
    WireAnswer head = {.ticket = request.ticket, .outcome = ANSWER_NO_FUNCTION};
    snprintf(head.text, sizeof head.text, "%s", why);
    channel_answer(&head, NULL, 0);
    _exit(1);
}

int main(int argc, char **argv) {
    if (argc != 4) {
        fprintf(stderr, "splatlab-worker is started by `splatlab exercise`\n");
        return 2;
    }
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    worker_guard_limits(atoi(argv[2]), atoi(argv[3]), 1);
    worker_guard_signals();
    worker_fence_raise(); // before the library, whose constructors run in dlopen()
    void *handle = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
    if (!handle) refuse(dlerror());
    const int *real_bytes = dlsym(handle, "REAL_BYTES");
    Library library = {.calls = dlsym(handle, "CALLS"),
                       .type = real_bytes && *real_bytes == sizeof(float) ? NUMBER_FLOAT : NUMBER_DOUBLE};
    if (!library.calls || !real_bytes) refuse("the library was not built by splatlab exercise");
    worker_guard_library(dlsym(handle, "CALLS"));
    for (;;) serve(&library);
}
