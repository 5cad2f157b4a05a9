// ray_shade.h - the light that comes back along one ray.
#ifndef SPLATLAB_SPLAT3D_RAY_SHADE_H
#define SPLATLAB_SPLAT3D_RAY_SHADE_H

#include "lab/base/rng.h"
#include "splat3d/ray_scene.h"

typedef struct {
    Vec3 radiance;         // linear, >= 0
    int material;          // -1: sky or lamp
    double distance;       // along the ray to the surface; world units
    Vec3 position, normal; // of the surface, without relief
    double plain; // brightness as it would be without texture: tells edges of shadows and reflections from painted ones
} RayShade;

// width_per_unit: how wide the ray's pixel is at distance 1.
RayShade ray_shade(const RayScene *scene, const Ray *ray, double width_per_unit, Rng *rng);

double ray_luminance(Vec3 colour); // of linear sRGB (ITU-R BT.709)

#endif
