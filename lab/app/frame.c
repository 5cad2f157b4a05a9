// frame.c - from the rasterizer's sums to the picture that was asked for.
#include "lab/app/frame.h"

#include <math.h>

// Below this alpha a pixel has seen too little for its depth to mean anything.
static const float DEPTH_ALPHA_MIN = 0.05f;
// Of the farthest point in the normalised picture, so that it differs from nothing at all.
static const float FARTHEST_GREY = 0.1f;

// rgb: sum of weight times colour over black. Straight colour is that sum divided by the sum of weights.
static ImageF straight_alpha(const Picture *picture) {
    ImageF out = imagef_create(picture->rgb.width, picture->rgb.height, 4);
    size_t pixels = (size_t)out.width * (size_t)out.height;
    for (size_t i = 0; i < pixels; i++) {
        float alpha = picture->alpha.values[i];
        for (size_t c = 0; c < 3; c++) out.values[4 * i + c] = alpha > 0 ? picture->rgb.values[3 * i + c] / alpha : 0;
        out.values[4 * i + 3] = alpha;
    }
    return out;
}

// r: sum of weight times depth, g: sum of weights (RENDER_DEPTH).
static ImageF mean_depth(const Picture *picture) {
    ImageF out = imagef_create(picture->rgb.width, picture->rgb.height, 1);
    size_t pixels = (size_t)out.width * (size_t)out.height;
    for (size_t i = 0; i < pixels; i++) {
        const float *sums = picture->rgb.values + 3 * i;
        out.values[i] = sums[1] >= DEPTH_ALPHA_MIN ? sums[0] / sums[1] : 0;
    }
    return out;
}

bool frame_render(Rasterizer *rasterizer, const Gaussians *model, const Camera *camera, const RenderSettings *settings,
                  FrameKind kind, ImageF *image) {
    RenderSettings own = *settings;
    if (kind != FRAME_COLOUR) own.background[0] = own.background[1] = own.background[2] = 0;
    if (kind == FRAME_DEPTH) own.what = RENDER_DEPTH;
    Picture picture;
    if (!rasterizer_render(rasterizer, model, camera, &own, &picture)) return false;
    if (kind == FRAME_ALPHA) {
        *image = straight_alpha(&picture);
    } else if (kind == FRAME_DEPTH) {
        *image = mean_depth(&picture);
    } else {
        *image = picture.rgb;
        picture.rgb = (ImageF){0}; // the caller's now
    }
    picture_destroy(&picture);
    return true;
}

void frame_normalise_depth(ImageF *depth) {
    size_t pixels = (size_t)depth->width * (size_t)depth->height;
    float nearest = INFINITY, farthest = 0;
    for (size_t i = 0; i < pixels; i++) {
        float z = depth->values[i];
        if (z <= 0) continue;
        nearest = fminf(nearest, z);
        farthest = fmaxf(farthest, z);
    }
    float span = farthest - nearest;
    for (size_t i = 0; i < pixels; i++) {
        float z = depth->values[i];
        if (z <= 0) continue;
        float share = span > 0 ? (z - nearest) / span : 0;
        depth->values[i] = 1 - (1 - FARTHEST_GREY) * share;
    }
}
