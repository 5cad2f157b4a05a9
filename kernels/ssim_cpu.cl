// ssim_cpu.cl - the loss (1 - lambda) L1 + lambda (1 - SSIM) and its gradient by the picture in one pass, for devices that are CPUs.
//
// The equations, arguments and sums of ssim_forward_gpu.cl and ssim_backward_gpu.cl (which a GPU runs one after the other), but the maps of
// derivatives never leave the cache. A work-item takes a band of rows and walks along it, sixteen columns at a time. Windows are
// blurred down first, where the taps are whole vectors, then across, where they are views of three neighbouring vectors:
//
//     block            v-2            v-1             v
//              ... |---------|    |---------|    |---------|      1  read picture and photo of block v, 4 products a pixel
//                                                 blurred down    2  -> moments of v
//                            blurred across (v-2, v-1, v)         3  -> SSIM and its three derivatives of v-1
//                                  blurred down                   4  -> maps of v-1
//              blurred across (v-3, v-2, v-1)                     5  -> gradient of v-2
//
// A band of SSIM_BAND_HEIGHT rows needs the maps of 5 more above and below, and the pictures of 10 more; that is computed twice, and
// costs less than writing the maps to memory and reading them back.
//
//     picture (3, rows, stride), photo (height, stride) RGBA bytes
//     sums (work-items, SSIM_SUMS): of the work-item's own pixels
//     d_picture (3, rows, stride): written everywhere, 0 right of width and below height
//
// One work-item: one band of one channel; item band * 3 + channel. Local memory: none; 100 KB of private arrays.
// Reference: splat2d/loss.c. Test: tests/splat3d/test_opencl_loss.c.
#include "ssim_formula.h"
#include "ssim_row.h"

#define BAND       SSIM_BAND_HEIGHT
#define MAP_ROWS   (BAND + 2 * SSIM_RADIUS)
#define INPUT_ROWS (BAND + 4 * SSIM_RADIUS)
#define MOMENTS    4 // x, y, x^2 + y^2, x y: Moments of ssim_formula.h, plane by plane
#define RING       3 // blocks that are kept: a window reaches into both neighbours

typedef struct {
    float16 moment[MOMENTS][MAP_ROWS]; // blurred down
} MomentBlock;

typedef struct {
    float16 map[SSIM_MAPS][BAND]; // blurred down
} MapBlock;

// Each row of out: the eleven rows of `rows` from the same one on, weighted; small weights first, so that little is rounded away.
static void blur_down(const float *w, const float16 *rows, int count, float16 *out) {
    for (int y = 0; y < count; y++, rows++) {
        float16 above = w[5] * rows[0], below = w[5] * rows[10];
        above = fma((float16)(w[4]), rows[1], above), below = fma((float16)(w[4]), rows[9], below);
        above = fma((float16)(w[3]), rows[2], above), below = fma((float16)(w[3]), rows[8], below);
        above = fma((float16)(w[2]), rows[3], above), below = fma((float16)(w[2]), rows[7], below);
        above = fma((float16)(w[1]), rows[4], above), below = fma((float16)(w[1]), rows[6], below);
        out[y] = fma((float16)(w[0]), rows[5], above + below);
    }
}

// Step 1 and 2: the moments of sixteen columns from x on. y: first row that is read, 2 SSIM_RADIUS above the band.
static void make_moments(const SsimRecord *s, __global const float *plane, __global const uint *photo, int x, int y,
                         int channel, MomentBlock *out) {
    float16 in[MOMENTS][INPUT_ROWS];
    for (int row = 0; row < INPUT_ROWS; row++, y++) {
        float16 p = (float16)(0.0f), q = (float16)(0.0f); // outside the picture
        if (y >= 0 && y < s->height) {
            PREFETCH(plane + y * s->stride + x + SSIM_COLUMNS_AHEAD);
            PREFETCH(photo + y * s->stride + x + SSIM_COLUMNS_AHEAD);
            p = ssim_picture16(plane + y * s->stride, x, s);
            q = ssim_photo16(photo + y * s->stride, x, s, channel);
        }
        p -= SSIM_SHIFT, q -= SSIM_SHIFT;
        in[0][row] = p;
        in[1][row] = q;
        in[2][row] = fma(p, p, q * q);
        in[3][row] = p * q;
    }
    for (int k = 0; k < MOMENTS; k++) blur_down(s->window, in[k], MAP_ROWS, out->moment[k]);
}

// Steps 3 and 4: the maps of sixteen columns from x on, from the moments of the blocks round them. y: first map row, SSIM_RADIUS
// above the band. Returns the sum of SSIM over the band's own pixels.
static float16 make_maps(const SsimRecord *s, const MomentBlock *before, const MomentBlock *here,
                         const MomentBlock *after, int x, int y, MapBlock *out) {
    float16 maps[SSIM_MAPS][MAP_ROWS];
    float16 sum = (float16)(0.0f);
    const float16 inside = select((float16)(0.0f), (float16)(1.0f), ssim_columns(x) < s->width);
    for (int row = 0; row < MAP_ROWS; row++, y++) {
        if (y < 0 || y >= s->height) {
            maps[0][row] = maps[1][row] = maps[2][row] = (float16)(0.0f);
            continue;
        }
        float16 blurred[MOMENTS], d_x, d_xx, d_xy;
        for (int k = 0; k < MOMENTS; k++) {
            const SsimRow r = {before->moment[k][row], here->moment[k][row], after->moment[k][row]};
            blurred[k] = ssim_blur_across(s->window, r);
        }
        const Moments m = {blurred[0], blurred[1], blurred[2], blurred[3]};
        const float16 ssim = ssim_at(m, &d_x, &d_xx, &d_xy);
        if (row >= SSIM_RADIUS && row < SSIM_RADIUS + BAND) sum = fma(inside, ssim, sum);
        maps[0][row] = inside * d_x;
        maps[1][row] = inside * d_xx;
        maps[2][row] = inside * d_xy;
    }
    for (int k = 0; k < SSIM_MAPS; k++) blur_down(s->window, maps[k], BAND, out->map[k]);
    return sum;
}

// Step 5 for sixteen columns from x on; adds to the sums of |difference| and squared difference.
static void make_gradient(const SsimRecord *s, __global const float *plane, __global const uint *photo, int x,
                          int y_begin, int channel, const MapBlock *before, const MapBlock *here, const MapBlock *after,
                          __global float *d_plane, float16 *sum_absolute, float16 *sum_square) {
    const int16 inside = ssim_columns(x) < s->width;
    for (int row = 0; row < BAND && y_begin + row < s->rows; row++) {
        const int y = y_begin + row;
        float16 gradient = (float16)(0.0f), blurred[SSIM_MAPS];
        if (y < s->height) {
            for (int k = 0; k < SSIM_MAPS; k++) {
                const SsimRow r = {before->map[k][row], here->map[k][row], after->map[k][row]};
                blurred[k] = ssim_blur_across(s->window, r);
            }
            const float16 p = ssim_picture16(plane + y * s->stride, x, s);
            const float16 q = ssim_photo16(photo + y * s->stride, x, s, channel);
            const float16 clipped = clamp(p, 0.0f, 1.0f) - q;
            *sum_absolute += fabs(p - q);
            *sum_square = fma(clipped, clipped, *sum_square);
            gradient = select(gradient, ssim_gradient(s, blurred[0], blurred[1], blurred[2], p, q), inside);
        }
        *(__global float16 *)(d_plane + y * s->stride + x) = gradient;
    }
}

__kernel void ssim_cpu(const SsimRecord s, __global const float *picture, __global const uint *photo,
                       __global float *sums, __global float *d_picture) {
    const int item = (int)get_global_id(0), channel = item % 3;
    if (item >= 3 * ((s.rows + BAND - 1) / BAND)) return;
    const int y_begin = item / 3 * BAND;
    const int blocks = s.stride / SSIM_STRIP_WIDTH;
    __global const float *plane = picture + (size_t)channel * s.rows * s.stride;
    __global float *d_plane = d_picture + (size_t)channel * s.rows * s.stride;

    MomentBlock moments[RING];
    MapBlock maps[RING];
    float16 sum_absolute = (float16)(0.0f), sum_square = (float16)(0.0f), sum_ssim = (float16)(0.0f);
    for (int block = -1; block <= blocks + 1; block++) {
        const int newest = (block + 1) % RING, middle = (block + RING) % RING, oldest = (block + 2) % RING;
        const int x = block * SSIM_STRIP_WIDTH;
        if (block <= blocks) make_moments(&s, plane, photo, x, y_begin - 2 * SSIM_RADIUS, channel, &moments[newest]);
        // The maps' ring runs one block behind, so that its slots have the same names one step later.
        if (block >= 1 && block <= blocks)
            sum_ssim += make_maps(&s, &moments[oldest], &moments[middle], &moments[newest], x - SSIM_STRIP_WIDTH,
                                  y_begin - SSIM_RADIUS, &maps[newest]);
        else
            for (int k = 0; k < SSIM_MAPS; k++)
                for (int row = 0; row < BAND; row++) maps[newest].map[k][row] = (float16)(0.0f);
        if (block >= 2)
            make_gradient(&s, plane, photo, x - 2 * SSIM_STRIP_WIDTH, y_begin, channel, &maps[oldest], &maps[middle],
                          &maps[newest], d_plane, &sum_absolute, &sum_square);
    }
    sums[item * SSIM_SUMS] = ssim_lane_sum(sum_absolute);
    sums[item * SSIM_SUMS + 1] = ssim_lane_sum(sum_square);
    sums[item * SSIM_SUMS + 2] = ssim_lane_sum(sum_ssim);
}
