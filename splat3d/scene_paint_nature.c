#include "splat3d/ray_noise.h"
#include "splat3d/scene_paint.h"

#include <stddef.h>

static const double PI = 3.14159265358979323846;

static double from_srgb(uint32_t byte) {
    double x = (byte & 255) / 255.0;
    return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4);
}

Vec3 paint_colour(uint32_t rgb) { return vec3(from_srgb(rgb >> 16), from_srgb(rgb >> 8), from_srgb(rgb)); }

RayTexel paint_planks(const void *context, double u, double v) {
    const Paint *p = context;
    int plank = (int)(v * p->count);
    double across = v * p->count - plank, shift = noise_cell(plank, 0, 0, p->seed);
    double along = u + shift, end = along - floor(along);
    double tone = noise_cell(plank, (int)floor(along), 1, p->seed);
    double bend = 0.5 * noise_gradient(vec3(4 * u, 3 * v, plank), 4, p->seed + 3);
    double ring = noise_gradient(vec3(3 * u, 0, 3.5 * across + bend + 31.7 * plank), 3, p->seed + 1);
    double year = 0.5 + 0.5 * sin(2 * PI * (7 * ring + 2 * across));
    double fibre = noise_gradient(vec3(16 * u, 0, 40 * across + 3 * bend + 17 * plank), 16, p->seed + 2);
    double pores = noise_gradient(vec3(48 * u, 0, 90 * across + 9 * plank), 48, p->seed + 5);
    double darkness = 0.45 * year * year + 0.35 * fibre + 0.45 * (tone - 0.5) + 0.3;
    Vec3 wood = vec3_lerp(p->base, p->second, fmin(fmax(darkness, 0), 1));
    wood = vec3_scale(wood, 1 - 0.55 * noise_step(0.25, 0.5, pores));
    double edge = fmin(fmin(across, 1 - across), 6 * fmin(end, 1 - end));
    double joint = noise_step(0.008, 0.035, edge);
    return (RayTexel){vec3_lerp(p->accent, wood, joint), joint * (0.9 + 0.1 * fibre)};
}

RayTexel paint_marble(const void *context, double u, double v) {
    const Paint *p = context;
    double ring = cos(PI * (v - 0.5));
    Vec3 q = vec3_scale(vec3(ring * cos(2 * PI * u), ring * sin(2 * PI * u), sin(PI * (v - 0.5))), 1.3);
    Vec3 bend = vec3(noise_fbm(q, 0, 4, p->seed), noise_fbm(q, 0, 4, p->seed + 10), noise_fbm(q, 0, 4, p->seed + 20));
    Vec3 bent = vec3_add(q, vec3_scale(bend, 1.1));
    double vein = 1 - fabs(noise_fbm(bent, 0, 5, p->seed + 30)),
           thin = 1 - fabs(noise_fbm(vec3_scale(bent, 2.3), 0, 4, p->seed + 50));
    double cloud = 0.5 + noise_fbm(vec3_scale(q, 1.7), 0, 5, p->seed + 40);
    Vec3 stone = vec3_lerp(p->base, p->second, 0.5 * fmin(fmax(cloud, 0), 1));
    stone = vec3_lerp(stone, p->second, noise_step(0.86, 0.995, vein));
    return (RayTexel){vec3_lerp(stone, p->accent, 0.8 * noise_step(0.92, 1, thin)), 0};
}

RayTexel paint_granite(const void *context, double u, double v) {
    const Paint *p = context;
    uint32_t grain;
    noise_cells(64 * u, 64 * v, 64, p->seed, NULL, &grain);
    double speckle = (grain >> 8 & 255) / 255.0, stain = noise_fbm(vec3(5 * u, 5 * v, 2), 5, 5, p->seed + 1);
    Vec3 stone = vec3_lerp(p->base, p->second, fmin(fmax(0.5 + 0.9 * stain, 0), 1));
    stone = vec3_scale(stone, 0.72 + 0.45 * speckle);
    if (speckle > 0.9) stone = vec3_lerp(stone, p->accent, 0.6);
    return (RayTexel){stone, 0.5 + 0.4 * stain + 0.1 * speckle};
}

RayTexel paint_grass(const void *context, double u, double v) {
    const Paint *p = context;
    double patch = 0.5 + 0.8 * noise_fbm(vec3(4 * u, 4 * v, 0), 4, 5, p->seed);
    double blades = 0, gap;
    uint32_t id;
    for (int layer = 0; layer < 2; layer++) { // thin cells in two directions look like blades lying across each other
        double a = layer ? u : v, b = layer ? v : u;
        double bend = 0.6 * noise_gradient(vec3(16 * u, 16 * v, layer), 16, p->seed + 7);
        noise_cells(32 * b + bend, 96 * a + 2 * bend, 0, p->seed + (uint32_t)layer, &gap, &id);
        blades += 0.5 * (id >> 9 & 255) / 255.0 * noise_step(0, 0.25, gap);
    }
    Vec3 green = vec3_lerp(p->base, p->second, fmin(fmax(0.6 * blades + 0.5 * patch, 0), 1));
    double bare = noise_step(0.85, 1.15, patch + 0.25 * blades);
    return (RayTexel){vec3_scale(vec3_lerp(green, p->accent, bare), 0.45 + 0.75 * blades), blades};
}

RayTexel paint_gravel(const void *context, double u, double v) {
    const Paint *p = context;
    double gap, tone = 0, height = 0, rough = noise_fbm(vec3(64 * u, 64 * v, 0), 64, 3, p->seed + 4);
    uint32_t id;
    double bend = 0.25 * noise_gradient(vec3(24 * u, 24 * v, 0), 24, p->seed + 5);
    noise_cells(p->count * u + bend, p->count * v + bend, p->count, p->seed, &gap, &id);
    tone = (id >> 8 & 255) / 255.0, height = noise_step(0, 0.4, gap);
    Vec3 stone = id & 1 ? vec3_lerp(p->base, p->second, tone) : vec3_lerp(p->base, p->accent, tone);
    return (RayTexel){vec3_scale(stone, (0.25 + 0.75 * height) * (0.95 + 0.35 * rough)), height};
}

RayTexel paint_leaf(const void *context, double u, double v) {
    const Paint *p = context;
    double side = fabs(u - 0.5), rib = 1 - noise_step(0.015, 0.05, side);
    double branch = 1 - noise_step(0.06, 0.2, fabs(sin(PI * (9 * v - 7 * side))));
    double spots = 0.5 + noise_fbm(vec3(7 * u, 7 * v, p->seed), 0, 4, p->seed);
    Vec3 green = vec3_lerp(p->base, p->second, fmin(fmax(spots, 0), 1));
    return (RayTexel){vec3_lerp(green, p->accent, fmin(rib + 0.45 * branch, 1) * 0.55), 0.5};
}

RayTexel paint_bark(const void *context, double u, double v) {
    const Paint *p = context;
    double bend = noise_gradient(vec3(6 * u, 6 * v, 0), 6, p->seed + 1);
    double ridge = noise_fbm(vec3(16 * u + bend, 4 * v + 0.5 * bend, 0), 0, 5, p->seed);
    double height = noise_step(-0.45, 0.45, ridge);
    double moss = noise_step(0.15, 0.6, noise_fbm(vec3(3 * u, 3 * v, 8), 3, 5, p->seed + 20));
    Vec3 bark = vec3_lerp(p->base, p->second, height);
    return (RayTexel){vec3_lerp(bark, p->accent, 0.5 * moss), height};
}

RayTexel paint_peel(const void *context, double u, double v) {
    const Paint *p = context;
    double gap;
    double dimple = noise_cells(40 * u, 24 * v, 0, p->seed, &gap, NULL);
    double ring = cos(PI * (v - 0.5));
    Vec3 q = vec3(2 * ring * cos(2 * PI * u), 2 * ring * sin(2 * PI * u), 2 * sin(PI * (v - 0.5)));
    double blush = noise_step(-0.5, 0.6, noise_fbm(q, 0, 5, p->seed + 1));
    Vec3 peel = vec3_lerp(p->base, p->second, blush);
    double stalk = 1 - noise_step(0.02, 0.06, 1 - v);
    return (RayTexel){vec3_lerp(vec3_scale(peel, 0.85 + 0.25 * noise_step(0.1, 0.5, dimple)), p->accent, stalk),
                      noise_step(0.05, 0.5, dimple)};
}

RayTexel paint_forest(const void *context, double u, double v) {
    const Paint *p = context;
    double field = noise_fbm(vec3(4 * u, 4 * v, 0), 4, 3, p->seed), gap;
    uint32_t id;
    noise_cells(4 * u + 0.3 * field, 6 * v + 0.3 * field, 0, p->seed + 9, NULL, &id);
    double crown = noise_cells(48 * u, 48 * v, 48, p->seed + 1, &gap, NULL);
    double wood = noise_step(-0.05, 0.05, field + 0.05 * crown);
    Vec3 trees = vec3_scale(p->base, 1.5 - 1.4 * fmin(crown, 0.9));
    double stripes = 0.85 + 0.3 * noise_gradient(vec3(8 * u, 60 * v, 0), 0, p->seed + 5);
    Vec3 meadow = vec3_scale(id & 64 ? p->second : p->accent, stripes * (0.8 + 0.4 * (id >> 8 & 255) / 255.0));
    return (RayTexel){vec3_lerp(meadow, trees, wood), wood * (1 - crown)};
}

RayTexel paint_water(const void *context, double u, double v) {
    const Paint *p = context;
    return (RayTexel){p->base, 0.5 + 0.5 * noise_fbm(vec3(8 * u, 8 * v, 0), 8, 4, p->seed)};
}
