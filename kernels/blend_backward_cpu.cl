// blend_backward_cpu.cl - the gradient of blend_forward_cpu.cl, back to front, for devices that are CPUs.
//
// With g = d loss / d C of a pixel, w_i = T_i alpha_i, and B_i = sum_{j>i} w_j (c_j . g) + T_end (background . g), the light
// that comes from behind splat i:
//     d loss / d c_i = w_i g            d loss / d alpha_i = T_i (c_i . g) - B_i / (1 - alpha_i)
// (the derivative of Kerbl et al. 2023, eq. 3, and of the background's term). T_i is recovered by division on the way to the front, which keeps small
// gradients of deep splats exact; subtracting a running sum from the total, front to back, does not.
// Where alpha is clamped to alpha_max its gradient is zero.
//
// One record of nine sums per list entry, in terms of ln alpha and of the coordinates u, v = dy in which the ellipse is a
// circle up to scale (PairGradient in shared.h); project_backward.cl turns them into everything else. A record is written by one
// work-item to its own place: no atomics, so the sums do not depend on the order in which tiles are done.
//
//     start (tiles + 1), list_splat, list_slot, list_mask (pairs), screen (N), transmittance, last (tiles, 16, 16): of the forward pass
//     d_rgb (3, rows, stride): d loss / d picture, zero in the padding
//     records (P): at list_slot of each entry that has a block in which it is not behind the last blended splat
//     mask_of_slot (P): of tile_masks.cl; set to 0, "there is no record", for the other entries
//
// One work-item: one tile (group 1 x 1), splats outside, blocks of their mask inside, the nine sums in registers.
// Local memory: none; about 6 KB of private arrays. Reference: splat3d/reference_blend.c. Test: tests/splat3d/test_opencl_gradients.c.
#include "shared.h"

#include "blend_cpu.h"
#include "prefetch.h"

#define ENTRIES_AHEAD 4 // of the list: what is asked of memory before it is needed

// The sixteen pixels of one block on their way from back to front.
typedef struct {
    float16 t;      // transmittance in front of everything done so far
    float16 behind; // B: light from behind, times g
    float16 g_red, g_green, g_blue;
    int16 last;
} BlockState;

typedef struct {
    float16 w, wu, wv, wuu, wuv, wvv, r, g, b;
} PairSums;

static float sum16(float16 v) {
    const float8 a = v.lo + v.hi;
    const float4 b = a.lo + a.hi;
    const float2 c = b.lo + b.hi;
    return c.x + c.y;
}

// The sums of four vectors' lanes, still spread over four lanes each.
static float16 sums_of_four(float16 a, float16 b, float16 c, float16 d) {
    const float16 ab = (float16)(a.lo, b.lo) + (float16)(a.hi, b.hi);
    const float16 cd = (float16)(c.lo, d.lo) + (float16)(c.hi, d.hi);
    return (float16)(ab.s0123, ab.s89ab, cd.s0123, cd.s89ab) + (float16)(ab.s4567, ab.scdef, cd.s4567, cd.scdef);
}

// Lane sums, written as one record. Eight vectors are added up together, halving their lanes each time: half the work of one after
// the other.
static void store_record(const PairSums *sums, __global PairGradient *record) {
    const float16 a = sums_of_four(sums->w, sums->wu, sums->wv, sums->wuu);
    const float16 b = sums_of_four(sums->wuv, sums->wvv, sums->r, sums->g);
    const float16 pairs = (float16)(a.s0145, a.s89cd, b.s0145, b.s89cd) + (float16)(a.s2367, a.sabef, b.s2367, b.sabef);
    vstore8(pairs.even + pairs.odd, 0, (__global float *)record);
    record->b = sum16(sums->b);
}

// Adds what the sixteen pixels say about one splat, and steps in front of it. index: of the splat in the tile's list.
static inline void unblend_block(const float alpha_max, const ScreenSplat *splat, int index, float16 x, float16 y,
                                 BlockState *state, PairSums *sums) {
    const float16 dy = y - splat->y;
    const float16 u = fma((float16)(splat->shear), dy, x - splat->x);
    const float16 power = fma(splat->along_u * u, u, fma(splat->along_v * dy, dy, (float16)(splat->log2_opacity)));
    const int16 blended = power >= LOG2_ALPHA_MIN && index < state->last;
    const float16 free_alpha = blended ? exp2_fast16(power) : (float16)(0);
    const int16 clamped = free_alpha >= alpha_max;
    const float16 alpha = clamped ? (float16)(alpha_max) : free_alpha;

    const float16 inverse = 1.0f / (1.0f - alpha);
    const float16 colour_g =
        fma((float16)(splat->r), state->g_red, fma((float16)(splat->g), state->g_green, splat->b * state->g_blue));
    const float16 d_alpha = inverse * fma(state->t, colour_g, -state->behind);
    const float16 t_before = state->t * inverse;
    const float16 weight = alpha * t_before;
    state->t = t_before;
    state->behind = fma(weight, colour_g, state->behind);

    const float16 w = clamped ? (float16)(0) : alpha * d_alpha;
    const float16 wu = w * u, wv = w * dy;
    sums->w += w;
    sums->wu += wu;
    sums->wv += wv;
    sums->wuu = fma(wu, u, sums->wuu);
    sums->wuv = fma(wu, dy, sums->wuv);
    sums->wvv = fma(wv, dy, sums->wvv);
    sums->r = fma(weight, state->g_red, sums->r);
    sums->g = fma(weight, state->g_green, sums->g);
    sums->b = fma(weight, state->g_blue, sums->b);
}

static int largest(int16 v) {
    const int8 a = max(v.lo, v.hi);
    const int4 b = max(a.lo, a.hi);
    const int2 c = max(b.lo, b.hi);
    return max(c.x, c.y);
}

// Reads the pixels' state at the end of the forward pass, and the largest last of each block; returns the tile's.
static int load_tile(__private const FrameRecord *frame, int tile_x, int tile_y, __global const float *transmittance,
                     __global const int *last, __global const float *d_rgb, BlockState *states, int *block_last) {
    const size_t plane = (size_t)frame->rows * frame->stride;
    const size_t tile = (size_t)tile_y * frame->tiles_x + tile_x;
    int deepest = 0;
    for (int block = 0; block < BLOCKS_PER_TILE; block++) {
        BlockState *state = &states[block];
        __global const float *g = d_rgb + block_origin(tile_x, tile_y, block, frame->stride);
        state->g_red = block_load(g, frame->stride);
        state->g_green = block_load(g + plane, frame->stride);
        state->g_blue = block_load(g + 2 * plane, frame->stride);
        state->t = vload16(tile * BLOCKS_PER_TILE + block, transmittance);
        state->last = vload16(tile * BLOCKS_PER_TILE + block, last);
        state->behind = state->t * (frame->background[0] * state->g_red + frame->background[1] * state->g_green +
                                    frame->background[2] * state->g_blue);
        block_last[block] = largest(state->last);
        deepest = max(deepest, block_last[block]);
    }
    return deepest;
}

// The blocks, one bit each, that have a pixel which was still being blended at list entry `index`. *next: the next smaller index where
// there are more of them.
static uint begun_blocks(const int *block_last, int index, int *next) {
    uint begun = 0;
    *next = 0;
    for (int block = 0; block < BLOCKS_PER_TILE; block++) {
        if (block_last[block] > index)
            begun |= 1u << block;
        else
            *next = max(*next, block_last[block]);
    }
    return begun;
}

__kernel void blend_backward_cpu(const FrameRecord frame, __global const uint *start, __global const uint *list_splat,
                                 __global const uint *list_slot, __global const ushort *list_mask,
                                 __global const ScreenSplat *screen, __global const float *transmittance,
                                 __global const int *last, __global const float *d_rgb, __global PairGradient *records,
                                 __global ushort *mask_of_slot) {
    const int tile_x = (int)get_global_id(0), tile_y = (int)get_global_id(1);
    if (tile_x >= frame.tiles_x || tile_y >= frame.tiles_y) return;
    const uint begin = start[tile_y * frame.tiles_x + tile_x];
    const int count = (int)(start[tile_y * frame.tiles_x + tile_x + 1] - begin);
    BlockState states[BLOCKS_PER_TILE];
    int block_last[BLOCKS_PER_TILE];
    const int deepest = load_tile(&frame, tile_x, tile_y, transmittance, last, d_rgb, states, block_last);

    // What lies behind gets no record, and a mask that says so: with many splats most pairs are hidden.
    for (int index = deepest; index < count; index++) mask_of_slot[list_slot[begin + index]] = 0;

    float16 x[BLOCKS_PER_ROW], y[BLOCKS_PER_ROW]; // pixel centres of each column and row of blocks
    for (int k = 0; k < BLOCKS_PER_ROW; k++) {
        x[k] = block_x(tile_x, k);
        y[k] = block_y(tile_y, k * BLOCKS_PER_ROW);
    }

    uint begun = 0; // the blocks that have anything to do here
    int next = deepest;
    for (int index = deepest - 1; index >= 0; index--) {
        if (index < next) begun = begun_blocks(block_last, index, &next);
        if (index >= ENTRIES_AHEAD) { // splats and records lie in the order of the model, not of the list
            PREFETCH(screen + list_splat[begin + index - ENTRIES_AHEAD]);
            PREFETCH(records + list_slot[begin + index - ENTRIES_AHEAD]);
        }
        uint bits = list_mask[begin + index] & begun;
        if (!bits) { // hidden behind opaque blocks
            mask_of_slot[list_slot[begin + index]] = 0;
            continue;
        }
        const ScreenSplat splat = screen[list_splat[begin + index]];
        PairSums sums;
        sums.w = sums.wu = sums.wv = sums.wuu = sums.wuv = sums.wvv = sums.r = sums.g = sums.b = (float16)(0);
        for (; bits; bits &= bits - 1) {
            const int block = 31 - (int)clz(bits & -bits);
            unblend_block(frame.alpha_max, &splat, index, x[block % BLOCKS_PER_ROW], y[block / BLOCKS_PER_ROW],
                          &states[block], &sums);
        }
        store_record(&sums, records + list_slot[begin + index]);
    }
}
