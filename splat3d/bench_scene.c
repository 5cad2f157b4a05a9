#include "splat3d/bench_scene.h"

#include "lab/base/rng.h"

#include <math.h>

static const double SIGMA_MEDIAN_PX = 3, SIGMA_MAX_PX = 50, LN_SIGMA_DEVIATION = 0.75, LN_RATIO_DEVIATION = 0.6;
static const double DEPTH_NEAR = 2, DEPTH_FAR = 10; // world units
static const double THICKNESS = 0.05;               // of a splat, as part of its shorter standard deviation
static const double FOV_X_RAD = 60 * M_PI / 180;

Camera bench_scene_camera(int width, int height) {
    return camera_look_at(vec3(0, 0, 0), vec3(0, 0, 1), vec3(0, -1, 0), FOV_X_RAD, width, height);
}

static void set_colour(Gaussians *g, int i, Rng *rng) {
    for (GaussianFieldId id = FIELD_SH0; id < FIELD_COUNT; id++)
        for (int k = 0; k < GAUSSIAN_FIELDS[id].width; k++)
            gaussians_at(g, id, i)[k] = (float)(id == FIELD_SH0 ? rng_range(rng, -1.7, 1.7) : 0.05 * rng_normal(rng));
}

Gaussians bench_scene_gaussians(uint64_t seed, int count, const Camera *camera) {
    Gaussians g = gaussians_create(count, SH_DEGREE_MAX);
    for (int i = 0; i < count; i++) {
        Rng rng = rng_at(seed, RNG_BENCH, (uint32_t)i, 0);
        const double x = rng_range(&rng, 0, camera->width), y = rng_range(&rng, 0, camera->height);
        const double z = rng_range(&rng, DEPTH_NEAR, DEPTH_FAR), angle_rad = rng_range(&rng, 0, M_PI);
        const double opacity = rng_range(&rng, 0.05, 0.95);
        const double sigma = fmin(SIGMA_MEDIAN_PX * exp(LN_SIGMA_DEVIATION * rng_normal(&rng)), SIGMA_MAX_PX);
        const double shorter = sigma * exp(-fabs(LN_RATIO_DEVIATION * rng_normal(&rng)));
        float *mean = gaussians_at(&g, FIELD_MEAN, i), *log_scale = gaussians_at(&g, FIELD_LOG_SCALE, i);
        float *quat = gaussians_at(&g, FIELD_QUAT, i);
        mean[0] = (float)((x - camera->cx) / camera->fx * z);
        mean[1] = (float)((y - camera->cy) / camera->fy * z);
        mean[2] = (float)z;
        log_scale[0] = (float)log(sigma * z / camera->fx);
        log_scale[1] = (float)log(shorter * z / camera->fx);
        log_scale[2] = (float)log(THICKNESS * shorter * z / camera->fx);
        quat[0] = (float)cos(angle_rad / 2);
        quat[3] = (float)sin(angle_rad / 2);
        *gaussians_at(&g, FIELD_OPACITY_LOGIT, i) = (float)log(opacity / (1 - opacity));
        set_colour(&g, i, &rng);
    }
    return g;
}

Image8 bench_scene_photo(uint64_t seed, int width, int height) {
    Image8 photo = image8_create(width, height, 3);
    for (int y = 0; y < height; y++) {
        Rng rng = rng_at(seed, RNG_BENCH, UINT32_MAX, (uint32_t)y);
        for (int k = 0; k < 3 * width; k++) photo.bytes[3 * y * width + k] = (uint8_t)rng_u32(&rng);
    }
    return photo;
}
