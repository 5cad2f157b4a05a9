// tile_masks.cl - which 4x4-pixel blocks of its tiles each splat reaches with an alpha of at least ALPHA_MIN.
//
// Exact, and cheap: in a band of four pixel rows the ellipse's outline is widest at widest_dy (right) and -widest_dy (left), or at
// the band's edge that is nearest to it; there
//     dx = -shear dy +- sqrt((half_height^2 - dy^2) along_v / along_u)
// so two square roots give the band's blocks. A tile has four bands, done at once as float4:
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

#define CENTRE_FIRST 0.5f // px from a block's edge to its first pixel's centre
#define CENTRE_LAST  (BLOCK_SIZE - 0.5f)
#define BLOCKS       (TILE_SIZE / BLOCK_SIZE)

// Block columns [*first, *end) that the ellipse covers in four bands of a tile row; top: y of the tile's upper edge.
static void band_columns(ScreenSplat splat, float top, int columns, int4 *first, int4 *end) {
    const float margin_x = EXTENT_MARGIN_PX(splat.x, splat.half_width);
    const float margin_y = EXTENT_MARGIN_PX(splat.y, splat.half_height);
    const float4 band = (float4)(0, 4, 8, 12) + (top - splat.y);
    const float4 limit = (float4)(splat.half_height);
    const float4 from = max(band + (CENTRE_FIRST - margin_y), -limit);
    const float4 to = min(band + (CENTRE_LAST + margin_y), limit);
    const float4 dy_right = min(max((float4)(splat.widest_dy), from), to);
    const float4 dy_left = min(max((float4)(-splat.widest_dy), from), to);
    const float aspect = splat.along_v / splat.along_u;
    const float4 right = sqrt(max(limit * limit - dy_right * dy_right, 0.0f) * aspect) - splat.shear * dy_right;
    const float4 left = -sqrt(max(limit * limit - dy_left * dy_left, 0.0f) * aspect) - splat.shear * dy_left;

    // Rounded up and down by truncating positive numbers: ceil() and floor() are slow calls on some devices.
    const float4 first_block = (splat.x + left - (CENTRE_LAST + margin_x)) / BLOCK_SIZE;
    const float4 end_block = (splat.x + right - (CENTRE_FIRST - margin_x)) / BLOCK_SIZE + 1.0f;
    *first = columns - convert_int4(clamp(columns - first_block, 0.0f, (float)columns));
    *end = convert_int4(clamp(end_block, 0.0f, (float)columns));
    *end = from > to ? (int4)(0) : *end;
}

// The bits from low to high - 1 of four, for bounds anywhere. (Bounds of clamp() as vectors: Oclgrind takes scalar ones for the first
// element only.)
static int4 nibbles(int4 low, int4 high) {
    const int4 one = (int4)(1);
    const int4 below_high = (one << clamp(high, (int4)(0), (int4)(BLOCKS))) - 1,
               below_low = (one << clamp(low, (int4)(0), (int4)(BLOCKS))) - 1;
    return below_high & ~below_low;
}

__kernel void tile_masks(const FrameRecord frame, __global const ScreenSplat *screen, __global const TileBox *box,
                         __global const uint *offset, __global ushort *mask) {
    const int i = (int)get_global_id(0);
    if (i >= frame.splat_count) return;
    const TileBox tiles = box[i];
    if (tiles.x0 >= tiles.x1) return;
    const ScreenSplat splat = screen[i];
    __global ushort *out = mask + offset[i];
    for (int y = tiles.y0; y < tiles.y1; y++) {
        int4 first, end;
        band_columns(splat, (float)(y * TILE_SIZE), frame.tiles_x * BLOCKS, &first, &end);
        for (int x = tiles.x0; x < tiles.x1; x++) {
            const int4 bits = nibbles(first - x * BLOCKS, end - x * BLOCKS);
            *out++ = (ushort)(bits.x | bits.y << 4 | bits.z << 8 | bits.w << 12);
        }
    }
}
