// rasterizer.h - from Gaussians to a picture and back: a small table of functions with two fillers, the double-precision C
// reference (reference.h: to read, and to check against) and OpenCL (opencl_rasterizer.h: to use).
//
// The trainer uses the OpenCL one's own, faster interface, which keeps everything on the device; this one is for single pictures
// and for tests that hold the two against each other.
#ifndef SPLATLAB_SPLAT3D_RASTERIZER_H
#define SPLATLAB_SPLAT3D_RASTERIZER_H

#include "lab/base/image.h"
#include "splat2d/compositing.h"
#include "splat3d/camera.h"
#include "splat3d/gaussians.h"

#include <stdbool.h>

typedef enum {
    RENDER_COLOUR, // SH colour of each splat
    RENDER_DEPTH,  // each splat's "colour" is its camera depth: r = sum w z (expected depth times alpha), g = alpha
} RenderWhat;

typedef struct {
    float background[3]; // r g b; enters as T_end * background
    int sh_degree;       // spherical harmonics up to this degree (or the model's, if that is smaller)
    RenderWhat what;
    float alpha_max;    // ALPHA_MAX
    float near_depth;   // NEAR_DEPTH, world units
    float low_pass_px2; // LOW_PASS_PX2
    StopRule stop_rule; // the OpenCL kernels know only STOP_AFTER_BLEND
} RenderSettings;

RenderSettings render_settings_default(void); // black background, degree 3, the constants of kernels/shared.h

typedef struct {
    ImageF rgb;   // (H, W, 3), not clipped
    ImageF alpha; // (H, W, 1): 1 - T_end
} Picture;

void picture_destroy(Picture *picture);

typedef struct Rasterizer Rasterizer;

typedef struct {
    const char *name; // "reference", "opencl"
    bool (*render)(Rasterizer *self, const Gaussians *model, const Camera *camera, const RenderSettings *settings,
                   Picture *picture);
    // Gradient of a loss by every parameter, given its gradient d_rgb (H, W, 3) by the picture's rgb. Renders first.
    bool (*backward)(Rasterizer *self, const Gaussians *model, const Camera *camera, const RenderSettings *settings,
                     const ImageF *d_rgb, Gaussians *d_model);
    // NULL where a model costs nothing to pass: rasterizer_hold().
    bool (*hold)(Rasterizer *self, const Gaussians *model);
    void (*destroy)(Rasterizer *self);
} RasterizerApi;

struct Rasterizer {
    const RasterizerApi *api;
}; // the fillers' objects begin with this

bool rasterizer_render(Rasterizer *r, const Gaussians *model, const Camera *camera, const RenderSettings *settings,
                       Picture *picture);
bool rasterizer_backward(Rasterizer *r, const Gaussians *model, const Camera *camera, const RenderSettings *settings,
                         const ImageF *d_rgb,
                         Gaussians *d_model); // *d_model is created, owned by the caller
void rasterizer_destroy(Rasterizer *r);       // accepts NULL

// For many pictures of one model: copies it to the device, and calls with this very object (unchanged) copy it no more, until
// rasterizer_hold(r, NULL) or a call with another model. It frees nothing.
bool rasterizer_hold(Rasterizer *r, const Gaussians *model);

#endif
