#include "lab/gpu/opencl.h"

#include "lab/base/clock.h"
#include "lab/base/fail.h"
#include "lab/base/log.h"
#include "lab/base/mem.h"

#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

// A build, or a first launch, that the driver finds in its cache takes a sixth of it, a first one thrice as long.
static const double SLOW_BUILD_S = 0.15;
enum { LOG_BYTES = 1500 }; // of a compiler's log that a message can take

// The log from its first error on, cut to what one message can hold.
static bool program_fail_build(const GpuProgram *program, cl_int code) {
    size_t size = 0;
    clGetProgramBuildInfo(program->program, program->gpu->device, CL_PROGRAM_BUILD_LOG, 0, NULL, &size);
    char *log = mem_alloc(size + 1, 1);
    clGetProgramBuildInfo(program->program, program->gpu->device, CL_PROGRAM_BUILD_LOG, size, log, NULL);
    char *from = strstr(log, "error:");
    while (from && from > log && from[-1] != '\n') from--;
    if (!from) from = log;
    size_t length = strlen(from);
    if (length > LOG_BYTES) length = LOG_BYTES;
    while (length && (from[length - 1] == '\n' || from[length - 1] == ' ')) length--;
    fail("cannot compile %s on %s (%s):\n%.*s", program->file, program->gpu->info.name, opencl_error_name(code),
         (int)length, length ? from : "the compiler gives no log");
    mem_free(log);
    return false;
}

// The compiler inside PoCL counts its errors on stderr ("1 error generated."); what they are stands in the build log.
static cl_int build_quietly(cl_program program, cl_device_id device, const char *options) {
    fflush(stderr);
    int kept = dup(STDERR_FILENO), nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    bool silenced = kept >= 0 && nowhere >= 0 && dup2(nowhere, STDERR_FILENO) >= 0;
    cl_int code = clBuildProgram(program, 1, &device, options, NULL, NULL);
    if (silenced) dup2(kept, STDERR_FILENO);
    if (kept >= 0) close(kept);
    if (nowhere >= 0) close(nowhere);
    return code;
}

void opencl_note_compiling(Gpu *gpu, double began_s) {
    if (gpu->said_compiling || clock_seconds() - began_s <= SLOW_BUILD_S) return;
    log_info("compiling kernels for %s (they are kept for the next run)", gpu->info.name);
    gpu->said_compiling = true;
}

static bool build_from_cache(GpuProgram *program, const char *source, const char *options) {
    const Gpu *gpu = program->gpu;
    unsigned char *binary;
    size_t bytes;
    cl_int status, code;
    if (!program_cache_load(program, source, options, &binary, &bytes)) return false;
    program->program = clCreateProgramWithBinary(gpu->context, 1, &gpu->device, &bytes, (const unsigned char **)&binary,
                                                 &status, &code);
    mem_free(binary);
    if (code == CL_SUCCESS && build_quietly(program->program, gpu->device, options) == CL_SUCCESS) return true;
    if (program->program) clReleaseProgram(program->program);
    program->program = NULL;
    return false;
}

static bool program_build(GpuProgram *program, const char *source, const char *options) {
    Gpu *gpu = program->gpu;
    cl_int code;
    gpu->counts.builds++;
    if (build_from_cache(program, source, options)) return true;
    program->program = clCreateProgramWithSource(gpu->context, 1, &source, NULL, &code);
    if (!opencl_ok(code, "clCreateProgramWithSource", program->file, gpu)) return false;
    double began_s = clock_seconds();
    code = build_quietly(program->program, gpu->device, options);
    if (code != CL_SUCCESS) return program_fail_build(program, code);
    opencl_note_compiling(gpu, began_s);
    program_cache_save(program, source, options);
    return true;
}

bool gpu_program_create(Gpu *gpu, const char *file, const char *options, GpuProgram **program) {
    char *source;
    *program = NULL;
    if (!kernel_source_read(file, &source)) return false;
    GpuProgram *p = mem_alloc(1, sizeof *p);
    p->gpu = gpu;
    snprintf(p->file, sizeof p->file, "%s", file);
    bool built = program_build(p, source, options);
    mem_free(source);
    if (!built) {
        gpu_program_destroy(p);
        return false;
    }
    *program = p;
    return true;
}

void gpu_program_destroy(GpuProgram *program) {
    if (!program) return;
    while (program->kernels) {
        GpuKernel *kernel = program->kernels;
        program->kernels = kernel->next;
        if (kernel->kernel) clReleaseKernel(kernel->kernel);
        mem_free(kernel);
    }
    if (program->program) clReleaseProgram(program->program);
    mem_free(program);
}

bool gpu_kernel(GpuProgram *program, const char *name, GpuKernel **kernel) {
    *kernel = NULL;
    cl_int code;
    cl_kernel made = clCreateKernel(program->program, name, &code);
    if (code == CL_INVALID_KERNEL_NAME)
        return fail("%s has no kernel named %s; does the kernel folder belong to this program?", program->file, name);
    if (!opencl_ok(code, "clCreateKernel", name, program->gpu)) return false;
    GpuKernel *k = mem_alloc(1, sizeof *k);
    k->program = program;
    snprintf(k->name, sizeof k->name, "%s", name);
    k->kernel = made;
    k->next = program->kernels;
    program->kernels = k;
    cl_uint arg_count = 0;
    code = clGetKernelInfo(made, CL_KERNEL_NUM_ARGS, sizeof arg_count, &arg_count, NULL);
    if (!opencl_ok(code, "clGetKernelInfo", name, program->gpu)) return false;
    k->arg_count = (int)arg_count;
    *kernel = k;
    return true;
}

int gpu_kernel_parameters(const GpuKernel *kernel) { return kernel->arg_count; }

bool gpu_kernel_parameter(const GpuKernel *kernel, int index, GpuParameter *parameter) {
    const Gpu *gpu = kernel->program->gpu;
    cl_kernel_arg_address_qualifier where = 0;
    cl_uint i = (cl_uint)index;
    *parameter = (GpuParameter){0};
    cl_int code = clGetKernelArgInfo(kernel->kernel, i, CL_KERNEL_ARG_ADDRESS_QUALIFIER, sizeof where, &where, NULL);
    if (code == CL_SUCCESS)
        code = clGetKernelArgInfo(kernel->kernel, i, CL_KERNEL_ARG_TYPE_NAME, sizeof parameter->type - 1,
                                  parameter->type, NULL);
    if (!opencl_ok(code, "clGetKernelArgInfo", kernel->name, gpu)) return false;
    parameter->type[strcspn(parameter->type, "*")] = 0;
    parameter->is_local = where == CL_KERNEL_ARG_ADDRESS_LOCAL;
    parameter->is_buffer = where == CL_KERNEL_ARG_ADDRESS_GLOBAL || where == CL_KERNEL_ARG_ADDRESS_CONSTANT;
    return true;
}
