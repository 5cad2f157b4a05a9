#include "lab/gpu/opencl.h"

#include "lab/base/clock.h"
#include "lab/base/fail.h"

#include <assert.h>
#include <stdio.h>

static bool launch_set_arg(GpuKernel *kernel, int index, const GpuArg *arg) {
    const void *value = NULL;
    size_t size = 0;
    switch (arg->kind) {
    case GPU_ARG_BUFFER:
        assert(arg->as.buffer && !arg->as.buffer->mapped);
        value = &arg->as.buffer->memory;
        size = sizeof arg->as.buffer->memory;
        break;
    case GPU_ARG_INT:
    case GPU_ARG_UINT:
    case GPU_ARG_FLOAT:
        value = &arg->as;
        size = 4;
        break;
    case GPU_ARG_BYTES:
        value = arg->as.bytes.data;
        size = arg->as.bytes.bytes;
        break;
    }
    cl_int code = clSetKernelArg(kernel->kernel, (cl_uint)index, size, value);
    if (code == CL_SUCCESS) return true;
    char what[128];
    snprintf(what, sizeof what, "argument %d (%zu bytes) of kernel %s", index, size, kernel->name);
    return opencl_ok(code, "clSetKernelArg", what, kernel->program->gpu);
}

static size_t round_up(size_t n, size_t multiple) { return (n + multiple - 1) / multiple * multiple; }

bool gpu_launch_args(GpuKernel *kernel, GpuRange range, const GpuArg *args, int count) {
    return gpu_launch_args_from(kernel, range, 0, args, count);
}

bool gpu_launch_args_from(GpuKernel *kernel, GpuRange range, size_t offset, const GpuArg *args, int count) {
    Gpu *gpu = kernel->program->gpu;
    assert(range.group_width > 0 && (range.height == 0 || range.group_height > 0));
    if (count != kernel->arg_count)
        return fail("kernel %s of %s takes %d arguments, the program gives %d; do program and kernel folder belong "
                    "together?",
                    kernel->name, kernel->program->file, kernel->arg_count, count);
    for (int i = 0; i < count; i++)
        if (!launch_set_arg(kernel, i, &args[i])) return false;
    cl_uint dimensions = range.height ? 2 : 1;
    size_t local[2] = {range.group_width, range.group_height};
    size_t global[2] = {round_up(range.width, local[0]), range.height ? round_up(range.height, local[1]) : 0};
    const size_t first[2] = {offset, 0};
    if (!global[0]) return true; // nothing to do
    gpu->counts.launches++;
    cl_event *event = stage_next_event(gpu);
    const double began_s = clock_seconds();
    cl_int code = clEnqueueNDRangeKernel(gpu->queue, kernel->kernel, dimensions, offset ? first : NULL, global, local,
                                         0, NULL, event);
    opencl_note_compiling(gpu, began_s); // PoCL compiles a kernel's loops over work-items here
    return opencl_ok(code, "clEnqueueNDRangeKernel", kernel->name, gpu);
}

GpuCounts gpu_counts(const Gpu *gpu) { return gpu->counts; }

bool gpu_flush(Gpu *gpu) { return opencl_ok(clFlush(gpu->queue), "clFlush", "the queue", gpu); }

bool gpu_finish(Gpu *gpu) {
    gpu->counts.waits++;
    if (!opencl_ok(clFinish(gpu->queue), "clFinish", "the queue", gpu)) return false;
    stage_collect(gpu);
    return true;
}
