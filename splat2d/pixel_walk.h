// pixel_walk.h - one pixel explained: its walk through the blobs, step by step, as the rasterizer does it.
#ifndef SPLATLAB_SPLAT2D_PIXEL_WALK_H
#define SPLATLAB_SPLAT2D_PIXEL_WALK_H

#include "splat2d/raster2d.h"

// What became of a blob at this pixel.
typedef enum {
    STEP_BLENDED,
    STEP_FLAT,   // its shape has no inverse
    STEP_FAINT,  // alpha' < alpha_min: skipped
    STEP_HIDDEN, // the pixel is opaque already (or the stop rule ends before this blob)
} StepKind;

typedef struct {
    int index;     // of the blob in the scene
    double depth;  // of the blob
    double m2;     // squared Mahalanobis distance; negative with an invalid Sigma
    double g;      // exp(-m2 / 2), or what the disc has there
    double alpha;  // alpha' = opacity g, clamped by the rule
    double before; // T before it
    double weight; // T alpha', 0 unless blended
    double rgb[3]; // of the pixel so far, with the background behind it: what would be seen if the list ended here
    StepKind kind;
} WalkStep;

typedef struct {
    double transmittance; // T_end
    double weights;       // sum of the weights; weights + T_end = 1
    double rgb[3];        // the pixel
    int blended;          // how many steps were
} WalkResult;

// The pixel whose centre is (x, y) px of the picture. steps: room for raster->count, front to back.
WalkResult pixel_walk(const Raster2d *raster, const RasterSettings *settings, double x, double y, WalkStep *steps);

#endif
