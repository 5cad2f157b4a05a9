// ssim.h - arguments of the loss kernels ssim_forward_gpu.cl and ssim_backward_gpu.cl, shared with splat3d/opencl_loss.c.
#ifndef SPLATLAB_KERNELS_SSIM_H
#define SPLATLAB_KERNELS_SSIM_H

#include "shared.h"

#define SSIM_STRIP_WIDTH  16   // px; what one work-item does: one float16 ...
#define SSIM_STRIP_HEIGHT 32   // px; ... down this many rows of one colour channel
#define SSIM_PANEL_WIDTH  1024 // px; what one work-item of ssim_cpu.cl does of one channel, at most: these columns ...
#define SSIM_PANEL_HEIGHT 86   // px; ... of these rows; 16 n - 2 SSIM_RADIUS, which n walks along 16 rows do
#define SSIM_MAPS         3    // derivatives of SSIM by the local mean, variance and covariance, scaled: ssim_formula.h
#define SSIM_MARGIN       16   // zeros left and right of each row of a map
#define SSIM_SUMS         3    // what a work-item sums: |difference|, squared difference, SSIM

// A kernel argument by value.
typedef struct {
    int width, height;             // px, of picture and photo
    int stride, rows;              // of the picture's planes, multiples of 16
    float background[3];           // r g b, behind a photo with alpha
    float window[SSIM_RADIUS + 1]; // 1-D Gaussian weight at distance 0..5, the whole window sums to 1
    float l1_scale;                // (1 - lambda) / (3 width height)
    float ssim_scale;              // -lambda / (3 width height)
} SsimRecord;

#endif
