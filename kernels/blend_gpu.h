// blend_gpu.h - what the two GPU-shaped blend kernels share: a group of 16x16 work-items for a tile, one pixel each.
//
// T and last of a pixel are stored as the CPU-shaped kernels store them (blend_cpu.h): tile by tile, block by block, so that the
// two shapes can be mixed.
#ifndef SPLATLAB_KERNELS_BLEND_GPU_H
#define SPLATLAB_KERNELS_BLEND_GPU_H

#include "exp2_fast.h"

#define TILE_PIXELS (TILE_SIZE * TILE_SIZE)

// 4x4 block of a pixel of the tile, 0..15, as in the masks.
static inline int pixel_block(int x, int y) { return y / BLOCK_SIZE * (TILE_SIZE / BLOCK_SIZE) + x / BLOCK_SIZE; }

// Place of the pixel in the tile's 256 stored states.
static inline int pixel_place(int x, int y) {
    return pixel_block(x, y) * BLOCK_SIZE * BLOCK_SIZE + y % BLOCK_SIZE * BLOCK_SIZE + x % BLOCK_SIZE;
}

#endif
