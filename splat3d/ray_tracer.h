// ray_tracer.h - pictures of a sample scene: what each camera sees, with reflections, sun shadows, haze and smooth edges.
//
// One ray through each pixel's centre finds depth and what is there. Textures are filtered when they are read (ray_texture.h), so that
// only pixels where something else than texture changes (outlines, shadows, reflections) get more: 4 rays, and 4 besides where those
// differ. A fixed rule on the 3 x 3 neighbourhood decides which (after Whitted, "An improved illumination model for shaded
// display", CACM 1980).
#ifndef SPLATLAB_SPLAT3D_RAY_TRACER_H
#define SPLATLAB_SPLAT3D_RAY_TRACER_H

#include "lab/base/image.h"
#include "splat3d/camera.h"
#include "splat3d/ray_scene.h"

// rgb: (H, W, 3) display-referred sRGB in [0, 1]. depth: (H, W, 1) camera z at the pixel's centre, world units; 0: nothing but sky. Both are
// created. The scene's bvh must be built and its light stored. (seed, view): key of all random numbers.
void ray_tracer_picture(const RayScene *scene, const Camera *camera, uint64_t seed, int view, ImageF *rgb,
                        ImageF *depth);

#endif
