#include "tests/support/random_scene.h"

#include "lab/base/rng.h"

#include <math.h>

RandomScene random_scene_default(uint64_t seed) {
    return (RandomScene){
        .seed = seed,
        .count = 300,
        .sh_degree = 3,
        .size_px = 4,
        .spread = 0.7,
        .logit_low = -3,
        .logit_high = 3,
        .outside = 1.2,
    };
}

Camera random_scene_camera(uint64_t seed, int width, int height) {
    Rng rng = rng_at(seed, RNG_TEST, 1, 0);
    Vec3 eye = vec3(rng_range(&rng, -2, 2), rng_range(&rng, -2, 2), rng_range(&rng, -2, 2));
    Vec3 away = vec3(rng_normal(&rng), rng_normal(&rng), rng_normal(&rng));
    Camera camera = camera_look_at(eye, vec3_add(eye, away), vec3(0.1, -1, 0.2), 1.0, width, height);
    camera.cx += 0.07 * width;
    camera.cy -= 0.05 * height;
    camera.fy *= 1.03;
    return camera;
}

Gaussians random_scene_gaussians(const RandomScene *scene, const Camera *camera) {
    Gaussians g = gaussians_create(scene->count, scene->sh_degree);
    const Mat3 to_world = mat3_transpose(&camera->rotation);
    for (int i = 0; i < g.count; i++) {
        Rng rng = rng_at(scene->seed, RNG_TEST, 2, (uint32_t)i);
        const double z = i % 16 == 15 ? rng_range(&rng, -2, 0.5) : rng_range(&rng, 1, 8);
        const double x = (0.5 + 0.5 * scene->outside * rng_range(&rng, -1, 1)) * camera->width;
        const double y = (0.5 + 0.5 * scene->outside * rng_range(&rng, -1, 1)) * camera->height;
        const Vec3 point = vec3((x - camera->cx) / camera->fx * z, (y - camera->cy) / camera->fy * z, z);
        const Vec3 world = mat3_apply(&to_world, vec3_sub(point, camera->translation));
        const double size = scene->size_px * fabs(z) / camera->fx;
        float *mean = gaussians_at(&g, FIELD_MEAN, i);
        mean[0] = (float)world.x, mean[1] = (float)world.y, mean[2] = (float)world.z;
        for (int k = 0; k < 3; k++)
            gaussians_at(&g, FIELD_LOG_SCALE, i)[k] = (float)(log(size) + scene->spread * rng_normal(&rng));
        for (int k = 0; k < 4; k++) gaussians_at(&g, FIELD_QUAT, i)[k] = (float)rng_normal(&rng);
        *gaussians_at(&g, FIELD_OPACITY_LOGIT, i) = (float)rng_range(&rng, scene->logit_low, scene->logit_high);
        for (int id = FIELD_SH0; id < FIELD_COUNT; id++)
            for (int k = 0; g.field[id] && k < GAUSSIAN_FIELDS[id].width; k++)
                gaussians_at(&g, id, i)[k] = (float)(rng_normal(&rng) * (id == FIELD_SH0 ? 1.0 : 0.3));
    }
    return g;
}

void random_scene_values(uint64_t seed, float *values, size_t count) {
    Rng rng = rng_at(seed, RNG_TEST, 3, 0);
    for (size_t k = 0; k < count; k++) values[k] = (float)rng_range(&rng, -1, 1);
}
