#include "lab/gpu/opencl.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"

#include <assert.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { PLATFORMS_MAX = 16, DEVICES_MAX = 64 };

typedef struct {
    cl_device_id id;
    GpuInfo info;
    int order; // as the loader gave them: decides between equal names
} Device;

static bool device_describe(cl_platform_id platform, Device *device) {
    GpuInfo *info = &device->info;
    cl_device_type type = 0;
    cl_uint units = 0;
    cl_ulong memory = 0, max_alloc = 0;
    cl_device_fp_config fp64 = 0;
    cl_int codes[] = {
        clGetPlatformInfo(platform, CL_PLATFORM_NAME, sizeof info->platform, info->platform, NULL),
        clGetDeviceInfo(device->id, CL_DEVICE_NAME, sizeof info->name, info->name, NULL),
        clGetDeviceInfo(device->id, CL_DEVICE_VERSION, sizeof info->version, info->version, NULL),
        clGetDeviceInfo(device->id, CL_DEVICE_TYPE, sizeof type, &type, NULL),
        clGetDeviceInfo(device->id, CL_DEVICE_MAX_COMPUTE_UNITS, sizeof units, &units, NULL),
        clGetDeviceInfo(device->id, CL_DEVICE_GLOBAL_MEM_SIZE, sizeof memory, &memory, NULL),
        clGetDeviceInfo(device->id, CL_DEVICE_MAX_MEM_ALLOC_SIZE, sizeof max_alloc, &max_alloc, NULL),
    };
    for (size_t i = 0; i < sizeof codes / sizeof *codes; i++)
        if (!opencl_ok(codes[i], "clGetDeviceInfo", info->name[0] ? info->name : "a device", NULL)) return false;
    // A device without double precision may refuse this question: then it has none.
    if (clGetDeviceInfo(device->id, CL_DEVICE_DOUBLE_FP_CONFIG, sizeof fp64, &fp64, NULL) != CL_SUCCESS) fp64 = 0;
    info->is_cpu = (type & CL_DEVICE_TYPE_CPU) != 0;
    info->compute_units = (int)units;
    info->memory_bytes = (size_t)memory;
    info->max_alloc_bytes = (size_t)max_alloc;
    info->has_fp64 = fp64 != 0;
    return true;
}

static int device_compare(const void *left, const void *right) {
    const Device *a = left, *b = right;
    int by_platform = strcmp(a->info.platform, b->info.platform);
    if (by_platform) return by_platform;
    int by_name = strcmp(a->info.name, b->info.name);
    return by_name ? by_name : a->order - b->order;
}

// All devices, ordered by platform and name: the loader's own order follows the file system.
static bool device_find_all(Device devices[DEVICES_MAX], int *count) {
    cl_platform_id platforms[PLATFORMS_MAX];
    cl_uint platform_count = 0;
    *count = 0;
    cl_int code = clGetPlatformIDs(PLATFORMS_MAX, platforms, &platform_count);
    if (code == -1001) return true; // CL_PLATFORM_NOT_FOUND_KHR: the loader is there, no driver is
    if (!opencl_ok(code, "clGetPlatformIDs", "the list of platforms", NULL)) return false;
    for (cl_uint p = 0; p < platform_count && p < PLATFORMS_MAX; p++) {
        cl_device_id ids[DEVICES_MAX];
        cl_uint id_count = 0;
        code = clGetDeviceIDs(platforms[p], CL_DEVICE_TYPE_ALL, DEVICES_MAX, ids, &id_count);
        if (code == CL_DEVICE_NOT_FOUND) continue;
        if (!opencl_ok(code, "clGetDeviceIDs", "the devices of a platform", NULL)) return false;
        for (cl_uint d = 0; d < id_count && d < DEVICES_MAX && *count < DEVICES_MAX; d++) {
            Device *device = &devices[*count];
            *device = (Device){.id = ids[d], .order = *count};
            if (!device_describe(platforms[p], device)) return false;
            ++*count;
        }
    }
    qsort(devices, (size_t)*count, sizeof *devices, device_compare);
    return true;
}

bool gpu_list(GpuInfo **infos, int *count) {
    Device devices[DEVICES_MAX];
    *infos = NULL;
    if (!device_find_all(devices, count)) return false;
    *infos = mem_alloc((size_t)*count, sizeof **infos);
    for (int i = 0; i < *count; i++) (*infos)[i] = devices[i].info;
    return true;
}

// Index of the device with the most compute units among those of that kind, -1 when there is none.
static int device_best(const Device *devices, int count, bool is_cpu) {
    int best = -1;
    for (int i = 0; i < count; i++)
        if (devices[i].info.is_cpu == is_cpu &&
            (best < 0 || devices[i].info.compute_units > devices[best].info.compute_units))
            best = i;
    return best;
}

// Index of the device that `spec` means, -1 when there is none.
static int device_choose(const Device *devices, int count, const char *spec) {
    if (!strcasecmp(spec, "cpu")) return device_best(devices, count, true);
    if (!strcasecmp(spec, "gpu")) return device_best(devices, count, false);
    if (!spec[0] || !strcasecmp(spec, "auto")) {
        int gpu = device_best(devices, count, false);
        return gpu >= 0 ? gpu : device_best(devices, count, true);
    }
    char *end;
    errno = 0;
    long number = strtol(spec, &end, 10);
    if (!*end) return errno == 0 && number >= 0 && number < count ? (int)number : -1;
    for (int i = 0; i < count; i++)
        if (strcasestr(devices[i].info.name, spec)) return i;
    return -1;
}

static bool device_fail_choice(const Device *devices, int count, const char *spec) {
    char list[2048] = "";
    for (int i = 0; i < count; i++) {
        size_t length = strlen(list);
        snprintf(list + length, sizeof list - length, "%s%d: %s (%s)", i ? "; " : "", i, devices[i].info.name,
                 devices[i].info.is_cpu ? "cpu" : "gpu");
    }
    return fail_usage("no OpenCL device matches '%s'; there is %s - give a number, a part of a name, cpu, gpu or auto",
                      spec, list);
}

static bool device_connect(Gpu *gpu) {
    cl_int code;
    gpu->context = clCreateContext(NULL, 1, &gpu->device, NULL, NULL, &code);
    if (!opencl_ok(code, "clCreateContext", "the context", gpu)) return false;
    gpu->queue = clCreateCommandQueue(gpu->context, gpu->device, CL_QUEUE_PROFILING_ENABLE, &code);
    return opencl_ok(code, "clCreateCommandQueue", "the queue", gpu);
}

// Once in the life of the process for each device.
static bool device_test_once(Gpu *gpu) {
    static cl_device_id tested[DEVICES_MAX];
    static int tested_count;
    for (int i = 0; i < tested_count; i++)
        if (tested[i] == gpu->device) return true;
    if (!self_test_run(gpu)) return fail_context("self-test of OpenCL device %s", gpu->info.name);
    if (tested_count < DEVICES_MAX) tested[tested_count++] = gpu->device;
    return true;
}

bool gpu_open(const char *spec, Gpu **gpu) {
    Device devices[DEVICES_MAX];
    int count;
    *gpu = NULL;
    if (!device_find_all(devices, &count)) return false;
    if (!count)
        return fail("no OpenCL device found; on Debian, apt install ocl-icd-libopencl1 pocl-opencl-icd for the CPU, "
                    "or the ICD package of your GPU's maker (nvidia-opencl-icd, mesa-opencl-icd, intel-opencl-icd)");
    int chosen = device_choose(devices, count, spec);
    if (chosen < 0) return device_fail_choice(devices, count, spec);
    *gpu = mem_alloc(1, sizeof **gpu);
    (*gpu)->info = devices[chosen].info;
    (*gpu)->device = devices[chosen].id;
    (*gpu)->stages.current = -1;
    if (device_connect(*gpu) && device_test_once(*gpu)) return true;
    gpu_close(*gpu);
    *gpu = NULL;
    return false;
}

void gpu_close(Gpu *gpu) {
    if (!gpu) return;
    if (gpu->queue) {
        clFinish(gpu->queue);
        stage_collect(gpu);
        clReleaseCommandQueue(gpu->queue);
    }
    if (gpu->context) clReleaseContext(gpu->context);
    mem_free(gpu);
}

const GpuInfo *gpu_info(const Gpu *gpu) {
    assert(gpu);
    return &gpu->info;
}
