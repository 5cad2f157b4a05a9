#include "splat3d/ray_noise.h"
#include "splat3d/scene_paint.h"

#include <stdbool.h>

static const double PI = 3.14159265358979323846;

static double clamp01(double x) { return fmin(fmax(x, 0), 1); }

// Rows of blocks, every other row shifted by half a block: which block, how far from its border (in row heights), a random tone.
typedef struct {
    double edge, tone, hue;
} Course;

static Course course_at(double u, double v, int rows, int blocks, uint32_t seed) {
    int row = (int)floor(v * rows);
    double along = u * blocks + (row & 1 ? 0.5 : 0), y = v * rows - row;
    int block = (int)floor(along) % blocks;
    double x = along - floor(along), wide = (double)rows / blocks;
    Course c = {fmin(fmin(x, 1 - x) * wide, fmin(y, 1 - y)), noise_cell(block, row, 0, seed),
                noise_cell(block, row, 1, seed)};
    return c;
}

RayTexel paint_brick(const void *context, double u, double v) {
    const Paint *p = context;
    double rough = noise_fbm(vec3(40 * u, 40 * v, 0), 40, 4, p->seed + 2);
    double stain = noise_fbm(vec3(3 * u, 3 * v, 4), 3, 5, p->seed + 3);
    Course c = course_at(u, v, p->count, p->count / 3, p->seed);
    double face = noise_step(0.06, 0.15, c.edge + 0.06 * rough);
    Vec3 brick = vec3_lerp(p->base, p->second, clamp01(1.2 * c.tone - 0.2 + 0.3 * rough));
    brick = vec3_scale(brick, (0.75 + 0.45 * c.hue) * (1 + 0.45 * rough));
    Vec3 mortar = vec3_scale(p->accent, 0.85 + 0.5 * rough);
    return (RayTexel){vec3_scale(vec3_lerp(mortar, brick, face), 1 + 0.3 * stain), face * (0.85 + 0.15 * rough)};
}

static RayTexel stone_texel(const Paint *p, double face, double tone, double u, double v) {
    double rough = noise_fbm(vec3(40 * u, 40 * v, 0), 40, 4, p->seed + 5);
    double stain = noise_fbm(vec3(3 * u, 3 * v, 1), 3, 4, p->seed + 6);
    Vec3 stone = vec3_scale(vec3_lerp(p->base, p->second, clamp01(tone + 0.4 * rough)), 1 + 0.4 * rough + 0.3 * stain);
    double moss = noise_step(0.05, 0.4, stain + 0.3 * rough) * (1 - 0.6 * face);
    Vec3 joint = vec3_lerp(vec3_scale(p->accent, 0.8 + 0.4 * rough), vec3(0.06, 0.09, 0.03), moss);
    return (RayTexel){vec3_lerp(joint, stone, face), face * (0.8 + 0.2 * rough)};
}

RayTexel paint_paving(const void *context, double u, double v) {
    const Paint *p = context;
    double bend = 0.006 * noise_gradient(vec3(20 * u, 20 * v, 0), 20, p->seed + 1);
    Course c = course_at(u, v + bend, p->count, 2 * p->count, p->seed);
    return stone_texel(p, noise_step(0.02, 0.07, c.edge), c.tone, u, v);
}

RayTexel paint_cobble(const void *context, double u, double v) {
    const Paint *p = context;
    double gap, bend = 0.12 * noise_gradient(vec3(16 * u, 16 * v, 0), 16, p->seed + 1);
    uint32_t id;
    noise_cells(p->count * u + bend, p->count * v - bend, p->count, p->seed, &gap, &id);
    return stone_texel(p, noise_step(0.03, 0.18, gap), (id >> 8 & 255) / 255.0, u, v);
}

RayTexel paint_plaster(const void *context, double u, double v) {
    const Paint *p = context;
    double rough = noise_fbm(vec3(48 * u, 48 * v, 0), 48, 4, p->seed),
           stain = noise_fbm(vec3(4 * u, 2 * v, 2), 4, 6, p->seed + 5);
    double crack = 1 - fabs(noise_fbm(vec3(4 * u, 4 * v, 8), 4, 5, p->seed + 9));
    double bare = noise_step(0.32, 0.4, stain + 0.1 * rough);
    Vec3 wall = vec3_scale(p->base, 1 + 0.35 * rough + 0.35 * stain);
    wall = vec3_scale(vec3_lerp(wall, p->second, bare), 1 - 0.4 * noise_step(0.975, 0.995, crack));
    return (RayTexel){wall, 0.5 + 0.35 * rough - 0.2 * bare};
}

RayTexel paint_roof(const void *context, double u, double v) {
    const Paint *p = context;
    int row = (int)floor(v * p->count);
    double along = 1.6 * p->count * u + (row & 1 ? 0.5 : 0), y = v * p->count - row, x = along - floor(along);
    double lower = 0.25 - 0.22 * sin(PI * x); // tiles end in a curve
    int shown = y < lower ? row - 1 : row;
    double tone = noise_cell((int)floor(along) % 512, shown, 0, p->seed),
           rough = noise_fbm(vec3(40 * u, 40 * v, 0), 40, 4, p->seed);
    double shade = noise_step(0, 0.18, fabs(y - lower)) * (0.75 + 0.25 * sin(PI * x));
    Vec3 tile = vec3_lerp(p->base, p->second, tone);
    double moss = noise_step(0.15, 0.5, noise_fbm(vec3(3 * u, 3 * v, 3), 3, 4, p->seed + 3) + 0.3 * rough);
    tile = vec3_lerp(tile, p->accent, 0.6 * moss);
    return (RayTexel){vec3_scale(tile, (0.35 + 0.65 * shade) * (1 + 0.4 * rough)), shade};
}

RayTexel paint_terracotta(const void *context, double u, double v) {
    const Paint *p = context;
    double groove = noise_gradient(vec3(2 * u, 0, 30 * v), 2, p->seed),
           rough = noise_fbm(vec3(32 * u, 32 * v, 0), 32, 4, p->seed + 1);
    double lime = noise_step(0.1, 0.5, noise_fbm(vec3(3 * u, 3 * v, 2), 3, 5, p->seed + 2));
    Vec3 clay = vec3_scale(p->base, 1 + 0.25 * groove + 0.4 * rough);
    return (RayTexel){vec3_lerp(clay, p->second, 0.55 * lime), 0.5 + 0.4 * groove};
}

RayTexel paint_facade(const void *context, double u, double v) {
    const Paint *p = context;
    double field = u * p->count, x = fabs(field - floor(field) - 0.5), y = v - 0.5;
    double rough = noise_fbm(vec3(40 * u, 40 * v, 0), 40, 4, p->seed),
           stain = noise_fbm(vec3(4 * u, 2 * v, 2), 4, 6, p->seed + 5);
    Vec3 wall = vec3_scale(p->base, 1 + 0.3 * rough + 0.35 * stain);
    Vec3 glass = vec3_scale(vec3(0.05, 0.08, 0.11), 1 + 2 * noise_step(-0.2, 0.4, y + 0.4 * stain));
    Vec3 shutter = vec3_scale(p->second, 0.65 + 0.5 * noise_step(0.1, 0.5, fabs(sin(PI * 24 * v))) + 0.2 * rough);
    bool in_height = fabs(y) < 0.3;
    if (in_height && x > 0.17 && x < 0.33) return (RayTexel){shutter, 0.8};
    if (in_height && x < 0.16) {
        bool frame = x > 0.14 || fabs(y) > 0.275 || x < 0.012 || fabs(y - 0.09) < 0.012;
        return (RayTexel){frame ? vec3_scale(p->accent, 1 + 0.2 * rough) : glass, frame ? 0.4 : 0.2};
    }
    if (x < 0.2 && y < -0.3 && y > -0.345) return (RayTexel){vec3_scale(p->accent, 0.7 + 0.3 * rough), 1};
    if (fabs(y) > 0.47) return (RayTexel){vec3_scale(p->accent, 0.75 + 0.3 * rough), 0.9};
    return (RayTexel){wall, 0.5};
}
