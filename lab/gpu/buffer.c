#include "lab/gpu/opencl.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

static bool buffer_fail_size(const GpuBuffer *buffer, size_t bytes, cl_int code) {
    const GpuInfo *info = &buffer->gpu->info;
    return fail(
        "cannot allocate %.1f MB for %s on %s: %s; the device has %.1f MB, at most %.1f MB in one buffer - fewer "
        "splats or smaller pictures need less",
        (double)bytes / 1e6, buffer->name, info->name, opencl_error_name(code), (double)info->memory_bytes / 1e6,
        (double)info->max_alloc_bytes / 1e6);
}

// Replaces the memory by a zeroed one of that capacity.
static bool buffer_allocate(GpuBuffer *buffer, size_t capacity) {
    cl_int code = CL_INVALID_BUFFER_SIZE;
    if (buffer->memory) clReleaseMemObject(buffer->memory);
    buffer->memory = NULL;
    buffer->capacity = buffer->bytes = 0;
    if (capacity <= buffer->gpu->info.max_alloc_bytes)
        buffer->memory = clCreateBuffer(buffer->gpu->context, CL_MEM_READ_WRITE, capacity, NULL, &code);
    buffer->gpu->counts.allocations++;
    if (code != CL_SUCCESS) return buffer_fail_size(buffer, capacity, code);
    buffer->capacity = buffer->bytes = capacity;
    return gpu_buffer_zero(buffer);
}

bool gpu_buffer_create(Gpu *gpu, const char *name, size_t bytes, GpuBuffer **buffer) {
    GpuBuffer *b = mem_alloc(1, sizeof *b);
    *buffer = NULL;
    b->gpu = gpu;
    snprintf(b->name, sizeof b->name, "%s", name);
    if (!bytes) bytes = 1; // OpenCL knows no empty buffer
    if (!buffer_allocate(b, bytes)) {
        gpu_buffer_destroy(b);
        return false;
    }
    *buffer = b;
    return true;
}

bool gpu_buffer_part(GpuBuffer *whole, const char *name, size_t offset, size_t bytes, GpuBuffer **part) {
    GpuBuffer *b = mem_alloc(1, sizeof *b);
    cl_int code;
    assert(!whole->mapped && offset % GPU_PART_STEP == 0 && bytes > 0 && offset + bytes <= whole->bytes);
    *part = NULL;
    b->gpu = whole->gpu;
    snprintf(b->name, sizeof b->name, "%s", name);
    b->memory = clCreateSubBuffer(whole->memory, CL_MEM_READ_WRITE, CL_BUFFER_CREATE_TYPE_REGION,
                                  &(cl_buffer_region){offset, bytes}, &code);
    b->bytes = b->capacity = bytes;
    if (opencl_ok(code, "clCreateSubBuffer", name, whole->gpu)) {
        *part = b;
        return true;
    }
    b->memory = NULL;
    gpu_buffer_destroy(b);
    return false;
}

void gpu_buffer_destroy(GpuBuffer *buffer) {
    if (!buffer) return;
    if (buffer->mapped) gpu_buffer_unmap(buffer);
    if (buffer->memory) clReleaseMemObject(buffer->memory);
    mem_free(buffer);
}

size_t gpu_buffer_bytes(const GpuBuffer *buffer) { return buffer->bytes; }

bool gpu_buffer_reserve(GpuBuffer *buffer, size_t bytes) {
    assert(!buffer->mapped);
    if (!bytes) bytes = 1;
    if (bytes > buffer->capacity) {
        size_t grown = buffer->capacity + buffer->capacity / 2;
        if (grown > buffer->gpu->info.max_alloc_bytes) grown = bytes;
        if (!buffer_allocate(buffer, bytes > grown ? bytes : grown)) return false;
    }
    buffer->bytes = bytes;
    return true;
}

static bool buffer_map(GpuBuffer *buffer, GpuAccess access, cl_bool waits, void **pointer) {
    static const cl_map_flags FLAGS[] = {
        [GPU_READ] = CL_MAP_READ,
        [GPU_WRITE] = CL_MAP_WRITE_INVALIDATE_REGION,
        [GPU_READ_WRITE] = CL_MAP_READ | CL_MAP_WRITE,
    };
    assert(!buffer->mapped);
    cl_int code;
    *pointer = clEnqueueMapBuffer(buffer->gpu->queue, buffer->memory, waits, FLAGS[access], 0, buffer->bytes, 0, NULL,
                                  NULL, &code);
    if (!opencl_ok(code, "clEnqueueMapBuffer", buffer->name, buffer->gpu)) return false;
    buffer->mapped = *pointer;
    return true;
}

bool gpu_buffer_map(GpuBuffer *buffer, GpuAccess access, void **pointer) {
    buffer->gpu->counts.waits++;
    if (!buffer_map(buffer, access, CL_TRUE, pointer)) return false;
    stage_collect(buffer->gpu); // the blocking map has emptied the queue
    return true;
}

// The queue is in order: when the last one is mapped, all are.
bool gpu_buffers_map(GpuMap *maps, int count) {
    for (int i = 0; i < count; i++) {
        if (buffer_map(maps[i].buffer, maps[i].access, i == count - 1, &maps[i].pointer)) continue;
        while (i > 0) gpu_buffer_unmap(maps[--i].buffer);
        return false;
    }
    Gpu *gpu = maps[0].buffer->gpu;
    gpu->counts.waits++;
    stage_collect(gpu);
    return true;
}

bool gpu_buffer_unmap(GpuBuffer *buffer) {
    assert(buffer->mapped);
    cl_int code = clEnqueueUnmapMemObject(buffer->gpu->queue, buffer->memory, buffer->mapped, 0, NULL, NULL);
    buffer->mapped = NULL;
    return opencl_ok(code, "clEnqueueUnmapMemObject", buffer->name, buffer->gpu);
}

bool gpu_buffer_write(GpuBuffer *buffer, const void *data, size_t bytes) {
    assert(bytes <= buffer->bytes);
    void *target;
    // A part only: the rest has to stay as it is.
    if (!gpu_buffer_map(buffer, bytes == buffer->bytes ? GPU_WRITE : GPU_READ_WRITE, &target)) return false;
    memcpy(target, data, bytes);
    buffer->gpu->counts.copied_bytes += bytes;
    return gpu_buffer_unmap(buffer);
}

bool gpu_buffer_read(GpuBuffer *buffer, void *data, size_t bytes) {
    assert(bytes <= buffer->bytes);
    void *source;
    if (!gpu_buffer_map(buffer, GPU_READ, &source)) return false;
    memcpy(data, source, bytes);
    buffer->gpu->counts.copied_bytes += bytes;
    return gpu_buffer_unmap(buffer);
}

bool gpu_buffer_zero(GpuBuffer *buffer) {
    assert(!buffer->mapped);
    static const cl_uint zero;
    size_t pattern = buffer->bytes % sizeof zero ? 1 : sizeof zero; // the size must be a multiple of the pattern's
    cl_int code =
        clEnqueueFillBuffer(buffer->gpu->queue, buffer->memory, &zero, pattern, 0, buffer->bytes, 0, NULL, NULL);
    return opencl_ok(code, "clEnqueueFillBuffer", buffer->name, buffer->gpu);
}
