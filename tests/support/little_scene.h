// little_scene.h - a scene of a few pixels with known truth: some splats, and pictures of exactly those splats.
#ifndef SPLATLAB_TESTS_SUPPORT_LITTLE_SCENE_H
#define SPLATLAB_TESTS_SUPPORT_LITTLE_SCENE_H

#include "splat3d/camera.h"
#include "splat3d/gaussians.h"

enum { LITTLE_VIEWS = 9, LITTLE_WIDTH = 48, LITTLE_HEIGHT = 32 }; // views 0 and 8 are held out

// 24 coloured splats of SH degree 1 round the origin; owned by the caller.
Gaussians little_scene_model(void);

// View 0..8: round the origin, at distance 4.
Camera little_scene_camera(int view);

// Writes folder/images/view_0.png ... (on black, by the C reference) and the COLMAP model in folder/sparse/0.
void little_scene_write(const char *folder);

#endif
