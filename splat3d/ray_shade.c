#include "splat3d/ray_shade.h"

#include "splat3d/ray_shapes.h"
#include "splat3d/ray_surface.h"

static const double PI = 3.14159265358979323846;

enum { BOUNCES = 2 };                          // mirror reflections followed
static const double BRIGHTEST_MIRRORED = 6;    // keeps single rays from making sparkling pixels
static const double FAINTEST_MIRRORED = 0.012; // weaker reflections are not traced
static const double SATIN = 0.2;               // rougher coats mirror the light around them, without a picture

double ray_luminance(Vec3 colour) { return 0.2126 * colour.x + 0.7152 * colour.y + 0.0722 * colour.z; }

// Distance along the ray to the shining side of the lamp, or 0.
static double hit_lamp(const RayLamp *lamp, const Ray *ray) {
    Vec3 facing = vec3_cross(lamp->edge_u, lamp->edge_v);
    double towards = vec3_dot(facing, ray->direction);
    if (towards >= 0) return 0;
    double distance = vec3_dot(facing, vec3_sub(lamp->corner, ray->origin)) / towards;
    Vec3 p = vec3_sub(vec3_add(ray->origin, vec3_scale(ray->direction, distance)), lamp->corner);
    double u = vec3_dot(p, lamp->edge_u) / vec3_dot(lamp->edge_u, lamp->edge_u);
    double v = vec3_dot(p, lamp->edge_v) / vec3_dot(lamp->edge_v, lamp->edge_v);
    return distance > 0 && u >= 0 && u <= 1 && v >= 0 && v <= 1 ? distance : 0;
}

// What the sun adds: diffuse light, light through leaves, and the highlight of a clear coat (Blinn, "Models of light reflection for
// computer synthesized pictures", SIGGRAPH 1977, normalised).
typedef struct {
    Vec3 diffuse; // irradiance / pi
    Vec3 mirrored;
    double plain; // luminance of `diffuse` without relief
} SunLight;

static SunLight light_of_sun(const RayScene *scene, const Ray *ray, const RaySurfacePoint *p, Rng *rng) {
    const RaySun *sun = &scene->sun;
    const RayMaterial *m = &scene->material[p->material];
    SunLight out = {{0, 0, 0}, {0, 0, 0}, 0};
    RayFrame frame = ray_frame_along(vec3(0, 0, 0), sun->direction);
    double r = tan(sun->radius_rad) * sqrt(rng_uniform(rng)), angle = 2 * PI * rng_uniform(rng);
    Vec3 to_sun = vec3_normalize(ray_frame_point(&frame, r * cos(angle), r * sin(angle), 1));
    double facing = vec3_dot(p->normal, to_sun);
    bool through = vec3_dot(p->flat_normal, to_sun) < 0;
    if (through) facing = -m->translucency * facing;
    if (facing <= 0) return out;
    Ray shadow = {ray_surface_leave(p->position, p->flat_normal, to_sun), to_sun, 1e9};
    if (ray_bvh_blocked(&scene->bvh, &shadow)) return out;
    out.diffuse = vec3_scale(sun->light, facing);
    out.plain = ray_luminance(sun->light) * (through ? facing : fmax(vec3_dot(p->smooth_normal, to_sun), 0));
    if (m->coat <= 0 || through) return out;
    Vec3 half = vec3_normalize(vec3_sub(to_sun, ray->direction));
    double rough = fmax(m->roughness, 0.06), power = 2 / (rough * rough) - 2;
    double fresnel = m->coat + (1 - m->coat) * pow(1 - fmax(vec3_dot(half, to_sun), 0), 5);
    double lobe = (power + 2) / 8 * pow(fmax(vec3_dot(half, p->normal), 0), power);
    out.mirrored = vec3_scale(sun->light, fmin(fresnel * lobe * facing, 4));
    return out;
}

static RayShade shade(const RayScene *scene, const Ray *ray, double width_per_unit, double travelled, int bounce,
                      Rng *rng);

static double fifth_power(double x) { return x * x * x * x * x; }

// Part of the light that the coat mirrors, after Schlick, "An inexpensive BRDF model", Eurographics 1994.
static double mirror_part(const RayMaterial *m, const RaySurfacePoint *p, Vec3 direction) {
    if (m->coat <= 0) return 0;
    double cosine = fmax(-vec3_dot(p->normal, direction), 0);
    return m->coat + (1 - m->coat) * (1 - m->roughness) * fifth_power(1 - cosine);
}

static Vec3 mirrored_light(const RayScene *scene, const Ray *ray, const RaySurfacePoint *p, double width_per_unit,
                           double travelled, int bounce, Rng *rng) {
    const RayMaterial *m = &scene->material[p->material];
    if (bounce >= BOUNCES || m->roughness >= SATIN) return p->light;
    Vec3 d = vec3_sub(ray->direction, vec3_scale(p->normal, 2 * vec3_dot(p->normal, ray->direction)));
    if (m->roughness > 0) {
        Vec3 jitter = vec3(rng_normal(rng), rng_normal(rng), rng_normal(rng));
        d = vec3_add(d, vec3_scale(jitter, 0.5 * m->roughness));
    }
    double below = vec3_dot(d, p->flat_normal);
    if (below < 0.01) d = vec3_add(d, vec3_scale(p->flat_normal, 0.01 - below));
    d = vec3_normalize(d);
    Ray mirrored = {ray_surface_leave(p->position, p->flat_normal, d), d, 1e9};
    Vec3 light = shade(scene, &mirrored, width_per_unit, travelled, bounce + 1, rng).radiance;
    return vec3(fmin(light.x, BRIGHTEST_MIRRORED), fmin(light.y, BRIGHTEST_MIRRORED),
                fmin(light.z, BRIGHTEST_MIRRORED));
}

static RayShade shade_surface(const RayScene *scene, const Ray *ray, const RayHit *hit, double width_per_unit,
                              double travelled, int bounce, Rng *rng) {
    double width = width_per_unit * (travelled + hit->distance);
    RaySurfacePoint p = ray_surface_at(scene, ray, hit, width);
    const RayMaterial *m = &scene->material[p.material];
    SunLight sun = {{0, 0, 0}, {0, 0, 0}, 0};
    if (vec3_length(scene->sun.direction) > 0) sun = light_of_sun(scene, ray, &p, rng);
    Vec3 light = vec3_add(p.light, sun.diffuse), mirrored = {0, 0, 0};
    double part = mirror_part(m, &p, ray->direction);
    if (part > FAINTEST_MIRRORED)
        mirrored = mirrored_light(scene, ray, &p, width_per_unit, travelled + hit->distance, bounce, rng);
    mirrored = vec3_add(vec3_scale(mirrored, part), sun.mirrored);
    RayShade s = {.material = p.material, .distance = hit->distance, .position = p.position, .normal = p.smooth_normal};
    if (m->metal) {
        s.radiance = vec3_mul(mirrored, p.albedo);
        s.plain = ray_luminance(s.radiance);
    } else {
        s.radiance = vec3_add(vec3_scale(vec3_mul(light, p.albedo), 1 - part), mirrored);
        s.plain = 0.4 * (ray_luminance(p.light) + sun.plain) + ray_luminance(mirrored);
    }
    return s;
}

static RayShade shade(const RayScene *scene, const Ray *ray, double width_per_unit, double travelled, int bounce,
                      Rng *rng) {
    RayHit hit = {.distance = 1e9};
    bool found = ray_bvh_nearest(&scene->bvh, ray, &hit);
    for (int i = 0; i < scene->lamp_count; i++) {
        double distance = hit_lamp(&scene->lamp[i], ray);
        if (distance > 0 && distance < hit.distance)
            return (RayShade){.radiance = scene->lamp[i].radiance, .material = -1, .plain = 4};
    }
    const RaySky *sky = &scene->sky;
    if (!found) return (RayShade){.radiance = ray_sky_radiance(sky, &scene->sun, ray->direction, true), .material = -1};
    RayShade s = shade_surface(scene, ray, &hit, width_per_unit, travelled, bounce, rng);
    if (sky->haze_distance > 0)
        s.radiance = vec3_lerp(sky->horizon, s.radiance, exp(-hit.distance / sky->haze_distance));
    return s;
}

RayShade ray_shade(const RayScene *scene, const Ray *ray, double width_per_unit, Rng *rng) {
    return shade(scene, ray, width_per_unit, 0, 0, rng);
}
