// random_scene.h - seeded scenes of random splats in front of a camera, to hold two renderers against each other.
#ifndef SPLATLAB_TESTS_SUPPORT_RANDOM_SCENE_H
#define SPLATLAB_TESTS_SUPPORT_RANDOM_SCENE_H

#include "splat3d/camera.h"
#include "splat3d/gaussians.h"

#include <stdint.h>

typedef struct {
    uint64_t seed;
    int count, sh_degree;
    double size_px; // median standard deviation on the screen, px
    double spread;  // standard deviation of ln size
    double logit_low, logit_high;
    double outside; // how far means lie outside the picture, in units of its half size; some lie behind the camera
} RandomScene;

RandomScene random_scene_default(uint64_t seed); // 300 splats of degree 3, 4 px, opacities 0.05 .. 0.95

// Looks along a tilted axis from somewhere; the principal point is off the middle.
Camera random_scene_camera(uint64_t seed, int width, int height);

Gaussians random_scene_gaussians(const RandomScene *scene, const Camera *camera);

// Uniform in [-1, 1].
void random_scene_values(uint64_t seed, float *values, size_t count);

#endif
