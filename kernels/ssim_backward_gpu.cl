// ssim_backward_gpu.cl - gradient of (1 - lambda) L1 + lambda (1 - SSIM) by the picture, for GPUs.
//
//     d loss / d x = l1_scale sign(x - y) + ssim_scale (w * a + 2 x (w * b) + y (w * c))
// with a, b, c the derivatives of SSIM by w * x, w * x^2, w * (x y), which ssim_forward_gpu.cl left as a / 2, -b, c / 2, and x, y
// less SSIM_SHIFT as there. The picture is not clipped. (splat2d/loss.c, the C reference, derives it.)
//
//     picture (3, rows, stride), photo (height, stride) RGBA bytes, maps (SSIM_MAPS, 3, rows, stride + 2 SSIM_MARGIN)
//     d_picture (3, rows, stride): written everywhere, 0 right of width and below height
//
// One work-item: a strip of 16 columns and SSIM_STRIP_HEIGHT rows of one channel, as in ssim_forward_gpu.cl, with the same ring of
// blurred rows; strips cover all rows of the plane here. Local memory: none; 4 KB of private array.
// Test: tests/splat3d/test_opencl_loss.c.
#include "ssim_formula.h"
#include "ssim_row.h"

enum { TAPS = 2 * SSIM_RADIUS + 1 };

typedef struct {
    float16 map[SSIM_MAPS];
} MapRow;

// A row of a map, blurred along x; `at` is the strip's place in it.
static float16 blur_row(const float *w, __global const float *at) {
    __global const float16 *vectors = (__global const float16 *)at;
    const SsimRow r = {vectors[-1], vectors[0], vectors[1]};
    return ssim_blur_across(w, r);
}

static float16 blur_column(const float *w, const MapRow *rows, int map) {
    float16 sum = (float16)(0.0f);
#pragma unroll
    for (int k = 0; k < TAPS; k++) sum = fma(w[abs(k - SSIM_RADIUS)], rows[k].map[map], sum);
    return sum;
}

// The gradient of 16 pixels from the 11 blurred map rows round them.
static float16 gradient16(const SsimRecord *s, const MapRow *rows, float16 x, float16 y) {
    const float16 a = blur_column(s->window, rows, 0);
    const float16 b = blur_column(s->window, rows, 1);
    const float16 c = blur_column(s->window, rows, 2);
    return ssim_gradient(s, a, b, c, x, y);
}

__kernel void ssim_backward_gpu(const SsimRecord s, __global const float *picture, __global const uint *photo,
                                __global const float *maps, __global float *d_picture) {
    const int strips_x = s.stride / SSIM_STRIP_WIDTH;
    const int strips_y = (s.rows + SSIM_STRIP_HEIGHT - 1) / SSIM_STRIP_HEIGHT;
    const int item = (int)get_global_id(0);
    if (item >= strips_x * strips_y * 3) return;
    const int x = item % strips_x * SSIM_STRIP_WIDTH, channel = item / strips_x % 3;
    const int y_begin = item / strips_x / 3 * SSIM_STRIP_HEIGHT, y_end = min(y_begin + SSIM_STRIP_HEIGHT, s.rows);
    const int map_row = s.stride + 2 * SSIM_MARGIN, map_plane = map_row * s.rows;
    const int16 inside = ssim_columns(x) < s.width;

    MapRow ring[2 * TAPS];
    int slot = 0; // of the row y
    for (int y = y_begin - SSIM_RADIUS; y < y_end + SSIM_RADIUS; y++) {
        for (int map = 0; map < SSIM_MAPS; map++) {
            __global const float *column = maps + (map * 3 + channel) * map_plane + SSIM_MARGIN + x;
            float16 blurred = (float16)(0.0f);
            PREFETCH(column + clamp(y + SSIM_ROWS_AHEAD, 0, s.height - 1) * map_row + 16);
            if (y >= 0 && y < s.height) blurred = blur_row(s.window, column + y * map_row);
            ring[slot].map[map] = ring[slot + TAPS].map[map] = blurred;
        }
        const int y_out = y - SSIM_RADIUS; // its window is complete
        if (y_out >= y_begin) {
            const int row = (channel * s.rows + y_out) * s.stride;
            float16 gradient = (float16)(0.0f);
            if (y_out < s.height) {
                const int y_ahead = min(y_out + SSIM_ROWS_AHEAD, s.height - 1);
                PREFETCH(picture + (channel * s.rows + y_ahead) * s.stride + x);
                PREFETCH(photo + y_ahead * s.stride + x);
                const float16 value = ssim_picture16(picture + row, x, &s);
                const float16 truth = ssim_photo16(photo + y_out * s.stride, x, &s, channel);
                gradient =
                    select(gradient, gradient16(&s, ring + slot + 1, value - SSIM_SHIFT, truth - SSIM_SHIFT), inside);
            }
            *(__global float16 *)(d_picture + row + x) = gradient;
        }
        slot = slot == TAPS - 1 ? 0 : slot + 1;
    }
}
