// pixel_walk.c - the rasterizer's inner loop for one pixel, with a record of each step.
#include "splat2d/pixel_walk.h"

#include <math.h>
#include <string.h>

static void colour_so_far(const Composite *pixel, const Raster2d *raster, const RasterSettings *settings,
                          double rgb[3]) {
    Composite ended = *pixel;
    if (settings->background_unattenuated) ended.transmittance = 1;
    composite_end(&ended, raster->background);
    memcpy(rgb, ended.rgb, sizeof ended.rgb);
}

WalkResult pixel_walk(const Raster2d *raster, const RasterSettings *settings, double x, double y, WalkStep *steps) {
    WalkResult result = {0};
    Composite pixel = composite_begin();
    for (int i = 0; i < raster->count; i++) {
        const RasterBlob *blob = &raster->blobs[i];
        WalkStep *step = &steps[i];
        *step =
            (WalkStep){.index = blob->index, .depth = blob->depth, .before = pixel.transmittance, .kind = STEP_FLAT};
        if (blob->shape != SHAPE_FLAT) {
            step->m2 = raster_blob_mahalanobis2(blob, x, y);
            step->g = settings->discs ? step->m2 <= 1 : exp(-step->m2 / 2);
            double alpha = blob->opacity * step->g;
            step->alpha = fmin(alpha, settings->rule.alpha_max);
            step->kind = pixel.opaque ? STEP_HIDDEN : alpha < settings->rule.alpha_min ? STEP_FAINT : STEP_BLENDED;
            step->weight = composite_blend(&pixel, &settings->rule, alpha, blob->rgb);
            bool stopped_before = pixel.opaque && settings->rule.rule == STOP_BEFORE_BLEND;
            if (step->kind == STEP_BLENDED && stopped_before) step->kind = STEP_HIDDEN;
        }
        colour_so_far(&pixel, raster, settings, step->rgb);
        result.weights += step->weight;
        result.blended += step->kind == STEP_BLENDED;
    }
    colour_so_far(&pixel, raster, settings, result.rgb);
    result.transmittance = pixel.transmittance;
    return result;
}
