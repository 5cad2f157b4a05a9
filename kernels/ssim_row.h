// ssim_row.h - sixteen neighbouring pixels of picture, photo or map, and the neighbours that a window needs (OpenCL C).
//
// Windows see all colours less SSIM_SHIFT: variances do not change by a shift, and E[x^2] - E[x]^2 loses less to rounding
// when x is near zero. What lies outside the picture is 0 before the shift.
//
// A window of radius 5 round 16 pixels at columns x .. x+15 needs 26:
//
//      x-5                x+10 x+11           x+20
//       |------- left -------|----- right --...|        two vectors, loaded once
//       |---- SSIM_TAP(0) ---|
//        |---- SSIM_TAP(1) ---|                         eleven views of them, by register moves
//                  ...
//                 |---- SSIM_TAP(10) ---|
#ifndef SPLATLAB_KERNELS_SSIM_ROW_H
#define SPLATLAB_KERNELS_SSIM_ROW_H

#include "ssim.h"

#define SSIM_SHIFT 0.5f

typedef struct {
    float16 left, right; // columns x-5 .. x+10 and x+11 .. x+26 of one row
} SsimRow;

#define SSIM_TAP_0(l, r)  (l)
#define SSIM_TAP_1(l, r)  ((float16)((l).s12345678, (l).s9abc, (l).sde, (l).sf, (r).s0))
#define SSIM_TAP_2(l, r)  ((float16)((l).s23456789, (l).sabcd, (l).sef, (r).s01))
#define SSIM_TAP_3(l, r)  ((float16)((l).s3456789a, (l).sbcde, (l).sf, (r).s0, (r).s12))
#define SSIM_TAP_4(l, r)  ((float16)((l).s456789ab, (l).scdef, (r).s0123))
#define SSIM_TAP_5(l, r)  ((float16)((l).s56789abc, (l).sde, (l).sf, (r).s0, (r).s1234))
#define SSIM_TAP_6(l, r)  ((float16)((l).s6789abcd, (l).sef, (r).s01, (r).s2345))
#define SSIM_TAP_7(l, r)  ((float16)((l).s789abcde, (l).sf, (r).s0, (r).s12, (r).s3456))
#define SSIM_TAP_8(l, r)  ((float16)((l).s89abcdef, (r).s01234567))
#define SSIM_TAP_9(l, r)  ((float16)((l).s9abc, (l).sde, (l).sf, (r).s0, (r).s12345678))
#define SSIM_TAP_10(l, r) ((float16)((l).sabcd, (l).sef, (r).s01, (r).s23456789))

// Column numbers of a vector that begins at x.
static int16 ssim_columns(int x) { return (int16)(x) + (int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15); }

// Values of one picture row from column x on; 0 outside the picture.
static float16 ssim_picture16(__global const float *row, int x, int width) {
    if (x >= 0 && x + 16 <= width) return vload16(0, row + x);
    float inside[16];
    for (int i = 0; i < 16; i++) inside[i] = x + i >= 0 && x + i < width ? row[x + i] : 0.0f;
    return vload16(0, inside);
}

// Values of one channel of RGBA bytes over the background.
static float16 ssim_over16(uint16 rgba, int channel, float background) {
    const float over_255 = 1.0f / 255.0f;
    const float16 byte = convert_float16(rgba >> (uint)(8 * channel) & 255u);
    const float16 quotient = byte * over_255;
    const float16 colour = fma(fma(-quotient, (float16)(255.0f), byte), over_255, quotient); // byte / 255, rounded once
    const float16 alpha = convert_float16(rgba >> 24) * over_255;                            // 0 and 255 give 0 and 1
    return fma(colour, alpha, background * (1.0f - alpha));
}

// Channel values of one photo row from column x on; 0 outside the picture.
static float16 ssim_photo16(__global const uint *row, int x, int width, int channel, float background) {
    if (x >= 0 && x + 16 <= width) return ssim_over16(vload16(0, row + x), channel, background);
    uint inside[16];
    for (int i = 0; i < 16; i++) inside[i] = x + i >= 0 && x + i < width ? row[x + i] : 0u;
    const int16 columns = ssim_columns(x);
    const float16 value = ssim_over16(vload16(0, inside), channel, background);
    return select((float16)(0.0f), value, columns >= 0 && columns < width);
}

// Sum of the lanes, always in this order.
static float ssim_lane_sum(float16 v) {
    const float8 a = v.lo + v.hi;
    const float4 b = a.lo + a.hi;
    const float2 c = b.lo + b.hi;
    return c.x + c.y;
}

#endif
