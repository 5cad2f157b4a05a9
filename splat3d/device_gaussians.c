#include "splat3d/device_gaussians.h"

#include <assert.h>
#include <stdio.h>

#include "kernels/shared.h"
#include "lab/base/parallel.h"

static int group_count(int splats) { return (splats + SPLAT_GROUP - 1) / SPLAT_GROUP; }

// Whole groups of splats; what lies behind the last splat means nothing.
static size_t room_bytes(int id, int count) {
    return (size_t)group_count(count) * SPLAT_GROUP * (size_t)GAUSSIAN_FIELDS[id].width * sizeof(float);
}

bool device_gaussians_create(Gpu *gpu, const char *what, int count, int sh_degree, DeviceGaussians *g) {
    *g = (DeviceGaussians){.count = count, .sh_degree = sh_degree};
    for (int id = 0; id < FIELD_COUNT; id++) {
        if (GAUSSIAN_FIELDS[id].sh_degree > sh_degree) continue;
        char name[64];
        snprintf(name, sizeof name, "%s %s", what, GAUSSIAN_FIELDS[id].name);
        if (!gpu_buffer_create(gpu, name, room_bytes(id, count), &g->field[id])) {
            device_gaussians_destroy(g);
            return false;
        }
    }
    return true;
}

void device_gaussians_destroy(DeviceGaussians *g) {
    for (int id = 0; id < FIELD_COUNT; id++) gpu_buffer_destroy(g->field[id]);
    *g = (DeviceGaussians){0};
}

bool device_gaussians_resize(DeviceGaussians *g, int count) {
    for (int id = 0; id < FIELD_COUNT; id++)
        if (g->field[id] && !gpu_buffer_reserve(g->field[id], room_bytes(id, count))) return false;
    g->count = count;
    return true;
}

// One field on its way between the host's order, splat by splat, and the device's, group by group.
typedef struct {
    int splats, width;
    float *host, *device; // one is read, the other written
} Move;

enum { GROUPS_AT_ONCE = 1024 }; // of one thread

static void to_device(void *context, int slab) {
    const Move *move = context;
    const int width = move->width, end = group_count(move->splats);
    for (int group = slab * GROUPS_AT_ONCE; group < end && group < (slab + 1) * GROUPS_AT_ONCE; group++) {
        const int first = group * SPLAT_GROUP,
                  splats = move->splats - first < SPLAT_GROUP ? move->splats - first : SPLAT_GROUP;
        const float *host = move->host + (size_t)first * (size_t)width;
        float *device = move->device + (size_t)first * (size_t)width;
        for (int k = 0; k < width; k++)
            for (int i = 0; i < SPLAT_GROUP; i++) *device++ = i < splats ? host[i * width + k] : 0;
    }
}

static void to_host(void *context, int slab) {
    const Move *move = context;
    const int width = move->width, end = group_count(move->splats);
    for (int group = slab * GROUPS_AT_ONCE; group < end && group < (slab + 1) * GROUPS_AT_ONCE; group++) {
        const int first = group * SPLAT_GROUP,
                  splats = move->splats - first < SPLAT_GROUP ? move->splats - first : SPLAT_GROUP;
        const float *device = move->device + (size_t)first * (size_t)width;
        float *host = move->host + (size_t)first * (size_t)width;
        for (int i = 0; i < splats; i++)
            for (int k = 0; k < width; k++) *host++ = device[k * SPLAT_GROUP + i];
    }
}

static bool move_field(const DeviceGaussians *g, int id, float *host, GpuAccess access, ParallelBody *body) {
    Move move = {.splats = g->count, .width = GAUSSIAN_FIELDS[id].width, .host = host};
    void *mapped;
    if (!gpu_buffer_map(g->field[id], access, &mapped)) return false;
    move.device = mapped;
    parallel_for((group_count(g->count) + GROUPS_AT_ONCE - 1) / GROUPS_AT_ONCE, body, &move);
    return gpu_buffer_unmap(g->field[id]);
}

bool device_gaussians_write(DeviceGaussians *g, const Gaussians *host) {
    assert(g->sh_degree == host->sh_degree);
    if (!device_gaussians_resize(g, host->count)) return false;
    if (!host->count) return true;
    for (int id = 0; id < FIELD_COUNT; id++)
        if (g->field[id] && !move_field(g, id, host->field[id], GPU_WRITE, to_device)) return false;
    return true;
}

bool device_gaussians_read(const DeviceGaussians *g, Gaussians *host) {
    *host = gaussians_create(g->count, g->sh_degree);
    if (!g->count) return true;
    for (int id = 0; id < FIELD_COUNT; id++)
        if (g->field[id] && !move_field(g, id, host->field[id], GPU_READ, to_host)) {
            gaussians_destroy(host);
            return false;
        }
    return true;
}
