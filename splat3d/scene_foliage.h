// scene_foliage.h - things that grow: bushes, grass, trees, climbing plants; many small leaves.
#ifndef SPLATLAB_SPLAT3D_SCENE_FOLIAGE_H
#define SPLATLAB_SPLAT3D_SCENE_FOLIAGE_H

#include "splat3d/ray_mesh.h"

#include <stdint.h>

typedef struct {
    uint64_t seed;
    uint32_t id;          // tells plants apart
    int leaves;           // how many
    double length, width; // of a leaf, world units
    const int *material;  // leaves take one of these at random
    int materials;
} Foliage;

// Leaves in an ellipsoid with these half axes, denser outside than inside, pointing outwards and a little up.
void foliage_bush(RayMesh *mesh, const Foliage *foliage, Vec3 centre, Vec3 half_axes);

// Upright blades on the rectangle low..high (z: the ground's height is low.z).
void foliage_grass(RayMesh *mesh, const Foliage *foliage, Vec3 low, Vec3 high);

// A trunk, `branches` limbs, and a bush at the end of each and at the top. height: of the crown's middle; spread: its radius.
void foliage_tree(RayMesh *mesh, const Foliage *foliage, Vec3 foot, double height, double spread, int branches,
                  int bark);

// Leaves along a curve, standing off by up to `reach`.
void foliage_vine(RayMesh *mesh, const Foliage *foliage, const Vec3 *points, int count, double reach, int bark);

#endif
