// sample_scene.h - posed scenes of our own making, so that a person can train within a minute of cloning, and with known truth.
//
// A small ray tracer (ray_tracer.h) renders a scene from a believable hand-held path; structure from motion is imitated:
// points on visible texture, with noise, track-dependent error and some outliers. Deterministic: the same name, size,
// views and seed give the same bytes.
#ifndef SPLATLAB_SPLAT3D_SAMPLE_SCENE_H
#define SPLATLAB_SPLAT3D_SAMPLE_SCENE_H

#include <stdbool.h>
#include <stdint.h>

typedef struct {
    int size[2];   // px
    int views;     // pictures, held-out ones included
    uint64_t seed; // of layout, path and noise
} SampleSceneOptions;

SampleSceneOptions sample_scene_options_default(void); // 640 x 480, 64 views, seed 1

typedef struct {
    const char *name, *shows;
} SampleSceneInfo; // "studio", "textured and glossy objects: view-dependent colour"
const SampleSceneInfo *sample_scene_list(int *count);

// Writes folder/images/*.png, folder/depth/*.exr, folder/sparse/0/*.bin, folder/transforms.json, folder/README.md. Shows progress.
bool sample_scene_write(const char *name, const SampleSceneOptions *options, const char *folder);

#endif
