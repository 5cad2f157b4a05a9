#include "splat3d/ray_light.h"

#include "lab/base/fail.h"
#include "lab/base/interrupt.h"
#include "lab/base/mem.h"
#include "lab/base/parallel.h"
#include "lab/base/progress.h"
#include "lab/base/rng.h"
#include "splat3d/ray_shapes.h"
#include "splat3d/ray_surface.h"

#include <string.h>

static const double PI = 3.14159265358979323846;

enum {
    BLOCK = 256,           // vertices handed to a thread at a time
    BLOCKS_PER_ROUND = 64, // between two looks at the progress and at Ctrl-C
    SUN_RAYS = 4,
    SMOOTHINGS = 3,    // of gathered light
    PASSES = 3,        // direct light, and two times what bounced
    LIGHT_KIND = 1000, // of random numbers, beyond the kinds that layouts use
};

typedef struct {
    RayScene *scene;
    int quality;
    uint64_t seed;
    int *triangle;     // (V) one of those that a vertex belongs to
    Vec3 *mean_albedo; // (materials)
    float *lamps;      // (V,3) light straight from lamps
    float *source;     // (V,3) light that surfaces hand on: lamps, sun, and what was gathered in the round before
    float *sun;        // (V,3)
    int pass;          // 0: direct light; 1, 2: gathering
    int first_block;
} Bake;

static void store(float *values, int vertex, Vec3 v) {
    values[3 * vertex] = (float)v.x, values[3 * vertex + 1] = (float)v.y, values[3 * vertex + 2] = (float)v.z;
}

static Vec3 load(const float *values, int vertex) {
    return vec3(values[3 * vertex], values[3 * vertex + 1], values[3 * vertex + 2]);
}

static Vec3 light_of_lamp(const Bake *b, const RayLamp *lamp, Vec3 point, Vec3 normal, bool both_sides, Rng *rng) {
    int n = b->quality / 2 + 1;
    Vec3 facing = vec3_cross(lamp->edge_u, lamp->edge_v);
    double area = vec3_length(facing), sum = 0;
    for (int i = 0; i < n * n; i++) {
        double u = (i % n + rng_uniform(rng)) / n, v = (i / n + rng_uniform(rng)) / n;
        Vec3 on_lamp = vec3_add(lamp->corner, vec3_add(vec3_scale(lamp->edge_u, u), vec3_scale(lamp->edge_v, v)));
        Vec3 way = vec3_sub(on_lamp, point);
        double distance = vec3_length(way);
        Ray ray = {ray_surface_leave(point, normal, way), vec3_scale(way, 1 / distance), 0.999 * distance};
        double here = vec3_dot(normal, ray.direction), there = -vec3_dot(facing, ray.direction) / area;
        if (both_sides) here = 0.5 * fabs(here);
        if (here <= 0 || there <= 0 || ray_bvh_blocked(&b->scene->bvh, &ray)) continue;
        sum += here * there * area / (PI * distance * distance);
    }
    return vec3_scale(lamp->radiance, sum / (n * n));
}

static Vec3 light_of_sun(const Bake *b, Vec3 point, Vec3 normal, bool both_sides, Rng *rng) {
    const RaySun *sun = &b->scene->sun;
    RayFrame frame = ray_frame_along(vec3(0, 0, 0), sun->direction);
    double sum = 0;
    for (int i = 0; i < SUN_RAYS; i++) {
        double r = tan(sun->radius_rad) * sqrt((i + rng_uniform(rng)) / SUN_RAYS), angle = 2 * PI * rng_uniform(rng);
        Vec3 to_sun = vec3_normalize(ray_frame_point(&frame, r * cos(angle), r * sin(angle), 1));
        double facing = vec3_dot(normal, to_sun);
        if (both_sides) facing = 0.5 * fabs(facing);
        if (facing <= 0) continue;
        Ray ray = {ray_surface_leave(point, normal, to_sun), to_sun, 1e9};
        if (!ray_bvh_blocked(&b->scene->bvh, &ray)) sum += facing / SUN_RAYS;
    }
    return vec3_scale(sun->light, sum);
}

// What arrives from one direction: the sky, or what the surface there hands on.
static Vec3 light_from(const Bake *b, const Ray *ray) {
    RayHit hit;
    const RayScene *s = b->scene;
    if (!ray_bvh_nearest(&s->bvh, ray, &hit)) return ray_sky_radiance(&s->sky, &s->sun, ray->direction, false);
    Vec3 albedo = b->mean_albedo[s->mesh.material[hit.triangle]];
    return vec3_mul(albedo, ray_surface_light(&s->mesh, &hit, b->source));
}

// Mean over directions that are dense where the surface faces them (cosine-weighted), one in each part of the hemisphere.
static Vec3 gather(const Bake *b, Vec3 point, Vec3 normal, bool both_sides, Rng *rng) {
    int rings = b->quality, sectors = 2 * b->quality;
    if (both_sides || b->pass < PASSES - 1)
        rings /= 2, sectors /= 2; // leaves are many; the first bounce is seen in the second
    RayFrame frame = ray_frame_along(point, normal);
    Vec3 sum = {0, 0, 0};
    for (int i = 0; i < rings * sectors; i++) {
        double r2 = (i / sectors + rng_uniform(rng)) / rings;
        double angle = 2 * PI * (i % sectors + rng_uniform(rng)) / sectors, r = sqrt(r2), z = sqrt(1 - r2);
        if (both_sides && (i & 1)) z = -z;
        Vec3 direction = vec3_sub(ray_frame_point(&frame, r * cos(angle), r * sin(angle), z), point);
        Ray ray = {ray_surface_leave(point, normal, direction), direction, 1e9};
        sum = vec3_add(sum, light_from(b, &ray));
    }
    return vec3_scale(sum, 1.0 / (rings * sectors));
}

// Where the light of a vertex is measured: a little inside the triangle, because in the corner of a room the vertex itself
// stands on two walls, and half of its rays would leave through the other one.
static Vec3 place_of(const RayMesh *mesh, int triangle, int vertex) {
    Vec3 middle = {0, 0, 0};
    for (int k = 0; k < 3; k++)
        middle = vec3_add(middle, vec3_scale(ray_mesh_position(mesh, mesh->corner[3 * triangle + k]), 1 / 3.0));
    return vec3_lerp(ray_mesh_position(mesh, vertex), middle, 0.05);
}

static void bake_vertex(Bake *b, int vertex) {
    RayScene *s = b->scene;
    if (s->mesh.light_from[vertex] != vertex) return;
    Vec3 point = place_of(&s->mesh, b->triangle[vertex], vertex), normal = ray_mesh_normal(&s->mesh, vertex);
    bool both_sides = s->material[s->mesh.material[b->triangle[vertex]]].translucency > 0;
    Rng rng = rng_at(b->seed, RNG_SCENE_LAYOUT, (uint32_t)(LIGHT_KIND + b->pass), (uint32_t)vertex);
    if (b->pass > 0) {
        store(s->mesh.light, vertex, gather(b, point, normal, both_sides, &rng));
        return;
    }
    Vec3 lamps = {0, 0, 0}, sun = {0, 0, 0};
    for (int i = 0; i < s->lamp_count; i++)
        lamps = vec3_add(lamps, light_of_lamp(b, &s->lamp[i], point, normal, both_sides, &rng));
    if (vec3_length(s->sun.direction) > 0) sun = light_of_sun(b, point, normal, both_sides, &rng);
    store(b->lamps, vertex, lamps);
    store(b->sun, vertex, sun);
}

static void bake_block(void *context, int index) {
    Bake *b = context;
    int first = (b->first_block + index) * BLOCK;
    for (int i = first; i < first + BLOCK && i < b->scene->mesh.vertex_count; i++) bake_vertex(b, i);
}

// One pass over all vertices.
static bool bake_pass(Bake *b, Progress *progress) {
    int blocks = (b->scene->mesh.vertex_count + BLOCK - 1) / BLOCK;
    for (b->first_block = 0; b->first_block < blocks; b->first_block += BLOCKS_PER_ROUND) {
        if (interrupt_requested()) return fail("stopped while the light was computed; nothing was written");
        int left = blocks - b->first_block;
        parallel_for(left < BLOCKS_PER_ROUND ? left : BLOCKS_PER_ROUND, bake_block, b);
        progress_update(progress, (long)b->pass * blocks + b->first_block, NULL);
    }
    return true;
}

// The next round's source: direct light and what was gathered in this one.
static void collect(Bake *b) {
    RayMesh *mesh = &b->scene->mesh;
    for (int i = 0; i < mesh->vertex_count; i++) {
        int from = mesh->light_from[i];
        Vec3 direct = vec3_add(load(b->lamps, from), load(b->sun, from));
        store(b->source, i, vec3_add(direct, load(mesh->light, from)));
    }
}

// Evens out the grain of sampling: each vertex halfway towards the mean of those it shares an edge with. Sharp edges of a shape have
// vertices of their own on either side, so light does not creep round them.
static void smooth(const RayMesh *mesh, float *light) {
    size_t values = 3 * (size_t)mesh->vertex_count;
    float *sum = mem_alloc(values, sizeof(float));
    int *edges = mem_alloc((size_t)mesh->vertex_count, sizeof(int));
    for (int i = 0; i < 3 * mesh->triangle_count; i++) {
        int a = mesh->corner[i], b = mesh->corner[i % 3 == 2 ? i - 2 : i + 1];
        for (int k = 0; k < 3; k++) {
            sum[3 * a + k] += light[3 * b + k];
            sum[3 * b + k] += light[3 * a + k];
        }
        edges[a]++, edges[b]++;
    }
    for (size_t i = 0; i < values; i++)
        if (edges[i / 3] > 0) light[i] = 0.5f * (light[i] + sum[i] / (float)edges[i / 3]);
    mem_free(sum);
    mem_free(edges);
}

bool ray_light_store(RayScene *scene, int quality, uint64_t seed) {
    size_t vertices = (size_t)scene->mesh.vertex_count;
    Bake b = {.scene = scene, .quality = quality, .seed = seed};
    b.triangle = mem_alloc(vertices, sizeof(int));
    b.mean_albedo = mem_alloc((size_t)scene->material_count, sizeof(Vec3));
    b.lamps = mem_alloc(3 * vertices, sizeof(float));
    b.sun = mem_alloc(3 * vertices, sizeof(float));
    b.source = mem_alloc(3 * vertices, sizeof(float));
    memset(scene->mesh.light, 0, 3 * vertices * sizeof(float));
    for (int i = 0; i < scene->material_count; i++) b.mean_albedo[i] = ray_scene_mean_albedo(scene, i);
    for (int i = 0; i < 3 * scene->mesh.triangle_count; i++) b.triangle[scene->mesh.corner[i]] = i / 3;
    Progress progress = progress_begin("light", 0, PASSES * (long)((vertices + BLOCK - 1) / BLOCK));
    bool ok = true;
    for (b.pass = 0; ok && b.pass < PASSES; b.pass++) {
        ok = bake_pass(&b, &progress);
        if (b.pass < PASSES - 1) collect(&b);
    }
    RayMesh *mesh = &scene->mesh;
    for (int i = 0; i < mesh->vertex_count; i++) store(mesh->light, i, load(mesh->light, mesh->light_from[i]));
    for (int i = 0; i < SMOOTHINGS; i++) smooth(mesh, mesh->light);
    for (int i = 0; i < mesh->vertex_count; i++)
        store(mesh->light, i, vec3_add(load(mesh->light, i), load(b.lamps, mesh->light_from[i])));
    progress_end(&progress, NULL);
    mem_free(b.triangle);
    mem_free(b.mean_albedo);
    mem_free(b.lamps);
    mem_free(b.sun);
    mem_free(b.source);
    return ok;
}
