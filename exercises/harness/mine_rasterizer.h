// mine_rasterizer.h - a Rasterizer that renders by a person's own functions, and by the C reference where they do not pass.
//
// E08's covariance, E09's projection, E10's EWA, E02's conic, E12's colour, E05's order and E04's compositing, each in place of the reference's
// stage of the same name. It renders colour pictures; there is no backward pass.
#ifndef SPLATLAB_EXERCISES_HARNESS_MINE_RASTERIZER_H
#define SPLATLAB_EXERCISES_HARNESS_MINE_RASTERIZER_H

#include "exercises/harness/mine.h"
#include "splat3d/rasterizer.h"

Rasterizer *mine_rasterizer_create(Mine *mine); // mine: borrowed; must outlive it

#endif
