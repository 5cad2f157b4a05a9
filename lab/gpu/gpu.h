// gpu.h - one OpenCL device with its context and queue, and what it can do.
//
// The files of this folder are the only ones that include CL/cl.h; above them a device, a kernel and a buffer are
// opaque. Commands run in order on one queue; gpu_finish() or a map waits for them.
#ifndef SPLATLAB_LAB_GPU_GPU_H
#define SPLATLAB_LAB_GPU_GPU_H

#include <stdbool.h>
#include <stddef.h>

typedef struct Gpu Gpu;

typedef struct {
    char name[256];     // "pthread-skylake-avx512-Intel(R) ..."
    char platform[128]; // "Portable Computing Language"
    char version[128];  // "OpenCL 1.2 pocl"
    bool is_cpu;        // decides which of the two blend kernels runs
    int compute_units;
    size_t memory_bytes;    // of the device, as it says itself
    size_t max_alloc_bytes; // of one buffer
    bool has_fp64;
} GpuInfo;

// All devices of all platforms, in a fixed order; *infos is owned by the caller (mem_free). Zero devices is no failure.
bool gpu_list(GpuInfo **infos, int *count);

// Opens a device. spec: "" or "auto" (the best GPU, else the CPU), "cpu", "gpu", a number of gpu_list()'s order, or a part of
// the name. Runs the known-answer self-test the first time a device is used in this process. Fails with the list of what there
// is, or with what to install when there is none.
bool gpu_open(const char *spec, Gpu **gpu);
void gpu_close(Gpu *gpu); // accepts NULL

const GpuInfo *gpu_info(const Gpu *gpu);

// Where kernel files are looked for, each file by itself, first match: gpu_set_kernel_folder(), $SPLATLAB_KERNELS, "kernels"
// beside the program, "kernels" in the working folder, the installed folder (PREFIX/share/splatlab/kernels). So an
// overriding folder needs to hold only the files that differ.
void gpu_set_kernel_folder(const char *folder);      // NULL: none
bool gpu_kernel_path(const char *file, char **path); // owned by the caller

// ---- programs and kernels ----
typedef struct GpuProgram GpuProgram;
typedef struct GpuKernel GpuKernel;

// Compiles the file (a name in the kernel folder, "blend_forward_cpu.cl"). options: "-D NAME=1", or "". Files named by
// #include "name" are looked up like kernel files. On failure the message holds the compiler's log with file and line.
bool gpu_program_create(Gpu *gpu, const char *file, const char *options, GpuProgram **program);
void gpu_program_destroy(GpuProgram *program); // accepts NULL

// A kernel of the program; destroyed with its program.
bool gpu_kernel(GpuProgram *program, const char *name, GpuKernel **kernel);

// What a kernel declares, where its program was compiled with -cl-kernel-arg-info. type: "float" also for a buffer of them.
typedef struct {
    char type[32];
    bool is_buffer, is_local;
} GpuParameter;
int gpu_kernel_parameters(const GpuKernel *kernel);
bool gpu_kernel_parameter(const GpuKernel *kernel, int index, GpuParameter *parameter);

// ---- buffers ----
typedef struct GpuBuffer GpuBuffer;

// A zeroed buffer of that many bytes (at least 1). `name` is for error messages ("pair records").
bool gpu_buffer_create(Gpu *gpu, const char *name, size_t bytes, GpuBuffer **buffer);

// A part of another buffer, under a name of its own: `bytes` (at least 1) from `offset` on, a multiple of GPU_PART_STEP. Destroy
// it before the whole one.
enum { GPU_PART_STEP = 4096 };
bool gpu_buffer_part(GpuBuffer *whole, const char *name, size_t offset, size_t bytes, GpuBuffer **part);
void gpu_buffer_destroy(GpuBuffer *buffer);       // accepts NULL
size_t gpu_buffer_bytes(const GpuBuffer *buffer); // what was asked for last; the capacity may be larger

// Makes room for `bytes`. Grows by half at least, never shrinks; the content is lost (zeroed) when it
// grows. Allocates nothing in a warm step.
bool gpu_buffer_reserve(GpuBuffer *buffer, size_t bytes);

// Access from the host: waits for the queue, returns a pointer to the content (on a CPU device the very memory: zero copy).
// Every map is ended by an unmap before the next kernel uses the buffer.
typedef enum { GPU_READ = 1, GPU_WRITE = 2, GPU_READ_WRITE = 3 } GpuAccess; // GPU_WRITE: old content is not kept
bool gpu_buffer_map(GpuBuffer *buffer, GpuAccess access, void **pointer);

// Several at once, with one wait, which can take as long as a small kernel: those that are read last. On failure none is mapped.
typedef struct {
    GpuBuffer *buffer;
    GpuAccess access;
    void *pointer; // set
} GpuMap;
bool gpu_buffers_map(GpuMap *maps, int count);
bool gpu_buffer_unmap(GpuBuffer *buffer);

// Map, copy, unmap.
bool gpu_buffer_write(GpuBuffer *buffer, const void *data, size_t bytes);
bool gpu_buffer_read(GpuBuffer *buffer, void *data, size_t bytes);

// Enqueues setting all bytes (of what was asked for last) to zero.
bool gpu_buffer_zero(GpuBuffer *buffer);

// ---- launch ----
typedef struct {
    enum { GPU_ARG_BUFFER, GPU_ARG_INT, GPU_ARG_UINT, GPU_ARG_FLOAT, GPU_ARG_BYTES } kind;
    union {
        GpuBuffer *buffer;
        int i;
        unsigned u;
        float f;
        struct {
            const void *data;
            size_t bytes;
        } bytes; // a record by value
    } as;
} GpuArg;

static inline GpuArg gpu_buffer_arg(GpuBuffer *b) { return (GpuArg){.kind = GPU_ARG_BUFFER, .as.buffer = b}; }
static inline GpuArg gpu_int_arg(int i) { return (GpuArg){.kind = GPU_ARG_INT, .as.i = i}; }
static inline GpuArg gpu_uint_arg(unsigned u) { return (GpuArg){.kind = GPU_ARG_UINT, .as.u = u}; }
static inline GpuArg gpu_float_arg(float f) { return (GpuArg){.kind = GPU_ARG_FLOAT, .as.f = f}; }
static inline GpuArg gpu_record_arg(const void *data, size_t bytes) {
    return (GpuArg){.kind = GPU_ARG_BYTES, .as.bytes = {data, bytes}};
}

// How many work-items: 1-D with height 0, or 2-D. The global size is rounded up to whole groups, so kernels test their range;
// the local size is always given (PoCL compiles a kernel anew for each).
typedef struct {
    size_t width, height;             // work-items wanted
    size_t group_width, group_height; // work-items of one group
} GpuRange;

static inline GpuRange gpu_range(size_t width, size_t group_width) {
    return (GpuRange){.width = width, .group_width = group_width};
}
static inline GpuRange gpu_range_2d(size_t width, size_t height, size_t group_width, size_t group_height) {
    return (GpuRange){width, height, group_width, group_height};
}

// gpu_launch(kernel, gpu_range(n, 64), gpu_buffer_arg(a), gpu_int_arg(n)): sets the arguments and enqueues.
bool gpu_launch_args(GpuKernel *kernel, GpuRange range, const GpuArg *args, int count);
// The same with get_global_id(0) counted from `offset` on.
bool gpu_launch_args_from(GpuKernel *kernel, GpuRange range, size_t offset, const GpuArg *args, int count);
#define gpu_launch(kernel, range, ...)                                                                                 \
    gpu_launch_args(kernel, range, (const GpuArg[]){__VA_ARGS__},                                                      \
                    (int)(sizeof((const GpuArg[]){__VA_ARGS__}) / sizeof(GpuArg)))

bool gpu_flush(Gpu *gpu);  // lets the device begin with all commands; does not wait
bool gpu_finish(Gpu *gpu); // waits until all commands are done

// What was asked of the driver since the device was opened.
typedef struct {
    long builds;         // programs
    long allocations;    // of buffers' memory
    long launches;       // kernels enqueued
    long waits;          // maps and finishes: each empties the queue
    size_t copied_bytes; // by gpu_buffer_write() and gpu_buffer_read(); a map on a CPU device copies nothing
} GpuCounts;
GpuCounts gpu_counts(const Gpu *gpu);

// ---- time per stage ----
// What is launched, mapped and computed on the host from here on counts for this stage (a literal: "project"); NULL: none.
void gpu_stage(Gpu *gpu, const char *stage);

typedef struct {
    const char *stage;
    double device_ms; // time that kernels took on the device, by its own clock
    double host_ms; // time between gpu_stage() calls that the host spent working itself, e.g. sorting (gpu_stage_host)
} GpuStageTime;

// Adds host time to the current stage.
void gpu_stage_host(Gpu *gpu, double ms);

// Waits for the device, then gives the sums since the last call, stages in the order of their first use; valid until the next call.
bool gpu_stage_times(Gpu *gpu, const GpuStageTime **times, int *count);

#endif
