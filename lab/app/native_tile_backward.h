// native_tile_backward.h - backward blend of one tile; the algorithm is explained in kernels/blend_backward_cpu.cl.
//
// Included by native_blend_avx512.c and native_blend_avx2.c behind their lanes.
#ifndef SPLATLAB_LAB_APP_NATIVE_TILE_BACKWARD_H
#define SPLATLAB_LAB_APP_NATIVE_TILE_BACKWARD_H

#include "lab/app/native_ellipse.h"

#if defined(__x86_64__)

enum { ENTRIES_AHEAD = 4 };

typedef struct {
    Lanes t, behind, g_red, g_green, g_blue, last;
} BackwardState;

typedef struct {
    Lanes w, wu, wv, wuu, wuv, wvv, r, g, b;
} PairSums;

static Lanes load_block(const float *plane, int stride) {
    float lanes[LANES];
    for (int lane = 0; lane < LANES; lane++)
        lanes[lane] = plane[(size_t)(lane / BLOCK_SIZE * stride + lane % BLOCK_SIZE)];
    return lanes_load(lanes);
}

// Also gives each block's largest last; returns the tile's.
static int load_tile(const NativeBlend *blend, int tile, BackwardState *states, int *block_last) {
    const FrameRecord *frame = &blend->frame;
    const size_t plane = (size_t)frame->stride * (size_t)frame->rows;
    int deepest = 0;
    for (int block = 0; block < TILE_BLOCKS; block++) {
        BackwardState *s = &states[block];
        const float *d_rgb = blend->d_rgb + block_place(frame, tile, block);
        const size_t state = ((size_t)tile * TILE_BLOCKS + (size_t)block) * LANES;
        s->g_red = load_block(d_rgb, frame->stride);
        s->g_green = load_block(d_rgb + plane, frame->stride);
        s->g_blue = load_block(d_rgb + 2 * plane, frame->stride);
        s->t = lanes_load(blend->transmittance + state);
        s->last = lanes_load_int(blend->last + state);
        const Lanes red_green = lanes_fma(lanes_all(frame->background[0]), s->g_red,
                                          lanes_mul(lanes_all(frame->background[1]), s->g_green));
        s->behind = lanes_mul(s->t, lanes_fma(lanes_all(frame->background[2]), s->g_blue, red_green));
        block_last[block] = (int)lanes_max(s->last);
        if (block_last[block] > deepest) deepest = block_last[block];
    }
    return deepest;
}

static uint32_t begun_blocks(const int *block_last, int index, int *next) {
    uint32_t begun = 0;
    *next = 0;
    for (int block = 0; block < TILE_BLOCKS; block++)
        if (block_last[block] > index)
            begun |= 1u << block;
        else if (block_last[block] > *next)
            *next = block_last[block];
    return begun;
}

static inline void unblend_lanes(float alpha_max, const ScreenSplat *splat, int index, const float *x, const float *y,
                                 BackwardState *s, PairSums *sums) {
    Lanes u, dy;
    const Lanes power = ellipse_power(splat, x, y, &u, &dy);
    const LaneMask blended =
        lane_mask_and(lanes_ge(power, lanes_all(LOG2_ALPHA_MIN)), lanes_ge(s->last, lanes_all((float)(index + 1))));
    const Lanes free_alpha = exp2_lanes(blended, power), alpha = lanes_min(free_alpha, lanes_all(alpha_max));
    const LaneMask clamped = lanes_ge(free_alpha, lanes_all(alpha_max));
    const Lanes inverse = lanes_div(lanes_all(1), lanes_sub(lanes_all(1), alpha));
    const Lanes colour_g =
        lanes_fma(lanes_all(splat->r), s->g_red,
                  lanes_fma(lanes_all(splat->g), s->g_green, lanes_mul(lanes_all(splat->b), s->g_blue)));
    const Lanes d_alpha = lanes_mul(inverse, lanes_fms(s->t, colour_g, s->behind));
    s->t = lanes_mul(s->t, inverse);
    const Lanes weight = lanes_mul(alpha, s->t);
    s->behind = lanes_fma(weight, colour_g, s->behind);
    const Lanes w = lanes_choose(clamped, lanes_all(0), lanes_mul(alpha, d_alpha));
    const Lanes wu = lanes_mul(w, u), wv = lanes_mul(w, dy);
    sums->w = lanes_add(sums->w, w);
    sums->wu = lanes_add(sums->wu, wu);
    sums->wv = lanes_add(sums->wv, wv);
    sums->wuu = lanes_fma(wu, u, sums->wuu);
    sums->wuv = lanes_fma(wu, dy, sums->wuv);
    sums->wvv = lanes_fma(wv, dy, sums->wvv);
    sums->r = lanes_fma(weight, s->g_red, sums->r);
    sums->g = lanes_fma(weight, s->g_green, sums->g);
    sums->b = lanes_fma(weight, s->g_blue, sums->b);
}

static void backward_tile(const NativeBlend *blend, int tile) {
    const uint32_t begin = blend->start[tile];
    const int count = (int)(blend->start[tile + 1] - begin);
    BackwardState states[TILE_BLOCKS];
    TileCentres centres;
    tile_centres(&blend->frame, tile, &centres);
    int block_last[TILE_BLOCKS];
    const int deepest = load_tile(blend, tile, states, block_last);
    uint32_t begun = 0;
    int next = deepest;
    for (int index = deepest; index < count; index++)
        blend->mask_of_slot[blend->list_slot[begin + (uint32_t)index]] = 0;
    for (int index = deepest - 1; index >= 0; index--) {
        const uint32_t entry = begin + (uint32_t)index;
        if (index < next) begun = begun_blocks(block_last, index, &next);
        if (index >= ENTRIES_AHEAD) {
            __builtin_prefetch(&blend->screen[blend->list_splat[entry - ENTRIES_AHEAD]]);
            __builtin_prefetch(&blend->records[blend->list_slot[entry - ENTRIES_AHEAD]]);
        }
        uint32_t bits = blend->list_mask[entry] & begun;
        if (!bits) {
            blend->mask_of_slot[blend->list_slot[entry]] = 0;
            continue;
        }
        const ScreenSplat splat = blend->screen[blend->list_splat[entry]];
        const Lanes zero = lanes_all(0);
        PairSums sums = {zero, zero, zero, zero, zero, zero, zero, zero, zero};
        for (; bits; bits &= bits - 1) {
            const int block = __builtin_ctz(bits);
            unblend_lanes(blend->frame.alpha_max, &splat, index, centres.x[block], centres.y[block], &states[block],
                          &sums);
        }
        float *record = (float *)&blend->records[blend->list_slot[entry]];
        lanes_sum8(record, sums.w, sums.wu, sums.wv, sums.wuu, sums.wuv, sums.wvv, sums.r, sums.g);
        record[8] = lanes_sum(sums.b);
    }
}

#endif
#endif
