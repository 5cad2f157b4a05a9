// ssim_row.h - sixteen neighbouring pixels of picture, photo or map, and the neighbours that a window needs (OpenCL C).
//
// Windows see all colours less SSIM_SHIFT: variances do not change by a shift, and E[x^2] - E[x]^2 loses less to rounding
// when x is near zero. What lies outside the picture is 0 before the shift.
//
// Rows are read as whole aligned vectors only (unaligned ones become many small loads on some compilers). The window of radius 5
// round the pixels of a strip, columns x .. x+15, needs parts of three:
//
//      x-16           x               x+16
//      |--- before ---|---- here -----|---- after ---|
//                |-- TAP(m5) --|
//                 |-- TAP(m4) --|                      eleven views of them, by register moves
//                        ...
//                          |-- TAP(p5) --|
#ifndef SPLATLAB_KERNELS_SSIM_ROW_H
#define SPLATLAB_KERNELS_SSIM_ROW_H

#include "prefetch.h"
#include "ssim.h"

#define SSIM_SHIFT 0.5f

typedef struct {
    float16 before, here, after; // columns x-16 .. x+31 of one row
} SsimRow;

#define SSIM_TAP_m5(r) ((float16)((r).before.sbcde, (r).before.sf, (r).here.s01234567, (r).here.s89, (r).here.sa))
#define SSIM_TAP_m4(r) ((float16)((r).before.scdef, (r).here.s01234567, (r).here.s89ab))
#define SSIM_TAP_m3(r) ((float16)((r).before.sde, (r).before.sf, (r).here.s01234567, (r).here.s89ab, (r).here.sc))
#define SSIM_TAP_m2(r) ((float16)((r).before.sef, (r).here.s01234567, (r).here.s89ab, (r).here.scd))
#define SSIM_TAP_m1(r) ((float16)((r).before.sf, (r).here.s01234567, (r).here.s89ab, (r).here.scd, (r).here.se))
#define SSIM_TAP_0(r)  ((r).here)
#define SSIM_TAP_p1(r) ((float16)((r).here.s12345678, (r).here.s9abc, (r).here.sde, (r).here.sf, (r).after.s0))
#define SSIM_TAP_p2(r) ((float16)((r).here.s23456789, (r).here.sabcd, (r).here.sef, (r).after.s01))
#define SSIM_TAP_p3(r) ((float16)((r).here.s3456789a, (r).here.sbcde, (r).here.sf, (r).after.s01, (r).after.s2))
#define SSIM_TAP_p4(r) ((float16)((r).here.s456789ab, (r).here.scdef, (r).after.s0123))
#define SSIM_TAP_p5(r) ((float16)((r).here.s56789abc, (r).here.sde, (r).here.sf, (r).after.s0123, (r).after.s4))

// Column numbers of a vector that begins at x.
static int16 ssim_columns(int x) { return (int16)(x) + (int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15); }

// Values of one picture row from column x on, a multiple of 16; 0 outside the picture.
static float16 ssim_picture16(__global const float *row, int x, const SsimRecord *s) {
    if (x < 0 || x >= s->width) return (float16)(0.0f);
    const float16 value = *(__global const float16 *)(row + x);
    return select((float16)(0.0f), value, ssim_columns(x) < s->width);
}

// Values of one channel of one photo row, laid over the background; as above.
static float16 ssim_photo16(__global const uint *row, int x, const SsimRecord *s, int channel) {
    if (x < 0 || x >= s->width) return (float16)(0.0f);
    const uint16 rgba = *(__global const uint16 *)(row + x);
    const float head = 257.0f / 65536.0f, tail = 1.0f / 255.0f / 65536.0f; // of 1 / 255; byte * head is exact
    const float16 byte = convert_float16(rgba >> (uint)(8 * channel) & 255u);
    const float16 colour = fma(byte, (float16)(tail), byte * head);      // byte / 255, rounded once
    const float16 alpha = convert_float16(rgba >> 24) * (1.0f / 255.0f); // 0 and 255 give 0 and 1
    const float16 behind = s->background[channel];
    const float16 value = fma(colour, alpha, fma(-alpha, behind, behind));
    return select((float16)(0.0f), value, ssim_columns(x) < s->width);
}

static void ssim_picture_row(__global const float *row, int x, const SsimRecord *s, SsimRow *r) {
    r->before = ssim_picture16(row, x - 16, s);
    r->here = ssim_picture16(row, x, s);
    r->after = ssim_picture16(row, x + 16, s);
}

static void ssim_photo_row(__global const uint *row, int x, const SsimRecord *s, int channel, SsimRow *r) {
    r->before = ssim_photo16(row, x - 16, s, channel);
    r->here = ssim_photo16(row, x, s, channel);
    r->after = ssim_photo16(row, x + 16, s, channel);
}

// The middle part of a row blurred along x; w: weight by distance. Small weights first, so that little is rounded away.
static float16 ssim_blur_across(const float *w, SsimRow r) {
    float16 sum = w[5] * (SSIM_TAP_m5(r) + SSIM_TAP_p5(r));
    sum = fma(w[4], SSIM_TAP_m4(r) + SSIM_TAP_p4(r), sum);
    sum = fma(w[3], SSIM_TAP_m3(r) + SSIM_TAP_p3(r), sum);
    sum = fma(w[2], SSIM_TAP_m2(r) + SSIM_TAP_p2(r), sum);
    sum = fma(w[1], SSIM_TAP_m1(r) + SSIM_TAP_p1(r), sum);
    return fma(w[0], SSIM_TAP_0(r), sum);
}

// How far ahead a strip asks for memory: it steps by whole picture rows, wider than a CPU foresees by itself; unasked, half the time
// would be waiting.
#define SSIM_ROWS_AHEAD    4
#define SSIM_COLUMNS_AHEAD 16 // and a panel, which walks along sixteen rows at once

// Sum of the lanes, always in this order.
static float ssim_lane_sum(float16 v) {
    const float8 a = v.lo + v.hi;
    const float4 b = a.lo + a.hi;
    const float2 c = b.lo + b.hi;
    return c.x + c.y;
}

#endif
