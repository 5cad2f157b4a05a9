// scene_points.h - the points that structure from motion would have found in a sample scene's pictures.
//
// Imitated, because the truth is at hand: corners in the pictures (Shi and Tomasi, "Good features to track", CVPR 1994) are taken to their true
// depth, kept when enough other views see the same place, and moved by the error that triangulation would have made.
#ifndef SPLATLAB_SPLAT3D_SCENE_POINTS_H
#define SPLATLAB_SPLAT3D_SCENE_POINTS_H

#include "lab/base/image.h"
#include "splat3d/dataset.h"

#include <stdint.h>

enum { SCENE_TRACK_MIN = 3 };                  // views that must see a point
static const double SCENE_OUTLIER_PART = 0.02; // of the points, lie anywhere along their ray

// views: with camera and image, all of one size. depth: (views), each (H, W, 1) camera z, 0 where there is only sky.
Points scene_points_find(const View *views, const ImageF *depth, int view_count, uint64_t seed);

#endif
