#include "splat3d/ray_scene.h"

#include "splat3d/ray_noise.h"

#include <assert.h>

void ray_scene_destroy(RayScene *scene) {
    ray_mesh_destroy(&scene->mesh);
    ray_bvh_destroy(&scene->bvh);
    for (int i = 0; i < scene->texture_count; i++) ray_texture_destroy(&scene->texture[i]);
    *scene = (RayScene){0};
}

int ray_scene_add_texture(RayScene *scene, int size, RayPainter *painter, const void *context) {
    assert(scene->texture_count < RAY_TEXTURES);
    scene->texture[scene->texture_count] = ray_texture_paint(size, painter, context);
    return scene->texture_count++;
}

int ray_scene_add_material(RayScene *scene, RayMaterial material) {
    assert(scene->material_count < RAY_MATERIALS && material.texture < scene->texture_count);
    scene->material[scene->material_count] = material;
    return scene->material_count++;
}

void ray_scene_add_lamp(RayScene *scene, RayLamp lamp) {
    assert(scene->lamp_count < RAY_LAMPS);
    scene->lamp[scene->lamp_count++] = lamp;
}

// How much cloud there is in a direction, and how bright it is: noise on a plane above, thinned towards the horizon.
static double cloud_cover(const RaySky *sky, Vec3 direction, double *brightness) {
    double height = direction.z + 0.12;
    Vec3 p = vec3(1.6 * direction.x / height, 1.6 * direction.y / height, 0.37);
    Vec3 bend = vec3(noise_fbm(vec3_scale(p, 0.7), 0, 2, sky->seed + 40),
                     noise_fbm(vec3_scale(p, 0.7), 0, 2, sky->seed + 50), 0);
    double density = noise_fbm(vec3_add(p, vec3_scale(bend, 0.8)), 0, 6, sky->seed);
    double low = 0.42 - 0.7 * sky->clouds;
    *brightness = 1.05 - 0.3 * noise_step(low + 0.1, low + 0.8, density);
    return noise_step(low, low + 0.45, density) * noise_step(0, 0.16, direction.z);
}

Vec3 ray_sky_radiance(const RaySky *sky, const RaySun *sun, Vec3 direction, bool sharp) {
    if (direction.z < 0) return vec3_lerp(sky->horizon, sky->ground, noise_step(0, 0.08, -direction.z));
    double up = 1 - pow(1 - fmin(direction.z, 1), 3.0);
    Vec3 colour = vec3_lerp(sky->horizon, sky->zenith, up);
    double to_sun = vec3_dot(direction, sun->direction);
    if (to_sun > 0) {
        double glow = 0.25 * pow(to_sun, 8) + 0.5 * pow(to_sun, 64);
        colour = vec3_add(colour, vec3_scale(sun->light, 0.2 * glow));
    }
    if (sky->clouds <= 0) return colour;
    if (!sharp) return vec3_lerp(colour, vec3(1, 1, 1), 0.4 * sky->clouds);
    double brightness, cover = cloud_cover(sky, direction, &brightness);
    return vec3_lerp(colour, vec3(brightness, 0.985 * brightness, 0.97 * brightness), 0.92 * cover);
}

Vec3 ray_scene_mean_albedo(const RayScene *scene, int material) {
    const RayMaterial *m = &scene->material[material];
    Vec3 albedo = m->texture >= 0 ? ray_texture_mean(&scene->texture[m->texture]) : vec3(1, 1, 1);
    return vec3_mul(albedo, m->tint);
}
