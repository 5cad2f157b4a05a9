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

// SSIM, and its derivatives by the three blurred planes that depend on the picture.
static float16 ssim_at(Moments m, float16 *d_x, float16 *d_xx, float16 *d_xy) {
    const float16 mx = m.x + SSIM_SHIFT, my = m.y + SSIM_SHIFT; // the true means; variances take the shifted ones
    const float16 light = fma(2.0f * mx, my, (float16)(SSIM_C1));
    const float16 structure = fma((float16)(2.0f), fma(-m.x, m.y, m.xy), (float16)(SSIM_C2));
    const float16 means = fma(mx, mx, fma(my, my, (float16)(SSIM_C1)));
    const float16 variances = fma(-m.x, m.x, fma(-m.y, m.y, m.squares)) + SSIM_C2;
    const float16 over_both = 1.0f / (means * variances); // one division for two: they are slow
    const float16 over_light = variances * over_both, over_structure = means * over_both;
    const float16 d_light = structure * over_light * over_structure;
    const float16 ssim = light * d_light;
    *d_xx = -ssim * over_structure;
    *d_xy = 2.0f * light * over_light * over_structure;
    *d_x = 2.0f * (my * d_light - mx * ssim * over_light) - 2.0f * m.x * *d_xx - m.y * *d_xy;
    return ssim;
}

// d loss / d x from the blurred derivatives of SSIM round the pixels: l1_scale sign(x - y) + ssim_scale (w * d_x + 2 x (w * d_xx) + y (w * d_xy)).
static float16 ssim_gradient(const SsimRecord *s, float16 d_x, float16 d_xx, float16 d_xy, float16 x, float16 y) {
    const float16 d_ssim = fma(2.0f * (x - SSIM_SHIFT), d_xx, fma(y - SSIM_SHIFT, d_xy, d_x));
    const float16 zero = (float16)(0.0f);
    const float16 d_absolute = select(select(zero, zero - 1.0f, x < y), zero + 1.0f, x > y);
    return fma(s->ssim_scale, d_ssim, s->l1_scale * d_absolute);
}

#endif
