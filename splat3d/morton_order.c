#include "splat3d/morton_order.h"

#include "lab/base/mem.h"
#include "splat3d/radix_sort.h"

#include <math.h>
#include <stddef.h>

enum { CELL_BITS = 21 }; // an axis: three of them fit into 64 bits

// The cube round all points: its lowest corner, and cells per unit of length.
typedef struct {
    double corner[3], cells;
} Cube;

static Cube enclose(int count, const float *xyz) {
    Cube cube = {{0}, 0};
    double extent = 0;
    for (int a = 0; a < 3; a++) {
        double low = INFINITY, high = -INFINITY;
        for (int i = 0; i < count; i++) {
            low = fmin(low, xyz[3 * (size_t)i + a]);
            high = fmax(high, xyz[3 * (size_t)i + a]);
        }
        cube.corner[a] = low;
        extent = fmax(extent, high - low);
    }
    cube.cells = extent > 0 ? ((1 << CELL_BITS) - 1) / extent : 0;
    return cube;
}

// Two zeros before each of the 21 bits.
static uint64_t spread_bits(uint64_t bits) {
    bits = (bits | bits << 32) & 0x001f00000000ffff;
    bits = (bits | bits << 16) & 0x001f0000ff0000ff;
    bits = (bits | bits << 8) & 0x100f00f00f00f00f;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
    return (bits | bits << 2) & 0x1249249249249249;
}

static uint64_t morton_code(const Cube *cube, const float *point) {
    uint64_t code = 0;
    for (int a = 0; a < 3; a++) code |= spread_bits((uint64_t)((point[a] - cube->corner[a]) * cube->cells)) << a;
    return code;
}

void morton_order(int count, const float *xyz, uint32_t *order) {
    const Cube cube = enclose(count, xyz);
    uint64_t *code = mem_alloc((size_t)count, sizeof *code);
    uint64_t *keys = mem_alloc((size_t)count, sizeof *keys), *scratch = mem_alloc((size_t)count, sizeof *scratch);
    for (int i = 0; i < count; i++) {
        code[i] = morton_code(&cube, xyz + 3 * (size_t)i);
        order[i] = (uint32_t)i;
    }
    for (int half = 0; half < 2; half++) { // the lower one first: a stable sort by each orders by both
        for (int rank = 0; rank < count; rank++)
            keys[rank] = radix_key((uint32_t)(code[order[rank]] >> 32 * half), order[rank]);
        radix_sort(count, keys, scratch, order);
    }
    mem_free(code);
    mem_free(keys);
    mem_free(scratch);
}

void morton_arrange(Gaussians *g) {
    uint32_t *order = mem_alloc((size_t)g->count, sizeof *order);
    morton_order(g->count, g->field[FIELD_MEAN], order);
    gaussians_gather(g, g->count, order);
    mem_free(order);
}
