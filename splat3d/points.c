// points.c - memory of a point cloud.
#include "splat3d/points.h"

#include "lab/base/mem.h"

Points points_create(int count) {
    return (Points){.count = count,
                    .xyz = mem_alloc((size_t)count, 3 * sizeof(double)),
                    .rgb = mem_alloc((size_t)count, 3 * sizeof(uint8_t))};
}

void points_destroy(Points *points) {
    mem_free(points->xyz);
    mem_free(points->rgb);
    *points = (Points){0};
}
