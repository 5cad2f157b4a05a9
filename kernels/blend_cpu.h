// blend_cpu.h - what the two CPU-shaped blend kernels share: sixteen pixels, a 4x4 block, in one float16.
//
//     lane of a pixel in its block          block of a tile: 4 * row + column, as in the masks
//       0  1  2  3
//       4  5  6  7                          Per-pixel state that outlives the kernel (T, last) is stored tile by tile,
//       8  9 10 11                          block by block, lane by lane: one vector each.
//      12 13 14 15
#ifndef SPLATLAB_KERNELS_BLEND_CPU_H
#define SPLATLAB_KERNELS_BLEND_CPU_H

#include "conditions.h"
#include "exp2_fast.h"

#define BLOCKS_PER_ROW  (TILE_SIZE / BLOCK_SIZE)
#define BLOCKS_PER_TILE (BLOCKS_PER_ROW * BLOCKS_PER_ROW)
#define LANE_X          ((float16)(0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3))
#define LANE_Y          ((float16)(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3))

// Index of the block's first pixel in a plane of the picture.
static inline size_t block_origin(int tile_x, int tile_y, int block, int stride) {
    const int x = tile_x * TILE_SIZE + block % BLOCKS_PER_ROW * BLOCK_SIZE;
    const int y = tile_y * TILE_SIZE + block / BLOCKS_PER_ROW * BLOCK_SIZE;
    return (size_t)y * stride + x;
}

// Coordinates of the sixteen pixel centres, px.
static inline float16 block_x(int tile_x, int block) {
    return LANE_X + (tile_x * TILE_SIZE + block % BLOCKS_PER_ROW * BLOCK_SIZE + 0.5f);
}

static inline float16 block_y(int tile_y, int block) {
    return LANE_Y + (tile_y * TILE_SIZE + block / BLOCKS_PER_ROW * BLOCK_SIZE + 0.5f);
}

static inline void block_store(__global float *plane, int stride, float16 value) {
    vstore4(value.s0123, 0, plane);
    vstore4(value.s4567, 0, plane + stride);
    vstore4(value.s89ab, 0, plane + 2 * stride);
    vstore4(value.scdef, 0, plane + 3 * stride);
}

static inline float16 block_load(__global const float *plane, int stride) {
    return (float16)(vload4(0, plane), vload4(0, plane + stride), vload4(0, plane + 2 * stride),
                     vload4(0, plane + 3 * stride));
}

#endif
