// ssim_formula.h - SSIM and its derivatives at sixteen pixels, from the blurred moments round them, and the gradient of the
// loss from blurred derivatives (OpenCL C).
//
//     SSIM = (2 mx my + C1) (2 cov + C2) / ((mx^2 + my^2 + C1) (vx + vy + C2))          (Wang et al. 2004, eq. 13)
//     mx = w * x,  vx = w * x^2 - mx^2,  cov = w * (x y) - mx my;   w: Gaussian, 11 x 11, zero padded
#ifndef SPLATLAB_KERNELS_SSIM_FORMULA_H
#define SPLATLAB_KERNELS_SSIM_FORMULA_H

#include "ssim_row.h"

typedef struct {
    float16 x, y, squares, xy; // blurred: picture, photo (less SSIM_SHIFT), the sum of their squares, their product
} Moments;

// SSIM, and its derivatives by the three blurred planes that depend on the picture: half of those by x and xy, and minus the
// one by squares, which saves multiplications. inside: 1, or 0 where all four shall be 0.
static float16 ssim_at(Moments m, float16 inside, float16 *half_x, float16 *minus_xx, float16 *half_xy) {
    const float16 mx = m.x + SSIM_SHIFT, my = m.y + SSIM_SHIFT; // the true means; variances take the shifted ones
    const float16 light = fma(2.0f * mx, my, (float16)(SSIM_C1));
    const float16 structure = fma((float16)(2.0f), fma(-m.x, m.y, m.xy), (float16)(SSIM_C2));
    const float16 means = fma(mx, mx, fma(my, my, (float16)(SSIM_C1)));
    const float16 variances = fma(-m.x, m.x, fma(-m.y, m.y, m.squares)) + SSIM_C2;
    const float16 over_both = inside / (means * variances); // one division for two: they are slow
    const float16 d_light = structure * over_both;
    const float16 ssim = light * d_light, ssim_over_both = ssim * over_both;
    *minus_xx = ssim_over_both * means;
    *half_xy = light * over_both;
    *half_x = fma(my, d_light, -mx * (ssim_over_both * variances)) + fma(m.x, *minus_xx, -m.y * *half_xy);
    return ssim;
}

// d loss / d x from the blurred derivatives of SSIM round the pixels; x, y: the colours less SSIM_SHIFT.
// l1_scale sign(x - y) + ssim_scale (w * d_x + 2 x (w * d_xx) + y (w * d_xy))
static float16 ssim_gradient(const SsimRecord *s, float16 half_x, float16 minus_xx, float16 half_xy, float16 x,
                             float16 y) {
    const float16 half_ssim = fma(-x, minus_xx, fma(y, half_xy, half_x));
    const float16 zero = (float16)(0.0f);
    const float16 d_absolute = select(select(zero, zero - 1.0f, x < y), zero + 1.0f, x > y);
    return fma(2.0f * s->ssim_scale, half_ssim, s->l1_scale * d_absolute);
}

#endif
