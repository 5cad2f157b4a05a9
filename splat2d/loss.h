// loss.h - how far a picture is from the photograph: L1, SSIM, their mixture that training descends, and PSNR.
//
//     loss = (1 - lambda) L1 + lambda (1 - SSIM)             (Kerbl et al. 2023, eq. 7, lambda 0.2)
// SSIM as Wang et al. 2004: 11x11 Gaussian window of sigma 1.5, zero padded, per channel, mean over pixels and
// channels. Plain double precision: the readable reference for kernels/ssim_*.cl, and what `eval` reports.
#ifndef SPLATLAB_SPLAT2D_LOSS_H
#define SPLATLAB_SPLAT2D_LOSS_H

#include "lab/base/image.h"

typedef struct {
    double total, l1, ssim;
} Loss;

// Of two pictures (3 channels, same size). d_picture: (height, width, 3) doubles that receive d total / d picture, or
// NULL.
Loss loss_l1_dssim(const ImageF *picture, const ImageF *photo, double lambda, double *d_picture);

double metric_ssim(const ImageF *picture, const ImageF *photo); // [-1, 1]

// dB: -10 log10(mean squared error), after clipping the picture to [0, 1]; at most 99, which identical pictures have.
double metric_psnr(const ImageF *picture, const ImageF *photo);

#endif
