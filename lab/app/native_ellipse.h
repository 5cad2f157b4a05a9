// native_ellipse.h - what both directions of the native blend share, over the sixteen lanes that a native_lanes_*.h defines: where
// the pixels of a block are, and how much of a splat they see.
#ifndef SPLATLAB_LAB_APP_NATIVE_ELLIPSE_H
#define SPLATLAB_LAB_APP_NATIVE_ELLIPSE_H

#include "lab/app/native_tile.h"

#include <stddef.h>

#if defined(__x86_64__)
#ifndef NATIVE_LANES_CHOSEN // read alone: any lanes will do
#include "lab/app/native_lanes_avx2.h"
#endif

enum { BLOCKS = TILE_SIZE / BLOCK_SIZE, TILE_BLOCKS = BLOCKS * BLOCKS, LANES = BLOCK_SIZE * BLOCK_SIZE, WORDS = 4 };

// x and y of a block's pixel centres, from the tile's corner.
typedef struct {
    float x[TILE_BLOCKS][LANES], y[TILE_BLOCKS][LANES];
} TileCentres;

static void tile_centres(const FrameRecord *frame, int tile, TileCentres *centres) {
    const int left = tile % frame->tiles_x * TILE_SIZE, top = tile / frame->tiles_x * TILE_SIZE;
    for (int block = 0; block < TILE_BLOCKS; block++)
        for (int lane = 0; lane < LANES; lane++) {
            centres->x[block][lane] = (float)(left + block % BLOCKS * BLOCK_SIZE + lane % BLOCK_SIZE) + 0.5f;
            centres->y[block][lane] = (float)(top + block / BLOCKS * BLOCK_SIZE + lane / BLOCK_SIZE) + 0.5f;
        }
}

// 2^x where the mask is set, else 0 (kernels/exp2_fast.h).
static inline Lanes exp2_lanes(LaneMask m, Lanes x) {
    const Lanes f = lanes_fraction(x);
    Lanes p = lanes_fma(lanes_all(0.00187757646f), f, lanes_all(0.00898933969f));
    p = lanes_fma(p, f, lanes_all(0.0558263138f));
    p = lanes_fma(p, f, lanes_all(0.240153611f));
    p = lanes_fma(p, f, lanes_all(0.693153024f));
    p = lanes_fma(p, f, lanes_all(0.99999994f));
    return lanes_scale(m, p, x);
}

// The splat's ellipse at sixteen pixels: log2 alpha, and the coordinates u and dy.
static inline Lanes ellipse_power(const ScreenSplat *s, const float *x, const float *y, Lanes *u, Lanes *dy) {
    *dy = lanes_sub(lanes_load(y), lanes_all(s->y));
    *u = lanes_fma(lanes_all(s->shear), *dy, lanes_sub(lanes_load(x), lanes_all(s->x)));
    const Lanes along_v = lanes_fma(lanes_mul(lanes_all(s->along_v), *dy), *dy, lanes_all(s->log2_opacity));
    return lanes_fma(lanes_mul(lanes_all(s->along_u), *u), *u, along_v);
}

static size_t block_place(const FrameRecord *frame, int tile, int block) {
    const int x = tile % frame->tiles_x * TILE_SIZE + block % BLOCKS * BLOCK_SIZE;
    const int y = tile / frame->tiles_x * TILE_SIZE + block / BLOCKS * BLOCK_SIZE;
    return (size_t)y * (size_t)frame->stride + (size_t)x;
}

#endif
#endif
