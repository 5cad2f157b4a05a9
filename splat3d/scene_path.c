#include "splat3d/scene_path.h"

#include "lab/base/rng.h"

static const double PI = 3.14159265358979323846;

// What strays; each has waves of its own.
typedef enum { STRAY_ANGLE, STRAY_RADIUS, STRAY_HEIGHT, STRAY_AIM_X, STRAY_AIM_Y, STRAY_AIM_Z, STRAY_ROLL } Stray;

enum { WAVES = 4 };

// A smooth function of the place along the path, s in [0, 1], about [-1, 1], with the same value at both ends: a few waves of random
// phase; then a tremble of the hand, which knows nothing of its neighbours.
static double stray(Stray what, uint64_t seed, double s, int view) {
    Rng phases = rng_at(seed, RNG_SCENE_PATH, UINT32_MAX, (uint32_t)what);
    double sum = 0;
    for (int k = 1; k <= WAVES; k++) sum += sin(2 * PI * (k * s + rng_uniform(&phases))) / (1 + 0.5 * k);
    Rng hand = rng_at(seed, RNG_SCENE_PATH, (uint32_t)view, (uint32_t)what);
    return 0.6 * sum + 0.12 * rng_normal(&hand);
}

Camera scene_path_camera(const ScenePath *path, uint64_t seed, int view, int views, int width, int height) {
    bool loop = path->sweep_rad > 1.999 * PI;
    double s = loop ? (double)view / views : (double)view / (views > 1 ? views - 1 : 1);
    double away = path->sway * path->radius, spacing = path->sweep_rad / views;
    double angle = path->start_rad + path->sweep_rad * s + 0.3 * spacing * stray(STRAY_ANGLE, seed, s, view);
    double radius = path->radius + away * stray(STRAY_RADIUS, seed, s, view);
    double up = path->height + 1.4 * away * stray(STRAY_HEIGHT, seed, s, view);
    Vec3 eye = vec3_add(path->target, vec3(radius * cos(angle), radius * sin(angle), up));
    Vec3 miss = vec3(stray(STRAY_AIM_X, seed, s, view), stray(STRAY_AIM_Y, seed, s, view),
                     0.6 * stray(STRAY_AIM_Z, seed, s, view));
    Vec3 target = vec3_add(path->target, vec3_scale(miss, 0.5 * away));
    double roll = 0.015 * stray(STRAY_ROLL, seed, s, view);
    Vec3 side = vec3_normalize(vec3_cross(vec3_sub(target, eye), vec3(0, 0, 1)));
    Vec3 upright = vec3_add(vec3(0, 0, 1), vec3_scale(side, roll));
    return camera_look_at(eye, target, upright, path->fov_x_rad, width, height);
}
