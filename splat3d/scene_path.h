// scene_path.h - where the cameras of a sample scene stand: an arc or a loop round the subject, walked by hand.
#ifndef SPLATLAB_SPLAT3D_SCENE_PATH_H
#define SPLATLAB_SPLAT3D_SCENE_PATH_H

#include "splat3d/camera.h"

#include <stdint.h>

typedef struct {
    Vec3 target;           // what is looked at
    double radius, height; // of the walk round the target, and above it; world units
    double start_rad;      // of the first camera, counter-clockwise from +x seen from above
    double sweep_rad;      // 2 pi: a closed loop; less: an arc
    double sway;           // how far the hand strays from the ideal path, as a part of the radius
    double fov_x_rad;      // full horizontal angle
} ScenePath;

// Camera number `view` of `views`. Strays smoothly in distance, height and aim, and trembles a little from view to view.
Camera scene_path_camera(const ScenePath *path, uint64_t seed, int view, int views, int width, int height);

#endif
