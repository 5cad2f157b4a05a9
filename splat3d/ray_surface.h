// ray_surface.h - the place where a ray meets a sample scene: what its texture, normal and stored light are there.
#ifndef SPLATLAB_SPLAT3D_RAY_SURFACE_H
#define SPLATLAB_SPLAT3D_RAY_SURFACE_H

#include "splat3d/ray_scene.h"

typedef struct {
    Vec3 position;
    Vec3 flat_normal;   // of the triangle, towards where the ray came from
    Vec3 smooth_normal; // blended from the corners'; towards where the ray came from
    Vec3 normal;        // smooth_normal bent by relief
    Vec3 light;         // stored light, irradiance / pi
    Vec3 albedo;
    int material;
} RaySurfacePoint;

// width: what the ray's pixel measures at the hit, world units across the ray; decides how finely textures are read.
RaySurfacePoint ray_surface_at(const RayScene *scene, const Ray *ray, const RayHit *hit, double width);

// Only the light that is stored there, for light that bounces; no textures are read.
Vec3 ray_surface_light(const RayMesh *mesh, const RayHit *hit, const float *light);

// A copy of `point`, a little off the surface on the side of `direction`: where a ray in that direction starts.
Vec3 ray_surface_leave(Vec3 point, Vec3 normal, Vec3 direction);

#endif
