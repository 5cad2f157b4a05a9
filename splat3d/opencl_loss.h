// opencl_loss.h - L1 + D-SSIM of the picture on the device against an 8-bit photograph, and its gradient (fused strip kernels).
//
//     loss = (1 - lambda) L1 + lambda (1 - SSIM)             (Kerbl et al. 2023, eq. 7); the reference is splat2d/loss.h
#ifndef SPLATLAB_SPLAT3D_OPENCL_LOSS_H
#define SPLATLAB_SPLAT3D_OPENCL_LOSS_H

#include "lab/base/image.h"
#include "splat3d/opencl_rasterizer.h"

typedef struct OpenclLoss OpenclLoss;

// kernels: one pass made for CPUs, two made for GPUs, or by the device; the same loss and gradient up to rounding.
bool opencl_loss_create(Gpu *gpu, BlendKernels kernels, OpenclLoss **loss);
void opencl_loss_destroy(OpenclLoss *loss); // accepts NULL

// A photograph on the device as RGBA bytes (R lowest, A 255 where the file has none), 4 bytes a pixel, rows padded with zeros to
// a multiple of TILE_SIZE pixels like the picture's.
bool opencl_photo_create(Gpu *gpu, const Image8 *image, GpuBuffer **photo);

// Fills picture.d_rgb with d loss / d rgb (the picture as it is, not clipped; zero in the padding), and keeps partial sums on
// the device. The photo has the picture's width and height; where it has alpha, it is laid over background first. Pixels in
// the padding of picture.rgb do not count. lambda: weight of D-SSIM, 0.2.
bool opencl_loss_run(OpenclLoss *loss, DevicePicture picture, GpuBuffer *photo, const float background[3],
                     float lambda);

// Of the last run (waits for the device), means over pixels and channels, summed in a fixed order.
typedef struct {
    double total, l1, ssim;
    double mse; // mean squared error of the picture clipped to [0, 1]: PSNR is -10 log10(mse)
} LossValues;
bool opencl_loss_read(OpenclLoss *loss, LossValues *values);

#endif
