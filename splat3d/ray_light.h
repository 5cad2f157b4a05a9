// ray_light.h - the light that does not depend on where one looks from, computed once for all views and stored at the corners of the
// triangles: soft light of lamps and sky, and what walls and floors hand on (Cohen and Wallace, "Radiosity and realistic image
// synthesis", 1993, chapter 2; gathered by sampling, as in Ward's ambient calculation, SIGGRAPH 1988).
//
// The sun is not stored, because its shadows are sharper than triangles are small: ray_tracer.h traces it. What bounces off sunlit
// surfaces is stored.
#ifndef SPLATLAB_SPLAT3D_RAY_LIGHT_H
#define SPLATLAB_SPLAT3D_RAY_LIGHT_H

#include "splat3d/ray_scene.h"

#include <stdbool.h>

// Fills scene->mesh.light; the scene's bvh must be built. quality: the hemisphere is divided into quality x 2 quality parts, 2..16. Shows
// progress; fails when the person interrupts it.
bool ray_light_store(RayScene *scene, int quality, uint64_t seed);

#endif
