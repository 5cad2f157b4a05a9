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
#define LOG2_ALPHA_MIN     -7.99435344f    // log2(ALPHA_MIN)
#define TRANSMITTANCE_STOP 1e-4f           // a splat is blended while T >= this before it
#define LOW_PASS_PX2       0.3f            // px^2 added to the diagonal of Sigma' (EWA low-pass filter)
#define NEAR_DEPTH         0.2f            // world units; nearer splats are not drawn
#define FRUSTUM_MARGIN     0.3f // J is evaluated at most 0.3 * half the image's width (height) outside the image

// ---- the model on the device: groups of sixteen splats; of a group all first numbers, then all second ones, ... ----
#define SPLAT_GROUP 16

// ---- spherical harmonics: real basis, degree d has 2d + 1 functions ----
#define SH_DEGREE_MAX       3
#define SH_COEFFICIENTS_MAX 16 // (SH_DEGREE_MAX + 1)^2, per colour channel

// ---- SSIM (Wang et al. 2004): 11 x 11 Gaussian window, zero padded ----
#define SSIM_RADIUS 5    // px
#define SSIM_SIGMA  1.5f // px
#define SSIM_C1     (0.01f * 0.01f)
#define SSIM_C2     (0.03f * 0.03f)

// ---- records of a frame: what one rendering needs to know, and what its stages hand to each other ----

// Camera and settings of one frame; a kernel argument by value.
typedef struct {
    float rotation[9];    // world to camera, row-major
    float translation[3]; // world to camera
    float position[3];    // of the camera, world
    float focal[2];       // px
    float centre[2];      // principal point, px
    float ratio_low[2];   // x/z and y/z are clamped to this range where J is evaluated
    float ratio_high[2];
    float background[3]; // r g b
    float near_depth;    // world units
    float low_pass_px2;
    float alpha_max;   // (0, 1)
    int width, height; // px
    int stride, rows;  // width and height padded to whole tiles
    int tiles_x, tiles_y;
    int splat_count; // N
    int sh_degree;   // active degree, 0..3
    int is_depth;    // 1: a splat's "colour" is (depth, 1, 0)
} FrameRecord;

// One splat on the screen. With offsets dx, dy (px) from its mean, u = dx + shear dy:
//     log2 alpha = along_u u^2 + along_v dy^2 + log2_opacity
typedef struct {
    float x, y;             // mean, px
    float along_u, along_v; // <= 0, 1/px^2, with the factor -log2(e) / 2
    float shear;            // -Sigma'_xy / Sigma'_yy
    float log2_opacity;
    float r, g, b;                 // colour >= 0
    float half_width, half_height; // px, of the box around the ellipse alpha = ALPHA_MIN
    float widest_dy;               // px, dy of the ellipse's rightmost point
} ScreenSplat;

// The tiles that box touches, x0 <= tile x < x1; all zero when the splat is not visible.
typedef struct {
    int x0, y0, x1, y1;
} TileBox;

// What one tile's pixels say about one splat: sums over them of W = d loss / d ln alpha times 1, u, v, uu, uv, vv
// (v = dy), and of the blending weight times the pixel's gradient.
typedef struct {
    float w, wu, wv, wuu, wuv, wvv;
    float r, g, b;
} PairGradient;

#endif
