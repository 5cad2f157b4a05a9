// opencl.h - what the files of this folder share: the device object, and the one check through which every OpenCL call goes.
#ifndef SPLATLAB_LAB_GPU_OPENCL_H
#define SPLATLAB_LAB_GPU_OPENCL_H

#include "lab/gpu/gpu.h"

#include <CL/cl.h>

enum {
    STAGES_MAX = 32,       // different stage names of one device
    STAGE_EVENTS_MAX = 256 // launches that are timed and not yet summed; a full ring waits for the device
};

// Time per stage: events of launches that are still under way, and the sums of those that are done.
typedef struct {
    GpuStageTime times[STAGES_MAX]; // running sums, in the order of first use
    GpuStageTime given[STAGES_MAX]; // what gpu_stage_times() handed out last
    int count;
    int current; // index of the stage that is on, -1: none
    cl_event events[STAGE_EVENTS_MAX];
    int event_stage[STAGE_EVENTS_MAX]; // index of the stage each event belongs to
    int event_count;
} Stages;

struct Gpu {
    GpuInfo info;
    cl_device_id device;
    cl_context context;
    cl_command_queue queue; // in order, with profiling
    bool said_compiling;    // the person has been told that kernels are being compiled
    Stages stages;
    GpuCounts counts;
};

struct GpuBuffer {
    Gpu *gpu;
    char name[64];
    cl_mem memory;
    size_t bytes, capacity; // asked for last; allocated
    void *mapped;           // host pointer between map and unmap, else NULL
};

struct GpuKernel {
    GpuProgram *program;
    char name[64];
    cl_kernel kernel;
    int arg_count;
    GpuKernel *next; // of the same program
};

struct GpuProgram {
    Gpu *gpu;
    char file[128];
    cl_program program;
    GpuKernel *kernels;
};

// True for CL_SUCCESS; else fails with "CALL failed for WHAT on DEVICE: CL_NAME (code)". device may be NULL.
bool opencl_ok(cl_int code, const char *call, const char *what, const Gpu *gpu);

// "CL_INVALID_VALUE"; "unknown error" for a number that OpenCL 1.2 does not define.
const char *opencl_error_name(cl_int code);

// Reads a kernel file with the files that it includes by #include "name" put in their place. The text carries #line marks, so that
// the compiler's messages name the true file and line. *text is owned by the caller.
bool kernel_source_read(const char *file, char **text);

// The binary of a program that was compiled before from the same text for the same device and driver; owned by the caller. False
// where there is none: nothing has failed. What cannot be saved is compiled again next time.
bool program_cache_load(const GpuProgram *program, const char *source, const char *options, unsigned char **binary,
                        size_t *bytes);
void program_cache_save(const GpuProgram *program, const char *source, const char *options);

// Says once that kernels are being compiled, if what began then has taken long enough for that.
void opencl_note_compiling(Gpu *gpu, double began_s);

// Runs known-answer kernels; fails with expected and actual value when the device computes wrongly.
bool self_test_run(Gpu *gpu);

// Where clEnqueueNDRangeKernel puts the event of the next launch; NULL when no stage is on.
cl_event *stage_next_event(Gpu *gpu);

// Adds the times of events that are done. Call it only when the queue is empty.
void stage_collect(Gpu *gpu);

#endif
