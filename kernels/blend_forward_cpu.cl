// blend_forward_cpu.cl - front-to-back blending of each tile's list, for devices that are CPUs.
//
//     C = sum_i T_i alpha_i c_i + T_end background,   T_i = prod_{j<i} (1 - alpha_j)      (Kerbl et al. 2023, eq. 3)
//     alpha_i = min(alpha_max, 2^(along_u u^2 + along_v dy^2 + log2_opacity)), skipped below ALPHA_MIN
// A splat is blended while T >= TRANSMITTANCE_STOP before it.
//
// A CPU's compiler does not vectorise a work-item that loops over splats, so the vector is written here: one work-item takes a
// whole tile, sixteen pixels of a 4x4 block at a time. Per batch of 128 splats the list's masks (16 bits, one a block) are transposed
// into one bit string per block; a block then walks its own bits, most significant first, with T and colour in registers:
//
//       list:  splat 0 1 2 3 ...                    block 0:  1 0 0 1 ...   -> splats 0, 3
//       mask of splat 0 = bits of blocks 0..15      block 1:  1 1 0 0 ...   -> splats 0, 1
// About 17 times faster on PoCL than one work-item per pixel (blend_forward_gpu.cl gives the same picture).
//
//     start (tiles + 1), list_splat, list_mask (pairs): from tile_sort.cl      screen (N): from project_forward.cl
//     rgb (3, rows, stride): the picture
//     transmittance (tiles, 16, 16): T_end of each pixel          last (tiles, 16, 16): 1 + index in the tile's list of the last
//                                                                 splat that was blended, 0 for none
// One work-item: one tile (group 1 x 1). Local memory: none; about 11 KB of private arrays.
// Reference: splat3d/reference_blend.c. Test: tests/splat3d/test_opencl_rasterizer.c.
#include "shared.h"

#include "blend_cpu.h"

#define WORDS 4 // of 32 splats: one batch

// Bit strings of each block for 32 list entries, the first one in the most significant bit.
static void transpose_masks(__global const ushort *mask, int count, uint *words) {
    uint16 bits = (uint16)(0);
    const uint16 shift = (uint16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    for (int i = 0; i < 32; i++) {
        const uint entry = i < count ? mask[i] : 0;
        bits = bits << 1 | ((uint16)(entry) >> shift & 1u);
    }
    vstore16(bits, 0, words);
}

// What is known of the sixteen pixels of one block on their way from front to back.
typedef struct {
    float16 t, r, g, b;
    int16 last;
} BlockState;

// Blends the splats of one batch that reach this block, until its pixels are opaque. words: the block's bits, BLOCKS_PER_TILE apart; first: index of staged[0]
// in the tile's list; x, y: pixel centres.
static void blend_block(const float alpha_max, const uint *words, const ScreenSplat *staged, int first, float16 x,
                        float16 y, BlockState *state) {
    float16 t = state->t, r = state->r, g = state->g, b = state->b;
    int16 last = state->last;
    for (int word = 0; word < WORDS && any_of(t >= TRANSMITTANCE_STOP); word++) {
        uint bits = words[BLOCKS_PER_TILE * word];
        while (bits) {
            const int i = 32 * word + (int)clz(bits);
            bits ^= 0x80000000u >> (i & 31);
            const ScreenSplat *splat = &staged[i];
            const float16 dy = y - splat->y;
            const float16 u = fma((float16)(splat->shear), dy, x - splat->x);
            const float16 power =
                fma(splat->along_u * u, u, fma(splat->along_v * dy, dy, (float16)(splat->log2_opacity)));
            const int16 reached = power >= LOG2_ALPHA_MIN;
            float16 alpha = reached ? exp2_fast16(power) : (float16)(0);
            alpha = alpha < alpha_max ? alpha : (float16)(alpha_max);
            const int16 blended = reached && t >= TRANSMITTANCE_STOP;
            const float16 weight = blended ? alpha * t : (float16)(0);
            r = fma(weight, (float16)(splat->r), r);
            g = fma(weight, (float16)(splat->g), g);
            b = fma(weight, (float16)(splat->b), b);
            t = blended ? fma(-alpha, t, t) : t;
            last = blended ? (int16)(first + i + 1) : last;
        }
    }
    state->t = t, state->r = r, state->g = g, state->b = b;
    state->last = last;
}

static void store_tile(__private const FrameRecord *frame, int tile_x, int tile_y, const BlockState *states,
                       __global float *rgb, __global float *transmittance, __global int *last) {
    const size_t plane = (size_t)frame->rows * frame->stride;
    const size_t tile = (size_t)tile_y * frame->tiles_x + tile_x;
    for (int block = 0; block < BLOCKS_PER_TILE; block++) {
        const BlockState *state = &states[block];
        __global float *pixel = rgb + block_origin(tile_x, tile_y, block, frame->stride);
        block_store(pixel, frame->stride, fma(state->t, (float16)(frame->background[0]), state->r));
        block_store(pixel + plane, frame->stride, fma(state->t, (float16)(frame->background[1]), state->g));
        block_store(pixel + 2 * plane, frame->stride, fma(state->t, (float16)(frame->background[2]), state->b));
        vstore16(state->t, tile * BLOCKS_PER_TILE + block, transmittance);
        vstore16(state->last, tile * BLOCKS_PER_TILE + block, last);
    }
}

__kernel void blend_forward_cpu(const FrameRecord frame, __global const uint *start, __global const uint *list_splat,
                                __global const ushort *list_mask, __global const ScreenSplat *screen,
                                __global float *rgb, __global float *transmittance, __global int *last) {
    const int tile_x = (int)get_global_id(0), tile_y = (int)get_global_id(1);
    if (tile_x >= frame.tiles_x || tile_y >= frame.tiles_y) return;
    const uint begin = start[tile_y * frame.tiles_x + tile_x];
    const int count = (int)(start[tile_y * frame.tiles_x + tile_x + 1] - begin);

    ScreenSplat staged[32 * WORDS];
    uint words[WORDS * BLOCKS_PER_TILE];
    BlockState states[BLOCKS_PER_TILE];
    for (int block = 0; block < BLOCKS_PER_TILE; block++) {
        states[block].t = (float16)(1);
        states[block].r = states[block].g = states[block].b = (float16)(0);
        states[block].last = (int16)(0);
    }

    uint opaque = 0; // bit per block
    for (int first = 0; first < count && opaque != 0xffff; first += 32 * WORDS) {
        const int batch = min(count - first, 32 * WORDS);
        for (int i = 0; i < batch; i++) staged[i] = screen[list_splat[begin + first + i]];
        for (int word = 0; word < WORDS; word++)
            transpose_masks(list_mask + begin + first + 32 * word, batch - 32 * word, words + BLOCKS_PER_TILE * word);
        for (int block = 0; block < BLOCKS_PER_TILE; block++) {
            if (opaque >> block & 1) continue;
            blend_block(frame.alpha_max, words + block, staged, first, block_x(tile_x, block), block_y(tile_y, block),
                        &states[block]);
            if (!any_of(states[block].t >= TRANSMITTANCE_STOP)) opaque |= 1u << block;
        }
    }
    store_tile(&frame, tile_x, tile_y, states, rgb, transmittance, last);
}
