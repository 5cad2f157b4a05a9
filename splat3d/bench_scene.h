// bench_scene.h - the standard scene that speed is measured on: a seeded crowd of splats, the same on every machine.
//
// On the screen (px): means uniform over the picture; the longer standard deviation lognormal with median 3, deviation of its
// logarithm 0.75, at most 50; the shorter one smaller by a factor exp(-|normal(0, 0.6)|); any angle; opacity uniform in 0.05 .. 0.95.
// Harder than a trained scene: 100,000 splats give a pixel of 640 x 480 about 70 that it sees, where trained ones give 20 to 40.
#ifndef SPLATLAB_SPLAT3D_BENCH_SCENE_H
#define SPLATLAB_SPLAT3D_BENCH_SCENE_H

#include "lab/base/image.h"
#include "splat3d/camera.h"
#include "splat3d/gaussians.h"

#include <stdint.h>

// At the world's origin, looking along +z, 60 degrees wide.
Camera bench_scene_camera(int width, int height);

// Flat splats of SH degree 3 that face that camera, at depths of 2 to 10 world units; owned by the caller. Splat i is the same
// whatever the count.
Gaussians bench_scene_gaussians(uint64_t seed, int count, const Camera *camera);

// What a step compares its picture with: RGB noise; owned by the caller.
Image8 bench_scene_photo(uint64_t seed, int width, int height);

#endif
