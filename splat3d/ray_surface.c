#include "splat3d/ray_surface.h"

#include "splat3d/ray_noise.h"

static Vec3 blend(const float *values, const int corner[3], const double weight[3]) {
    double out[3] = {0, 0, 0};
    for (int k = 0; k < 3; k++)
        for (int c = 0; c < 3; c++) out[c] += weight[k] * values[3 * corner[k] + c];
    return vec3(out[0], out[1], out[2]);
}

static void weights(const RayHit *hit, double weight[3]) {
    weight[0] = 1 - hit->b1 - hit->b2;
    weight[1] = hit->b1;
    weight[2] = hit->b2;
}

Vec3 ray_surface_light(const RayMesh *mesh, const RayHit *hit, const float *light) {
    double weight[3];
    weights(hit, weight);
    return blend(light, mesh->corner + 3 * hit->triangle, weight);
}

Vec3 ray_surface_leave(Vec3 point, Vec3 normal, Vec3 direction) {
    double off = 2e-4 + 2e-6 * (fabs(point.x) + fabs(point.y) + fabs(point.z));
    return vec3_add(point, vec3_scale(normal, vec3_dot(normal, direction) < 0 ? -off : off));
}

// How texture coordinates change along the triangle: (u, v) at p + e is (u + u_per . e, v + v_per . e).
typedef struct {
    Vec3 u_per, v_per;
} Chart;

static Chart chart_of(const RayMesh *mesh, const int corner[3], Vec3 edge1, Vec3 edge2, Vec3 cross) {
    const float *a = mesh->uv + 2 * corner[0], *b = mesh->uv + 2 * corner[1], *c = mesh->uv + 2 * corner[2];
    double scale = 1 / vec3_dot(cross, cross);
    Vec3 b1_per = vec3_scale(vec3_cross(edge2, cross), scale), b2_per = vec3_scale(vec3_cross(cross, edge1), scale);
    return (Chart){vec3_add(vec3_scale(b1_per, b[0] - a[0]), vec3_scale(b2_per, c[0] - a[0])),
                   vec3_add(vec3_scale(b1_per, b[1] - a[1]), vec3_scale(b2_per, c[1] - a[1]))};
}

// Bends the normal down the slope of the texture's height, which is measured here and one step away in two directions.
static Vec3 bend_normal(const RayTexture *texture, const Chart *chart, Vec3 normal, double u, double v, double width,
                        double relief) {
    double steepest = fmax(vec3_length(chart->u_per), vec3_length(chart->v_per));
    double step = fmax(width, 1 / (texture->size * fmax(steepest, 1e-6)));
    Vec3 side = fabs(normal.z) < 0.9 ? vec3(0, 0, 1) : vec3(1, 0, 0);
    Vec3 a = vec3_normalize(vec3_cross(side, normal)), b = vec3_cross(normal, a), bent = normal;
    double here = ray_texture_height(texture, u, v, step * steepest);
    for (int k = 0; k < 2; k++) {
        Vec3 axis = k ? b : a;
        double du = step * vec3_dot(chart->u_per, axis), dv = step * vec3_dot(chart->v_per, axis);
        double slope = (ray_texture_height(texture, u + du, v + dv, step * steepest) - here) * relief / step;
        bent = vec3_sub(bent, vec3_scale(axis, slope));
    }
    return vec3_normalize(bent);
}

// Albedo, and the normal bent by relief.
static void read_texture(const RayScene *scene, const RayMaterial *m, const Chart *chart, const int corner[3],
                         const double weight[3], Vec3 direction, double width, RaySurfacePoint *point) {
    const RayTexture *texture = &scene->texture[m->texture];
    double u = 0, v = 0, cosine = fmax(fabs(vec3_dot(direction, point->flat_normal)), 0.02);
    for (int k = 0; k < 3; k++) {
        u += weight[k] * scene->mesh.uv[2 * corner[k]];
        v += weight[k] * scene->mesh.uv[2 * corner[k] + 1];
    }
    Vec3 across = vec3_normalize(vec3_cross(direction, point->flat_normal));
    Vec3 away = vec3_scale(vec3_cross(point->flat_normal, across), width / cosine);
    across = vec3_scale(across, width);
    RayFootprint footprint = {vec3_dot(chart->u_per, away), vec3_dot(chart->v_per, away),
                              vec3_dot(chart->u_per, across), vec3_dot(chart->v_per, across)};
    RayTexel texel = ray_texture_read(texture, u, v, footprint);
    point->albedo = vec3_mul(texel.colour, m->tint);
    if (m->relief > 0) point->normal = bend_normal(texture, chart, point->normal, u, v, width, m->relief);
}

RaySurfacePoint ray_surface_at(const RayScene *scene, const Ray *ray, const RayHit *hit, double width) {
    const RayMesh *mesh = &scene->mesh;
    const int *corner = mesh->corner + 3 * hit->triangle;
    double weight[3];
    weights(hit, weight);
    Vec3 a = ray_mesh_position(mesh, corner[0]);
    Vec3 edge1 = vec3_sub(ray_mesh_position(mesh, corner[1]), a),
         edge2 = vec3_sub(ray_mesh_position(mesh, corner[2]), a);
    Vec3 cross = vec3_cross(edge1, edge2);
    RaySurfacePoint p = {.material = mesh->material[hit->triangle]};
    const RayMaterial *m = &scene->material[p.material];
    p.position = vec3_add(a, vec3_add(vec3_scale(edge1, hit->b1), vec3_scale(edge2, hit->b2)));
    p.flat_normal = vec3_normalize(cross);
    p.smooth_normal = vec3_normalize(blend(mesh->normal, corner, weight));
    if (vec3_dot(p.flat_normal, ray->direction) > 0) p.flat_normal = vec3_scale(p.flat_normal, -1);
    if (vec3_dot(p.smooth_normal, p.flat_normal) < 0) p.smooth_normal = vec3_scale(p.smooth_normal, -1);
    p.normal = p.smooth_normal;
    p.light = blend(mesh->light, corner, weight);
    p.albedo = m->tint;
    if (m->texture >= 0) {
        Chart chart = chart_of(mesh, corner, edge1, edge2, cross);
        read_texture(scene, m, &chart, corner, weight, ray->direction, width, &p);
    }
    return p;
}
