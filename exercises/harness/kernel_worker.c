// kernel_worker.c - the program `splatlab-kernel-worker check|serve TEXT [LOG]`: compiles and runs a student's kernels for the
// judge, as worker.c does for C (wire.h).
//
// The first argument of a kernel is the number of work-items; whole groups of 64 are started, at least one. Its buffers stand between
// guard words, and every call is made in three orders of work-items (kernel_layer.cl). With LOG it runs under Oclgrind, which
// writes its report there: then buffers have their exact size, and one order is enough.
#include "exercises/harness/kernel_scan.h"
#include "exercises/harness/oclgrind_report.h"
#include "exercises/harness/worker_channel.h"
#include "exercises/harness/worker_guard.h"
#include "exercises/harness/worker_number.h"
#include "lab/base/fail.h"
#include "lab/base/log.h"
#include "lab/base/mem.h"
#include "lab/gpu/gpu.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <unistd.h>

enum { GROUP = 64, ORDERS = 3, LIMIT_S = 60, LIMIT_MB = 1 << 14, LIMIT_FILE_MB = 64, EXIT_NO_DEVICE = 3 };
static const char *const ORDER_NAMES[ORDERS + 1] = {"", "ascending", "descending", "shuffled"};

typedef struct {
    Gpu *gpu;
    GpuProgram *program;
    const char *text; // of the student
    char file[256];   // its path
    FILE *log;        // Oclgrind's, which writes it; NULL without
} Worker;

// One argument of the kernel that is called.
typedef struct {
    bool is_buffer;
    NumberType type;
    size_t count, guard, bytes; // numbers; bytes of a guard, and of all
    char *before, *after;       // (bytes) as it was filled, and as the kernel left it
    GpuBuffer *whole, *part;
    char scalar[8];
} Slot;

// ---- the text ----

// "#line 1 "exercises/20_adam/adam.cl"" and the student's text follow the layer, which has such a line of its own.
static void find_text(Worker *w, const char *all) {
    static const char MARK[] = "#line 1 \"";
    const char *first = strstr(all, MARK), *second = first ? strstr(first + 1, MARK) : NULL;
    if (!second) return;
    const char *name = second + strlen(MARK), *end = strchr(name, '"');
    snprintf(w->file, sizeof w->file, "%.*s", (int)(end - name), name);
    w->text = strchr(end, '\n') + 1;
}

static bool read_all(const char *path, char **all) {
    FILE *stream = fopen(path, "rb");
    size_t size = 0;
    *all = mem_alloc(1 << 20, 1);
    if (stream) size = fread(*all, 1, (1 << 20) - 1, stream);
    if (stream) fclose(stream);
    return size > 0 || fail("cannot read %s", path);
}

// In the tree the kernels lie two floors above build/release; installed ones are found by themselves.
static void name_kernel_folder(void) {
    char program[4096];
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    program[length > 0 ? length : 0] = 0;
    char *slash = strrchr(program, '/');
    if (slash) *slash = 0;
    char *folder = mem_format("%s/../../kernels", program);
    if (access(folder, R_OK) == 0) setenv("SPLATLAB_KERNELS", folder, 0);
    mem_free(folder);
}

static bool open_device(Worker *w) {
    name_kernel_folder();
    log_set_quiet(true);
    setenv("POCL_MAX_PTHREAD_COUNT", "1", 0); // groups one after another: a race gives the same wrong numbers each time
    return gpu_open("cpu", &w->gpu) || gpu_open("auto", &w->gpu);
}

static bool compile(Worker *w, const char *path) {
    char *folder = mem_text(path), *slash = strrchr(folder, '/'), *all;
    if (slash) *slash = 0;
    gpu_set_kernel_folder(slash ? folder : ".");
    bool good = read_all(path, &all);
    if (good) find_text(w, all);
    good = good && gpu_program_create(w->gpu, slash ? slash + 1 : folder, "-cl-kernel-arg-info", &w->program);
    mem_free(folder);
    return good;
}

// What the compiler says, without the lines that name the device.
static int check(Worker *w, const char *path) {
    if (!open_device(w)) {
        printf("%s\n", fail_text());
        return EXIT_NO_DEVICE;
    }
    if (compile(w, path)) return 0;
    const char *log = strchr(fail_text(), '\n');
    for (const char *line = log ? log + 1 : fail_text(); *line; line += strcspn(line, "\n"), line += *line != 0)
        if (strncmp(line, "Device ", 7) != 0) printf("%.*s\n", (int)strcspn(line, "\n"), line);
    return 1;
}

// ---- arguments ----

static void slot_free(Slot *slot) {
    gpu_buffer_destroy(slot->part);
    gpu_buffer_destroy(slot->whole);
    mem_free(slot->before);
    mem_free(slot->after);
    *slot = (Slot){0};
}

static bool slot_make(const Worker *w, const GpuParameter *parameter, int index, size_t count, Slot *slot) {
    static const char *const TYPES[] = {"float", "double", "int"};
    int type = 0;
    while (type < 3 && strcmp(TYPES[type], parameter->type) != 0) type++;
    if (type == 3 || parameter->is_local)
        return fail("argument %d is of type '%s'; keep the kernel's arguments as they were", index + 1,
                    parameter->type);
    *slot = (Slot){.is_buffer = parameter->is_buffer, .type = (NumberType)type, .count = count};
    if (!slot->is_buffer) return count == 1 || fail("argument %d is one number, not a buffer", index + 1);
    size_t own = count ? count * number_bytes(slot->type) : number_bytes(slot->type);
    slot->guard = w->log ? 0 : GPU_PART_STEP;
    slot->bytes = own + 2 * slot->guard;
    slot->before = mem_alloc(slot->bytes, 1);
    slot->after = mem_alloc(slot->bytes, 1);
    return gpu_buffer_create(w->gpu, "an argument", slot->bytes, &slot->whole) &&
           gpu_buffer_part(slot->whole, "an argument", slot->guard, own, &slot->part);
}

// Returns where the next argument's inputs begin.
static const double *slot_fill(Slot *slot, bool is_input, const double *in) {
    if (!slot->is_buffer) {
        number_set(slot->scalar, 0, slot->type, *in, false);
        return in + 1;
    }
    size_t all = slot->bytes / number_bytes(slot->type);
    char *numbers = slot->before + slot->guard;
    for (size_t i = 0; i < all; i++) number_set(slot->before, i, slot->type, 0, true);
    for (size_t i = 0; i < slot->count; i++)
        if (is_input)
            number_set(numbers, i, slot->type, *in++, false);
        else
            number_poison(numbers, i, slot->type);
    return in;
}

static GpuArg slot_arg(const Slot *slot) {
    return slot->is_buffer ? gpu_buffer_arg(slot->part) : gpu_record_arg(slot->scalar, number_bytes(slot->type));
}

// Sets the outcome where the kernel wrote what it must not.
static bool slot_check(const Slot *slot, bool is_output, int index, WireAnswer *head) {
    size_t step = number_bytes(slot->type), first = slot->guard / step;
    if (!slot->is_buffer || memcmp(slot->before, slot->after, slot->bytes) == 0) return true;
    for (size_t i = 0; i < slot->bytes / step; i++) {
        bool is_own = i >= first && i < first + slot->count;
        if ((is_own && is_output) || memcmp(slot->before + i * step, slot->after + i * step, step) == 0) continue;
        head->outcome = is_own ? ANSWER_CHANGED_INPUT : ANSWER_WROTE_OUTSIDE;
        head->arg = index;
        head->element = (int32_t)i - (int32_t)first;
        return false;
    }
    return true;
}

// ---- one call ----

typedef struct {
    const WireRequest *request;
    GpuKernel *kernel;
    Slot slots[WIRE_ARGS_MAX];
} KernelCall;

static bool call_make(Worker *w, KernelCall *call) {
    const WireRequest *r = call->request;
    if (!gpu_kernel(w->program, r->function, &call->kernel)) return false;
    int wanted = gpu_kernel_parameters(call->kernel);
    if (wanted != (int)r->arg_count) return fail("it has %d arguments, want %u", wanted, r->arg_count);
    for (int k = 0; k < wanted; k++) {
        GpuParameter parameter;
        if (!gpu_kernel_parameter(call->kernel, k, &parameter) ||
            !slot_make(w, &parameter, k, r->args[k].count, &call->slots[k]))
            return false;
    }
    return true;
}

// Fills, runs, reads back. order 0: as it comes, so that Oclgrind's numbers of work-items are the true ones.
static bool call_run(Worker *w, KernelCall *call, const double *in, int order) {
    GpuArg args[WIRE_ARGS_MAX];
    int count = (int)call->request->arg_count;
    size_t items = in[0] >= 1 ? (size_t)in[0] : 1;
    for (int k = 0; k < count; k++) {
        Slot *slot = &call->slots[k];
        in = slot_fill(slot, call->request->args[k].is_input, in);
        if (slot->is_buffer && !gpu_buffer_write(slot->whole, slot->before, slot->bytes)) return false;
        args[k] = slot_arg(slot);
    }
    if (!gpu_launch_args_from(call->kernel, gpu_range(items, GROUP), (size_t)order, args, count) || !gpu_finish(w->gpu))
        return false;
    for (int k = 0; k < count; k++) {
        Slot *slot = &call->slots[k];
        if (slot->is_buffer && !gpu_buffer_read(slot->whole, slot->after, slot->bytes)) return false;
    }
    return true;
}

static bool call_check(const KernelCall *call, WireAnswer *head) {
    for (uint32_t k = 0; k < call->request->arg_count; k++)
        if (!slot_check(&call->slots[k], call->request->args[k].is_output, (int)k, head)) return false;
    return true;
}

// The outputs; those of the orders after the first must be the same, to the bit.
static bool call_take(const KernelCall *call, int order, double *out, WireAnswer *head) {
    for (uint32_t k = 0; k < call->request->arg_count; k++) {
        const Slot *slot = &call->slots[k];
        for (size_t i = 0; call->request->args[k].is_output && i < slot->count; i++, out++) {
            double value = number_get(slot->after + slot->guard, i, slot->type);
            bool is_same = memcmp(&value, out, sizeof value) == 0 || (isnan(value) && isnan(*out));
            if (order > 1 && !is_same) {
                head->outcome = ANSWER_ORDER;
                head->arg = (int32_t)k;
                head->element = (int32_t)i;
                snprintf(head->text, sizeof head->text, "%.6g ascending, %.6g %s", *out, value, ORDER_NAMES[order]);
                return false;
            }
            *out = value;
        }
    }
    return true;
}

static bool call_all(Worker *w, KernelCall *call, const double *in, double *out, WireAnswer *head) {
    for (uint32_t set = 0; set < call->request->sets; set++) {
        for (int order = w->log ? 0 : 1; order <= (w->log ? 0 : ORDERS); order++) {
            if (!call_run(w, call, in, order)) {
                head->outcome = ANSWER_DEVICE;
                snprintf(head->text, sizeof head->text, "%s", fail_text());
                return false;
            }
            if (w->log && oclgrind_report_read(w->log, head->text, sizeof head->text)) {
                head->outcome = ANSWER_REPORTED;
                return false;
            }
            if (!call_check(call, head) || !call_take(call, order, out, head)) return false;
        }
        in += wire_inputs(call->request);
        out += wire_outputs(call->request);
    }
    return true;
}

static void serve(Worker *w) {
    WireRequest request;
    channel_receive(&request, sizeof request);
    size_t in_count = wire_inputs(&request) * request.sets, out_count = wire_outputs(&request) * request.sets;
    double *in = mem_alloc(in_count + 1, sizeof *in), *out = mem_alloc(out_count + 1, sizeof *out);
    channel_receive(in, in_count * sizeof *in);

    WireAnswer head = {.ticket = request.ticket, .outcome = ANSWER_DONE};
    KernelCall call = {.request = &request};
    bool good = false;
    worker_guard_ticket(request.ticket);
    if (kernel_scan_not_started(w->text, request.function, &head.line)) {
        head.outcome = ANSWER_NOT_STARTED;
        snprintf(head.text, sizeof head.text, "%s", w->file);
    } else if (!call_make(w, &call)) {
        head.outcome = ANSWER_NO_FUNCTION;
        snprintf(head.text, sizeof head.text, "%s", call.kernel ? fail_text() : "");
    } else {
        good = call_all(w, &call, in, out, &head);
    }
    fflush(stdout);
    channel_answer(&head, out, good ? out_count : 0);
    for (int k = 0; k < WIRE_ARGS_MAX; k++) slot_free(&call.slots[k]);
    mem_free(in);
    mem_free(out);
}

int main(int argc, char **argv) {
    Worker w = {.text = ""};
    if (argc < 3) {
        fprintf(stderr, "splatlab-kernel-worker is started by `splatlab exercise`\n");
        return 2;
    }
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    worker_guard_limits(LIMIT_S, LIMIT_MB, LIMIT_FILE_MB);
    if (strcmp(argv[1], "check") == 0) return check(&w, argv[2]);
    if (argc > 3) w.log = fopen(argv[3], "a+"); // Oclgrind makes it when it is needed
    if (!open_device(&w) || !compile(&w, argv[2])) {
        fprintf(stderr, "%s\n", fail_text());
        return 1;
    }
    worker_guard_library(NULL);
    worker_guard_signals();
    channel_answer(&(WireAnswer){.outcome = ANSWER_DONE}, NULL, 0); // awake
    for (;;) serve(&w);
}
