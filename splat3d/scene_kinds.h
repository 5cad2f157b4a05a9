// scene_kinds.h - the sample scenes that there are: each file scene_NAME.c builds one, and says where its cameras go.
#ifndef SPLATLAB_SPLAT3D_SCENE_KINDS_H
#define SPLATLAB_SPLAT3D_SCENE_KINDS_H

#include "splat3d/ray_scene.h"
#include "splat3d/scene_paint.h"
#include "splat3d/scene_path.h"

#include <stdint.h>

// How fine a scene is built; follows from the size of the pictures.
typedef struct {
    uint64_t seed;    // of layout and patterns
    double detail;    // (0, 1]: cells of surfaces, as a part of the finest
    int texture_size; // texels a side of the largest textures, a power of two
} SceneRequest;

// A number of cells or segments at this detail, at least `least`.
int scene_cells(const SceneRequest *request, int finest, int least);

// Paints a texture of texture_size >> smaller texels a side, and adds the material with it. Returns the material.
int scene_painted(const SceneRequest *request, RayScene *scene, RayPainter *painter, Paint paint, int smaller,
                  RayMaterial material);

// Each fills an empty scene (all but bvh and light) and the path of its cameras.
typedef void SceneBuilder(const SceneRequest *request, RayScene *scene, ScenePath *path);
SceneBuilder scene_studio_build, scene_fence_build, scene_courtyard_build;

#endif
