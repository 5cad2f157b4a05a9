// ray_bvh.h - finds the triangle that a ray hits first: a tree of boxes round the triangles (bounding volume hierarchy).
#ifndef SPLATLAB_SPLAT3D_RAY_BVH_H
#define SPLATLAB_SPLAT3D_RAY_BVH_H

#include "splat3d/ray_mesh.h"

#include <stdbool.h>

typedef struct {
    Vec3 origin, direction; // direction of length 1
    double far;             // only hits nearer than this count; world units
} Ray;

typedef struct {
    int triangle;    // index into the mesh
    double distance; // along the ray, world units
    double b1, b2;   // barycentric weights of corners 1 and 2; corner 0 has 1 - b1 - b2
} RayHit;

typedef struct RayNode RayNode;
typedef struct RayLeaf RayLeaf;

typedef struct {
    int node_count, leaf_count;
    RayNode *nodes; // node 0 is the root; none when there are no triangles
    RayLeaf *leaves;
} RayBvh;

RayBvh ray_bvh_build(const RayMesh *mesh); // an empty mesh is fine: nothing is ever hit
void ray_bvh_destroy(RayBvh *bvh);         // accepts a zeroed one

// The nearest hit with distance in (0, ray.far). Triangles have no back: both sides are hit.
bool ray_bvh_nearest(const RayBvh *bvh, const Ray *ray, RayHit *hit);

// Is there any? For shadows.
bool ray_bvh_blocked(const RayBvh *bvh, const Ray *ray);

#endif
