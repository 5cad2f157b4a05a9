// native_tile_forward.h - forward blend of one tile; the algorithm is explained in kernels/blend_forward_cpu.cl.
//
// Included by native_blend_avx512.c and native_blend_avx2.c behind their lanes.
#ifndef SPLATLAB_LAB_APP_NATIVE_TILE_FORWARD_H
#define SPLATLAB_LAB_APP_NATIVE_TILE_FORWARD_H

#include "lab/app/native_ellipse.h"

#if defined(__x86_64__)

typedef struct {
    Lanes t, r, g, b, last;
} ForwardState;

static inline void blend_bits(float alpha_max, const uint32_t *words, const ScreenSplat *staged, int first,
                              const float *x, const float *y, ForwardState *state) {
    ForwardState s = *state;
    for (int word = 0; word < WORDS && lane_mask_any(lanes_ge(s.t, lanes_all(TRANSMITTANCE_STOP))); word++)
        for (uint32_t bits = words[TILE_BLOCKS * word]; bits;) {
            const int i = 32 * word + __builtin_clz(bits);
            bits ^= 0x80000000u >> (i & 31);
            const ScreenSplat *splat = &staged[i];
            Lanes u, dy;
            const Lanes power = ellipse_power(splat, x, y, &u, &dy);
            const LaneMask reached = lanes_ge(power, lanes_all(LOG2_ALPHA_MIN));
            const LaneMask blended = lane_mask_and(reached, lanes_ge(s.t, lanes_all(TRANSMITTANCE_STOP)));
            const Lanes alpha = lanes_min(exp2_lanes(reached, power), lanes_all(alpha_max));
            const Lanes weight = lanes_keep(blended, lanes_mul(alpha, s.t));
            s.r = lanes_fma(weight, lanes_all(splat->r), s.r);
            s.g = lanes_fma(weight, lanes_all(splat->g), s.g);
            s.b = lanes_fma(weight, lanes_all(splat->b), s.b);
            s.t = lanes_choose(blended, lanes_fnma(alpha, s.t, s.t), s.t);
            s.last = lanes_choose(blended, lanes_all((float)(first + i + 1)), s.last);
        }
    *state = s;
}

static void store_block(const NativeBlend *blend, int tile, int block, const ForwardState *s) {
    const FrameRecord *frame = &blend->frame;
    const size_t plane = (size_t)frame->stride * (size_t)frame->rows, at = block_place(frame, tile, block);
    const Lanes colour[3] = {s->r, s->g, s->b};
    for (int c = 0; c < 3; c++) {
        float lanes[LANES];
        lanes_store(lanes, lanes_fma(s->t, lanes_all(frame->background[c]), colour[c]));
        for (int lane = 0; lane < LANES; lane++)
            blend->rgb[(size_t)c * plane + at + (size_t)(lane / BLOCK_SIZE * frame->stride + lane % BLOCK_SIZE)] =
                lanes[lane];
    }
    const size_t state = ((size_t)tile * TILE_BLOCKS + (size_t)block) * LANES;
    lanes_store(blend->transmittance + state, s->t);
    lanes_store_int(blend->last + state, s->last);
}

static void forward_tile(const NativeBlend *blend, int tile) {
    const FrameRecord *frame = &blend->frame;
    const uint32_t begin = blend->start[tile];
    const int count = (int)(blend->start[tile + 1] - begin);
    ScreenSplat staged[32 * WORDS];
    uint32_t words[WORDS * TILE_BLOCKS];
    ForwardState states[TILE_BLOCKS];
    TileCentres centres;
    tile_centres(frame, tile, &centres);
    for (int block = 0; block < TILE_BLOCKS; block++)
        states[block] = (ForwardState){lanes_all(1), lanes_all(0), lanes_all(0), lanes_all(0), lanes_all(0)};
    unsigned opaque = 0;
    for (int first = 0; first < count && opaque != 0xffff; first += 32 * WORDS) {
        const int batch = count - first < 32 * WORDS ? count - first : 32 * WORDS;
        const uint32_t *splat = blend->list_splat + begin + first;
        const uint16_t *mask = blend->list_mask + begin + first;
        for (int i = 0; i < batch; i++) staged[i] = blend->screen[splat[i]];
        for (int word = 0; word < WORDS; word++) {
            LaneBits bits = lane_bits_none();
            for (int i = 32 * word; i < 32 * word + 32; i++) bits = lane_bits_push(bits, i < batch ? mask[i] : 0);
            lane_bits_store(words + TILE_BLOCKS * word, bits);
        }
        for (int block = 0; block < TILE_BLOCKS; block++) {
            if (opaque >> block & 1) continue;
            blend_bits(frame->alpha_max, words + block, staged, first, centres.x[block], centres.y[block],
                       &states[block]);
            if (!lane_mask_any(lanes_ge(states[block].t, lanes_all(TRANSMITTANCE_STOP)))) opaque |= 1u << block;
        }
    }
    for (int block = 0; block < TILE_BLOCKS; block++) store_block(blend, tile, block, &states[block]);
}

#endif
#endif
