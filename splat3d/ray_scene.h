// ray_scene.h - everything that a sample scene consists of: triangles, materials, textures, and what lights them.
//
// The world is z up, 1 unit is about 1 metre. Light is measured so that a white surface facing light of 1 has radiance 1.
#ifndef SPLATLAB_SPLAT3D_RAY_SCENE_H
#define SPLATLAB_SPLAT3D_RAY_SCENE_H

#include "splat3d/ray_bvh.h"
#include "splat3d/ray_mesh.h"
#include "splat3d/ray_texture.h"

// How a surface answers light: a diffuse ground, and over it a clear coat (or, with `metal`, a mirror in the texture's colour).
typedef struct {
    int texture;         // index into the scene's textures, or -1
    Vec3 tint;           // multiplies the texture; the albedo when there is none
    double coat;         // mirror reflectance seen straight on: 0 dull, 0.04 lacquer, 0.08 glaze, 0.9 metal
    double roughness;    // spread of the mirror direction, 0 sharp .. 0.3 satin
    bool metal;          // no diffuse ground; reflections are tinted
    double relief;       // how strongly the texture's height bends the normal, in texture repeats; 0 flat
    double translucency; // part of the light that comes through from behind, as in leaves; [0, 1]
    double variety;      // brightness of each piece (leaf, slat) varies by this factor, +-
} RayMaterial;

// A bright rectangle: corner + a edge_u + b edge_v, shining to the side of edge_u cross edge_v. Seen in reflections.
typedef struct {
    Vec3 corner, edge_u, edge_v;
    Vec3 radiance;
} RayLamp;

typedef struct {
    Vec3 direction;    // towards the sun, unit; zero: there is none
    Vec3 light;        // irradiance / pi on a surface that faces it
    double radius_rad; // of its disc: how soft shadows are
} RaySun;

// The sky: a gradient from horizon to zenith, clouds, and haze that far things sink into.
typedef struct {
    Vec3 zenith, horizon, ground; // radiance; ground: below the horizon
    double clouds;                // 0 none .. 1 overcast
    uint32_t seed;                // of the clouds
    double haze_distance;         // world units after which 63 % is haze; 0: clear air
} RaySky;

enum { RAY_MATERIALS = 64, RAY_TEXTURES = 32, RAY_LAMPS = 8 };

typedef struct {
    RayMesh mesh;
    RayBvh bvh;
    int material_count, texture_count, lamp_count;
    RayMaterial material[RAY_MATERIALS];
    RayTexture texture[RAY_TEXTURES];
    RayLamp lamp[RAY_LAMPS];
    RaySun sun;
    RaySky sky;
} RayScene;

void ray_scene_destroy(RayScene *scene); // accepts a zeroed one, which is the empty scene

int ray_scene_add_texture(RayScene *scene, int size, RayPainter *painter, const void *context);
int ray_scene_add_material(RayScene *scene, RayMaterial material);
void ray_scene_add_lamp(RayScene *scene, RayLamp lamp);

// What is seen where no triangle is. sharp: with clouds, for pictures; without, for the light that the sky gives.
Vec3 ray_sky_radiance(const RaySky *sky, const RaySun *sun, Vec3 direction, bool sharp);

// The mean albedo of a material, for light that bounces off it.
Vec3 ray_scene_mean_albedo(const RayScene *scene, int material);

#endif
