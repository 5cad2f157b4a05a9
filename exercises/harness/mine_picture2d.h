// mine_picture2d.h - the picture of a 2-D scene by a person's own functions: E01's covariance, E02's conic, E05's order, E04's compositing.
#ifndef SPLATLAB_EXERCISES_HARNESS_MINE_PICTURE2D_H
#define SPLATLAB_EXERCISES_HARNESS_MINE_PICTURE2D_H

#include "exercises/harness/mine.h"
#include "splat2d/raster2d.h"

// Fills the picture (3 channels) in square blocks of one colour: each number goes to another process and back. The blocks are as small
// as an interactive rate allows; returns their side in px. transmittance: (height, width), may be NULL.
int mine_picture2d(Mine *mine, const Scene2d *scene, View2d view, const CompositeRule *rule, ImageF *picture,
                   float *transmittance);

#endif
