// ssim_forward_gpu.cl - SSIM of picture x and photo y with its derivatives, and the sums of all parts of the loss, for GPUs.
//
//     SSIM = (2 mx my + C1) (2 cov + C2) / ((mx^2 + my^2 + C1) (vx + vy + C2))          (Wang et al. 2004, eq. 13)
//     mx = w * x,  vx = w * x^2 - mx^2,  cov = w * (x y) - mx my;   w: Gaussian, 11 x 11, zero padded
// per channel; then the derivatives of SSIM by mx (in which vx and cov follow), w * x^2 and w * (x y), times
// 1/2, -1 and 1/2, which ssim_backward_gpu.cl blurs again. Formulas: splat2d/loss.c (the C reference).
//
//     picture (3, rows, stride): planes r g b; what lies right of width and below height is not read
//     photo   (height, stride): R G B A bytes, R lowest
//     maps    (SSIM_MAPS, 3, rows, stride + 2 SSIM_MARGIN): written for rows < height; 0 in margins and right of width
//     sums    (work-items, SSIM_SUMS): of the work-item's own pixels
//
// One work-item: a strip of 16 columns and SSIM_STRIP_HEIGHT rows of one channel; item ((strip_y * 3) + channel) * strips_x + strip_x.
// Both passes of the separable window are fused: each row is blurred along x once and kept while the window, moving down,
// needs it. The ring holds every row twice, so that any 11 rows lie one behind the other and weights stay in registers:
//
//     slot   0 1 2 ... 10 | 11 12 ... 21         row r is stored at r % 11 and at r % 11 + 11;
//                 [ s ... s + 10 ]               the 11 rows that end with r begin at s = r % 11 + 1
// Sixteen lanes are written out because CPU compilers do not vectorise such a loop over work-items by themselves.
// Local memory: none; 6 KB of private array. Test: tests/splat3d/test_opencl_loss.c.
#include "ssim_formula.h"
#include "ssim_row.h"

enum { TAPS = 2 * SSIM_RADIUS + 1 };

// Weighted by a distance from the window's centre, added to *sum.
static void add_tap(Moments *sum, float weight, float16 x, float16 y) {
    const float16 wx = weight * x, wy = weight * y;
    sum->x += wx;
    sum->y += wy;
    sum->squares = fma(wx, x, fma(wy, y, sum->squares));
    sum->xy = fma(wx, y, sum->xy);
}

// A row blurred along x.
static void blur_row(const float *w, SsimRow x, SsimRow y, Moments *out) {
    Moments sum;
    sum.x = sum.y = sum.squares = sum.xy = (float16)(0.0f);
#define TAP(k, distance) add_tap(&sum, w[distance], SSIM_TAP_##k(x), SSIM_TAP_##k(y))
    TAP(m5, 5), TAP(m4, 4), TAP(m3, 3), TAP(m2, 2), TAP(m1, 1), TAP(0, 0);
    TAP(p1, 1), TAP(p2, 2), TAP(p3, 3), TAP(p4, 4), TAP(p5, 5);
#undef TAP
    *out = sum;
}

// Eleven rows blurred along y.
static void blur_column(const float *w, const Moments *rows, Moments *out) {
    Moments sum;
    sum.x = sum.y = sum.squares = sum.xy = (float16)(0.0f);
#pragma unroll
    for (int k = 0; k < TAPS; k++) {
        const float weight = w[abs(k - SSIM_RADIUS)];
        sum.x = fma(weight, rows[k].x, sum.x);
        sum.y = fma(weight, rows[k].y, sum.y);
        sum.squares = fma(weight, rows[k].squares, sum.squares);
        sum.xy = fma(weight, rows[k].xy, sum.xy);
    }
    *out = sum;
}

// One row of the three maps; strips at the left and right edge also clear the margin beside them.
static void store_maps(const SsimRecord *s, __global float *maps, int x, int y, int channel, const float16 *values) {
    const int row = s->stride + 2 * SSIM_MARGIN, plane = row * s->rows;
    for (int k = 0; k < SSIM_MAPS; k++) {
        __global float16 *at = (__global float16 *)(maps + (k * 3 + channel) * plane + y * row + SSIM_MARGIN + x);
        at[0] = values[k];
        if (x == 0) at[-1] = (float16)(0.0f);
        if (x + SSIM_STRIP_WIDTH == s->stride) at[1] = (float16)(0.0f);
    }
}

__kernel void ssim_forward_gpu(const SsimRecord s, __global const float *picture, __global const uint *photo,
                               __global float *maps, __global float *sums) {
    const int strips_x = s.stride / SSIM_STRIP_WIDTH;
    const int strips_y = (s.height + SSIM_STRIP_HEIGHT - 1) / SSIM_STRIP_HEIGHT;
    const int item = (int)get_global_id(0);
    if (item >= strips_x * strips_y * 3) return;
    const int x = item % strips_x * SSIM_STRIP_WIDTH, channel = item / strips_x % 3;
    const int y_begin = item / strips_x / 3 * SSIM_STRIP_HEIGHT, y_end = min(y_begin + SSIM_STRIP_HEIGHT, s.height);
    const float16 inside = select((float16)(0.0f), (float16)(1.0f), ssim_columns(x) < s.width);

    Moments ring[2 * TAPS];
    float16 sum_absolute = (float16)(0.0f), sum_square = (float16)(0.0f), sum_ssim = (float16)(0.0f);
    int slot = 0; // of the row y
    for (int y = y_begin - SSIM_RADIUS; y < y_end + SSIM_RADIUS; y++) {
        const float16 zero = (float16)(0.0f);
        SsimRow p = {zero, zero, zero}, q = p; // outside the picture
        const int y_ahead = clamp(y + SSIM_ROWS_AHEAD, 0, s.height - 1);
        PREFETCH(picture + (channel * s.rows + y_ahead) * s.stride + x + 16);
        PREFETCH(photo + y_ahead * s.stride + x + 16);
        if (y >= 0 && y < s.height) {
            ssim_picture_row(picture + (channel * s.rows + y) * s.stride, x, &s, &p);
            ssim_photo_row(photo + y * s.stride, x, &s, channel, &q);
        }
        if (y >= y_begin && y < y_end) {
            const float16 clipped = clamp(p.here, 0.0f, 1.0f) - q.here;
            sum_absolute += fabs(p.here - q.here);
            sum_square = fma(clipped, clipped, sum_square);
        }
        p.before -= SSIM_SHIFT, p.here -= SSIM_SHIFT, p.after -= SSIM_SHIFT;
        q.before -= SSIM_SHIFT, q.here -= SSIM_SHIFT, q.after -= SSIM_SHIFT;
        blur_row(s.window, p, q, &ring[slot]);
        ring[slot + TAPS] = ring[slot];
        const int y_out = y - SSIM_RADIUS; // its window is complete
        if (y_out >= y_begin) {
            Moments window;
            float16 map[SSIM_MAPS];
            blur_column(s.window, ring + slot + 1, &window);
            sum_ssim += ssim_at(window, inside, &map[0], &map[1], &map[2]);
            store_maps(&s, maps, x, y_out, channel, map);
        }
        slot = slot == TAPS - 1 ? 0 : slot + 1;
    }
    sums[item * SSIM_SUMS] = ssim_lane_sum(sum_absolute);
    sums[item * SSIM_SUMS + 1] = ssim_lane_sum(sum_square);
    sums[item * SSIM_SUMS + 2] = ssim_lane_sum(sum_ssim);
}
