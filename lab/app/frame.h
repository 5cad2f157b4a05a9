// frame.h - one picture of a model as `render` writes it: colour, colour with alpha, or depth.
#ifndef SPLATLAB_LAB_APP_FRAME_H
#define SPLATLAB_LAB_APP_FRAME_H

#include "splat3d/rasterizer.h"

#include <stdbool.h>

typedef enum {
    FRAME_COLOUR, // (H, W, 3) over settings->background
    FRAME_ALPHA,  // (H, W, 4), straight alpha, without background
    FRAME_DEPTH,  // (H, W, 1): mean camera depth of what is seen, world units; 0 where nothing is
} FrameKind;

// *image is owned by the caller.
bool frame_render(Rasterizer *rasterizer, const Gaussians *model, const Camera *camera, const RenderSettings *settings,
                  FrameKind kind, ImageF *image);

// Depth for the eye, in place: nearest white, farthest dark grey, nothing black.
void frame_normalise_depth(ImageF *depth);

#endif
