// shared.h - constants and records that the OpenCL C kernels and the C host share, each written once.
//
// Included by both sides. Records hold 4-byte scalars only (sizeof(float3) is 16 on a device), so that their layout is the
// same everywhere; a test compares every sizeof on the device with the host's. Formulas are not shared: the C
// reference is written independently of the kernels, so that they can check each other.
#ifndef SPLATLAB_KERNELS_SHARED_H
#define SPLATLAB_KERNELS_SHARED_H

// ---- the rendering model (docs/conventions.md) ----
#define TILE_SIZE          16              // px; a tile is 16 x 16 pixels
#define BLOCK_SIZE         4               // px; a tile is 4 x 4 blocks of 4 x 4 pixels, one bit each in a pair's mask
#define ALPHA_MAX          0.99f           // alpha' = min(ALPHA_MAX, opacity * g)
#define ALPHA_MIN          (1.0f / 255.0f) // a smaller alpha' is skipped
#define TRANSMITTANCE_STOP 1e-4f           // a splat is blended while T >= this before it
#define LOW_PASS_PX2       0.3f            // px^2 added to the diagonal of Sigma' (EWA low-pass filter)
#define NEAR_DEPTH         0.2f            // world units; nearer splats are not drawn
#define FRUSTUM_MARGIN     0.3f // J is evaluated at most 0.3 * half the image's width (height) outside the image

// ---- spherical harmonics: real basis, degree d has 2d + 1 functions ----
#define SH_DEGREE_MAX       3
#define SH_COEFFICIENTS_MAX 16 // (SH_DEGREE_MAX + 1)^2, per colour channel

// ---- SSIM (Wang et al. 2004): 11 x 11 Gaussian window, zero padded ----
#define SSIM_RADIUS 5    // px
#define SSIM_SIGMA  1.5f // px
#define SSIM_C1     (0.01f * 0.01f)
#define SSIM_C2     (0.03f * 0.03f)

#endif
