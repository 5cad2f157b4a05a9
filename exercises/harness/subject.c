// subject.c - requests out, answers in, and sentences for all that can go wrong between.
#include "exercises/harness/subject.h"

#include "exercises/harness/wire.h"
#include "exercises/harness/worker_process.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"

#include <assert.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <sys/wait.h>
#include <unistd.h>

struct Subject {
    char *library, *file, *program;
    WorkerProcess worker;
    uint64_t ticket;
    Trouble trouble;
    double *numbers; // (capacity) of a request or an answer
    size_t capacity;
    bool is_kernel, is_awake;              // awake: a worker for kernels has said that it has compiled them
    char *log;                             // Oclgrind's report; NULL: not under Oclgrind
    char printed[WORKER_PRINTED_KEPT + 1]; // of the workers that died, and of the running one
};

// ---- life ----

static bool start_worker(Subject *s) {
    char seconds[16], megabytes[16];
    snprintf(seconds, sizeof seconds, "%d", WORKER_CPU_SECONDS);
    snprintf(megabytes, sizeof megabytes, "%d", WORKER_MEGABYTES);
    const char *plain[] = {s->program, s->library, seconds, megabytes, NULL};
    const char *kernels[] = {s->program, "serve", s->library, NULL};
    const char *watched[] = {"oclgrind", "--data-races", "--log", s->log, s->program,
                             "serve",    s->library,     s->log,  NULL};
    s->is_awake = !s->is_kernel;
    return worker_process_start(&s->worker, s->log ? watched : s->is_kernel ? kernels : plain);
}

static Subject *start(const char *library, const char *file, bool under_oclgrind) {
    char *program;
    bool is_kernel = file_has_ending(library, ".cl");
    if (!worker_program_find(is_kernel, &program)) return NULL;
    Subject *s = mem_alloc(1, sizeof *s);
    s->library = mem_text(library);
    s->file = mem_text(file);
    s->program = program;
    s->is_kernel = is_kernel;
    if (getrandom(&s->ticket, sizeof s->ticket, 0) < 0) s->ticket = 1;
    if (under_oclgrind) s->log = mem_format("%s.%llx.log", library, (unsigned long long)s->ticket);
    if (start_worker(s)) return s;
    subject_stop(s);
    return NULL;
}

Subject *subject_start(const char *library, const char *file) { return start(library, file, false); }

Subject *subject_again_oclgrind(const Subject *s) { return start(s->library, s->file, true); }

bool subject_is_kernel(const Subject *s) { return s->is_kernel; }

bool subject_has_oclgrind(void) {
    const char *path = getenv("PATH");
    char *folders = mem_text(path ? path : ""), *rest = folders;
    bool found = false;
    for (char *folder; !found && (folder = strsep(&rest, ":"));) {
        char *program = mem_format("%s/oclgrind", folder);
        found = access(program, X_OK) == 0;
        mem_free(program);
    }
    mem_free(folders);
    return found;
}

// Keeps what it printed.
static int stop_worker(Subject *s) {
    int status = worker_process_stop(&s->worker);
    size_t have = strlen(s->printed);
    snprintf(s->printed + have, sizeof s->printed - have, "%s", s->worker.printed);
    s->worker.printed[0] = 0;
    return status;
}

void subject_stop(Subject *s) {
    if (!s) return;
    stop_worker(s);
    if (s->log) unlink(s->log);
    mem_free(s->log);
    mem_free(s->library);
    mem_free(s->file);
    mem_free(s->program);
    mem_free(s->numbers);
    mem_free(s);
}

const Trouble *subject_trouble(const Subject *s) { return &s->trouble; }

const char *subject_printed(const Subject *s) { return s->printed[0] ? s->printed : s->worker.printed; }

bool number_is_unwritten(double value) { return memcmp(&value, &WIRE_UNWRITTEN, sizeof value) == 0; }

// ---- trouble ----

#define MEDDLING_TEXT "%s() wrote into the channel of the test"

static bool trouble(Subject *s, TroubleKind kind, const char *format, ...) __attribute__((format(printf, 3, 4)));
static bool trouble(Subject *s, TroubleKind kind, const char *format, ...) {
    va_list args;
    va_start(args, format);
    s->trouble.kind = kind;
    vsnprintf(s->trouble.text, sizeof s->trouble.text, format, args);
    va_end(args);
    return false;
}

// " at cov2.c:12", from the library's own debugging information; "" when the place is not the student's.
static void place_of(const Subject *s, uint64_t offset, char *text, size_t size) {
    text[0] = 0;
    if (!offset || strchr(s->library, '\'')) return; // the path stands in quotes below
    char *command = mem_format("addr2line -e '%s' 0x%llx 2>/dev/null", s->library, (unsigned long long)offset);
    FILE *lines = popen(command, "r");
    mem_free(command);
    char line[512];
    if (lines && fgets(line, sizeof line, lines)) {
        char *name = strrchr(line, '/');
        name = name ? name + 1 : line;
        name[strcspn(name, " (\n")] = 0;
        if (name[0] != '?' && !strchr(name, '?')) snprintf(text, size, " at %.100s", name);
    }
    if (lines) pclose(lines);
}

static bool say_crash(Subject *s, const char *function, const WireAnswer *head) {
    char place[160];
    place_of(s, head->offset, place, sizeof place);
    if (head->refused_bytes)
        return trouble(s, TROUBLE_MEMORY,
                       "%s() asked for %.3g MB of memory, which was refused (the limit is %d MB), and crashed%s: %s",
                       function, (double)head->refused_bytes / 1e6, WORKER_MEGABYTES, place, strsignal(head->signal));
    if (head->signal == 8) return trouble(s, TROUBLE_CRASHED, "%s() divided an integer by zero%s", function, place);
    const char *cause = head->address < 4096 ? ", a NULL pointer was followed" : "";
    return trouble(s, TROUBLE_CRASHED, "%s() crashed%s: %s (address 0x%llx%s)", function, place,
                   strsignal(head->signal), (unsigned long long)head->address, cause);
}

static bool say_answer(Subject *s, const char *function, const Arg *args, int count, const WireAnswer *head) {
    if (head->arg < 0 || head->arg >= count) return trouble(s, TROUBLE_MEDDLING, MEDDLING_TEXT, function);
    const char *symbol = strstr(head->text, "undefined symbol"); // behind the path of a file that nobody knows
    switch ((WireOutcome)head->outcome) {
    case ANSWER_DONE:
        return true;
    case ANSWER_NOT_STARTED:
        return trouble(s, TROUBLE_NOT_STARTED, "not started yet: this is the place: %s:%d", head->text, head->line);
    case ANSWER_NO_FUNCTION:
        return trouble(s, TROUBLE_NO_FUNCTION, "%s has no function %s(): keep its name and its arguments%s%s", s->file,
                       function, head->text[0] ? "; " : "", symbol ? symbol : head->text);
    case ANSWER_WROTE_OUTSIDE:
        return trouble(s, TROUBLE_WROTE_OUTSIDE, "%s() wrote outside its argument %s: %s[%d], which has %d number%s",
                       function, args[head->arg].name, args[head->arg].name, head->element, args[head->arg].count,
                       args[head->arg].count == 1 ? "" : "s");
    case ANSWER_CHANGED_INPUT:
        return trouble(s, TROUBLE_CHANGED_INPUT, "%s() changed its input %s[%d]: inputs are only read", function,
                       args[head->arg].name, head->element);
    case ANSWER_CRASHED:
        return say_crash(s, function, head);
    case ANSWER_ORDER:
        return trouble(s, TROUBLE_ORDER,
                       "%s() gives another %s[%d] when its work-items run in another order (%s): one of them reads or "
                       "writes what belongs to another",
                       function, args[head->arg].name, head->element, head->text);
    case ANSWER_REPORTED:
        return trouble(s, TROUBLE_REPORTED, "Oclgrind, which watches every work-item: %s", head->text);
    case ANSWER_DEVICE:
        return trouble(s, TROUBLE_DEVICE, "%s() could not run: %s", function, head->text);
    }
    return trouble(s, TROUBLE_MEDDLING, MEDDLING_TEXT, function);
}

static double limit_s(const Subject *s) {
    return (s->log ? WORKER_OCLGRIND_MS : s->is_kernel ? WORKER_KERNEL_MS : WORKER_CALL_MS) / 1000.0;
}

// The worker did not answer: it ended, or has to be ended.
static bool say_silence(Subject *s, const char *function, Heard heard) {
    int status = stop_worker(s);
    if (heard == HEARD_TIMEOUT)
        return trouble(s, TROUBLE_TIMEOUT, "%s() did not come back within %.0f s: a loop without end?", function,
                       limit_s(s));
    if (heard == HEARD_FLOOD)
        return trouble(s, TROUBLE_FLOOD, "%s() printed more than %d MB and was stopped", function,
                       WORKER_PRINTED_MAX >> 20);
    if (WIFSIGNALED(status))
        return trouble(s, TROUBLE_ENDED, "%s() ended by a signal: %s", function, strsignal(WTERMSIG(status)));
    return trouble(s, TROUBLE_ENDED, "%s() ended the whole process with exit code %d, where it should return", function,
                   WEXITSTATUS(status));
}

// ---- calls ----

static void need_numbers(Subject *s, size_t count) {
    if (count <= s->capacity) return;
    s->numbers = mem_resize(s->numbers, s->capacity, count, sizeof *s->numbers);
    s->capacity = count;
}

// Does the argument go that way? Into the worker, or out of it.
static bool goes(const Arg *arg, bool out) { return out ? arg->is_output : !arg->is_output || arg->is_updated; }

static size_t copy_numbers(Subject *s, const Arg *args, int count, int sets, bool out) {
    size_t n = 0;
    for (int set = 0; set < sets; set++)
        for (int k = 0; k < count; k++) {
            if (!goes(&args[k], out)) continue;
            double *numbers = args[k].numbers + (size_t)set * (size_t)args[k].count;
            size_t bytes = (size_t)args[k].count * sizeof *numbers;
            if (out)
                memcpy(numbers, s->numbers + n, bytes);
            else
                memcpy(s->numbers + n, numbers, bytes);
            n += (size_t)args[k].count;
        }
    return n;
}

static size_t count_numbers(const Arg *args, int count, int sets, bool out) {
    size_t n = 0;
    for (int k = 0; k < count; k++)
        if (goes(&args[k], out)) n += (size_t)args[k].count;
    return n * (size_t)sets;
}

static void poison_outputs(const Arg *args, int count, int sets) {
    for (int k = 0; k < count; k++)
        for (size_t i = 0; args[k].is_output && i < (size_t)args[k].count * (size_t)sets; i++) args[k].numbers[i] = NAN;
}

static WireRequest make_request(Subject *s, const char *function, const Arg *args, int count, int sets) {
    WireRequest request = {.ticket = ++s->ticket, .arg_count = (uint32_t)count, .sets = (uint32_t)sets};
    assert(count <= WIRE_ARGS_MAX && strlen(function) < WIRE_NAME_BYTES);
    snprintf(request.function, sizeof request.function, "%s", function);
    for (int k = 0; k < count; k++)
        request.args[k] = (WireArg){
            .is_input = goes(&args[k], false), .is_output = args[k].is_output, .count = (uint32_t)args[k].count};
    return request;
}

// A worker for kernels compiles them first; that takes longer than a call may.
static Heard wake(Subject *s) {
    WireAnswer ready;
    if (s->is_awake) return HEARD;
    worker_process_grant(&s->worker, WORKER_WAKE_MS / 1000.0);
    Heard heard = worker_process_receive(&s->worker, &ready, sizeof ready);
    s->is_awake = heard == HEARD;
    return heard;
}

static Heard exchange(Subject *s, const WireRequest *request, size_t in, WireAnswer *head) {
    Heard heard = worker_process_send(&s->worker, request, sizeof *request);
    if (heard == HEARD) heard = worker_process_send(&s->worker, s->numbers, in * sizeof(double));
    if (heard == HEARD || heard == HEARD_END) heard = worker_process_receive(&s->worker, head, sizeof *head);
    return heard;
}

bool subject_call_sets(Subject *s, const char *function, const Arg *args, int count, int sets) {
    s->trouble = (Trouble){0};
    WireRequest request = make_request(s, function, args, count, sets);
    size_t in = count_numbers(args, count, sets, false), out = count_numbers(args, count, sets, true);
    need_numbers(s, in > out ? in : out);
    copy_numbers(s, args, count, sets, false);
    poison_outputs(args, count, sets);
    if (!s->worker.pid && !start_worker(s)) return trouble(s, TROUBLE_ENDED, "the worker could not be started again");

    WireAnswer head;
    Heard heard = wake(s);
    worker_process_grant(&s->worker, limit_s(s));
    if (heard == HEARD) heard = exchange(s, &request, in, &head);
    if (heard != HEARD) return say_silence(s, function, heard);
    if (head.ticket != request.ticket) {
        stop_worker(s);
        return trouble(s, TROUBLE_MEDDLING, MEDDLING_TEXT, function);
    }
    head.text[sizeof head.text - 1] = 0;
    if (!say_answer(s, function, args, count, &head)) {
        if (head.outcome == ANSWER_CRASHED) stop_worker(s);
        return false;
    }
    heard = worker_process_receive(&s->worker, s->numbers, out * sizeof(double));
    if (heard != HEARD) return say_silence(s, function, heard);
    copy_numbers(s, args, count, sets, true);
    return true;
}

bool subject_call(Subject *s, const char *function, const Arg *args, int count) {
    return subject_call_sets(s, function, args, count, 1);
}
