// tile_masks.cl - which 4x4-pixel blocks of its tiles each splat reaches with an alpha of at least ALPHA_MIN.
//
// Exact, and cheap: in a band of four pixel rows the ellipse's outline is widest at widest_dy (right) and -widest_dy (left), or at
// the band's edge that is nearest to it; there
//     dx = -shear dy +- sqrt((half_height^2 - dy^2) along_v / along_u)
// so two square roots give the band's blocks. A tile has four bands. A work-item does the bands of TILE_ROWS rows of tiles at once: of one
// row on a GPU, of four (-D TILE_ROWS=4) on a CPU, where a float16 costs as much as a float4:
//
//          block columns 0..3         mask bit of a block = 4 * row + column
//         +----+----+----+----+
//  band 0 |    |    |  1 |  1 |       The extent is measured between pixel centres and grown by 0.01 px, so that
//  band 1 |    |  1 |  1 |  1 |       rounding never loses a pixel; a block too many costs time only.
//  band 2 |  1 |  1 |  1 |    |
//  band 3 |  1 |  1 |    |    |
//         +----+----+----+----+
//
//     screen (N), box (N): from project_forward
//     offset (N): where the splat's tiles begin in mask; row by row through its box
//     mask (P): 16 bits for each tile of the box, 0 where the ellipse misses it; P counts the tiles of all boxes
//
// One work-item: one splat. Local memory: none. Test: against every pixel's alpha, tests/splat3d/test_opencl_binning.c.
#include "shared.h"

#include "extent.h"

#ifndef TILE_ROWS
#define TILE_ROWS 1
#endif

#if TILE_ROWS == 1
typedef float4 Bands;
typedef int4 IntBands;
#define INT_OF(bands) convert_int4(bands)
#define BAND_TOP_PX   ((float4)(0, 4, 8, 12))
#define BIT_SHIFT     ((int4)(0, 4, 8, 12))
#else
typedef float16 Bands;
typedef int16 IntBands;
#define INT_OF(bands) convert_int16(bands)
#define BAND_TOP_PX   ((float16)(0, 4, 8, 12, 16, 20, 24, 28, 32, 36, 40, 44, 48, 52, 56, 60))
#define BIT_SHIFT     ((int16)(0, 4, 8, 12, 0, 4, 8, 12, 0, 4, 8, 12, 0, 4, 8, 12))
#endif

#define CENTRE_FIRST 0.5f // px from a block's edge to its first pixel's centre
#define CENTRE_LAST  (BLOCK_SIZE - 0.5f)
#define BLOCKS       (TILE_SIZE / BLOCK_SIZE)

// Block columns [*first, *end) that the ellipse covers in the bands of TILE_ROWS rows of tiles; top: y of their upper edge.
static void band_columns(ScreenSplat splat, float top, int columns, IntBands *first, IntBands *end) {
    const float margin_x = EXTENT_MARGIN_PX(splat.x, splat.half_width);
    const float margin_y = EXTENT_MARGIN_PX(splat.y, splat.half_height);
    const Bands zero = (Bands)(0.0f), last = (Bands)((float)columns);
    const Bands band = BAND_TOP_PX + (top - splat.y);
    const Bands limit = (Bands)(splat.half_height);
    const Bands from = max(band + (CENTRE_FIRST - margin_y), -limit);
    const Bands to = min(band + (CENTRE_LAST + margin_y), limit);
    const Bands dy_right = min(max((Bands)(splat.widest_dy), from), to);
    const Bands dy_left = min(max((Bands)(-splat.widest_dy), from), to);
    const float aspect = splat.along_v / splat.along_u;
    const Bands right = sqrt(max(limit * limit - dy_right * dy_right, zero) * aspect) - splat.shear * dy_right;
    const Bands left = -sqrt(max(limit * limit - dy_left * dy_left, zero) * aspect) - splat.shear * dy_left;

    // Rounded up and down by truncating positive numbers: ceil() and floor() are slow calls on some devices.
    const Bands first_block = (splat.x + left - (CENTRE_LAST + margin_x)) / BLOCK_SIZE;
    const Bands end_block = (splat.x + right - (CENTRE_FIRST - margin_x)) / BLOCK_SIZE + 1.0f;
    *first = columns - INT_OF(min(max(columns - first_block, zero), last));
    *end = INT_OF(min(max(end_block, zero), last));
    *end = from > to ? (IntBands)(0) : *end;
}

// The bits from low to high - 1 of four, for bounds anywhere. (Bounds of clamp() as vectors: Oclgrind takes scalar ones for the first
// element only.)
static IntBands nibbles(IntBands low, IntBands high) {
    const IntBands one = (IntBands)(1), zero = (IntBands)(0), all = (IntBands)(BLOCKS);
    const IntBands below_high = (one << clamp(high, zero, all)) - 1, below_low = (one << clamp(low, zero, all)) - 1;
    return below_high & ~below_low;
}

// The masks of up to TILE_ROWS tiles, one below the other, from their nibbles.
static void store_masks(IntBands bits, int rows, int row_length, __global ushort *mask) {
    bits <<= BIT_SHIFT;
#if TILE_ROWS == 1
    mask[0] = (ushort)(bits.x | bits.y | bits.z | bits.w);
#else
    bits |= bits.s1032547698badcfe;
    bits |= bits.s23016745ab89efcd;
    mask[0] = (ushort)bits.s0;
    if (rows > 1) mask[row_length] = (ushort)bits.s4;
    if (rows > 2) mask[2 * row_length] = (ushort)bits.s8;
    if (rows > 3) mask[3 * row_length] = (ushort)bits.sc;
#endif
}

__kernel void tile_masks(const FrameRecord frame, __global const ScreenSplat *screen, __global const TileBox *box,
                         __global const uint *offset, __global ushort *mask) {
    const int i = (int)get_global_id(0);
    if (i >= frame.splat_count) return;
    const TileBox tiles = box[i];
    if (tiles.x0 >= tiles.x1) return;
    const ScreenSplat splat = screen[i];
    const int row_length = tiles.x1 - tiles.x0;
    __global ushort *out = mask + offset[i];
    for (int y = tiles.y0; y < tiles.y1; y += TILE_ROWS, out += TILE_ROWS * row_length) {
        IntBands first, end;
        band_columns(splat, (float)(y * TILE_SIZE), frame.tiles_x * BLOCKS, &first, &end);
        for (int x = 0; x < row_length; x++)
            store_masks(nibbles(first - (tiles.x0 + x) * BLOCKS, end - (tiles.x0 + x) * BLOCKS), tiles.y1 - y,
                        row_length, out + x);
    }
}
