#include "splat3d/device_gaussians.h"

#include <assert.h>
#include <stdio.h>

enum { LANES_MAX = 16 }; // splats that one work-item of a kernel takes (kernels/splat_lanes.h)

static size_t field_bytes(int id, int count) {
    return (size_t)count * (size_t)GAUSSIAN_FIELDS[id].width * sizeof(float);
}

// Kernels read and write whole groups of splats, and vectors that begin in the last one: room for both. What lies there means nothing.
static size_t room_bytes(int id, int count) {
    const int whole_groups = (count + LANES_MAX - 1) / LANES_MAX * LANES_MAX;
    return field_bytes(id, whole_groups) + LANES_MAX * sizeof(float);
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

bool device_gaussians_write(DeviceGaussians *g, const Gaussians *host) {
    assert(g->sh_degree == host->sh_degree);
    if (!device_gaussians_resize(g, host->count)) return false;
    if (!host->count) return true;
    for (int id = 0; id < FIELD_COUNT; id++)
        if (g->field[id] && !gpu_buffer_write(g->field[id], host->field[id], field_bytes(id, host->count)))
            return false;
    return true;
}

bool device_gaussians_read(const DeviceGaussians *g, Gaussians *host) {
    *host = gaussians_create(g->count, g->sh_degree);
    if (!g->count) return true;
    for (int id = 0; id < FIELD_COUNT; id++)
        if (g->field[id] && !gpu_buffer_read(g->field[id], host->field[id], field_bytes(id, g->count))) {
            gaussians_destroy(host);
            return false;
        }
    return true;
}
