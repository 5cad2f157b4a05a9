// The fence: thin tilted slats and wires before a brick wall and hedges; long thin splats are wanted, and what stands behind shows between.
#include "lab/base/rng.h"
#include "splat3d/ray_shapes.h"
#include "splat3d/scene_foliage.h"
#include "splat3d/scene_kinds.h"

static const double PI = 3.14159265358979323846;

enum { SLAT_KIND, WIRE_KIND, STONE_KIND }; // of random numbers

typedef struct {
    const SceneRequest *request;
    RayScene *scene;
    RayMesh *mesh;
    int leaf[3], blade[2], petal[3];
    int bark, slat[3], metal;
} Fence;

static int painted(const Fence *f, RayPainter *painter, Paint paint, int smaller, RayMaterial material) {
    return scene_painted(f->request, f->scene, painter, paint, smaller, material);
}

static int cells(const Fence *f, int finest) { return scene_cells(f->request, finest, 4); }

static double cell(const Fence *f, double finest) { return finest / f->request->detail; }

static void mix_materials(Fence *f) {
    static const uint32_t leaf[3][3] = {
        {0x2E5A22, 0x568A36, 0x94B060}, {0x47742A, 0x78A040, 0xB4C878}, {0x224A26, 0x3E7034, 0x7FA058}};
    for (int i = 0; i < 3; i++)
        f->leaf[i] = painted(
            f, paint_leaf,
            (Paint){(uint32_t)i, 0, paint_colour(leaf[i][0]), paint_colour(leaf[i][1]), paint_colour(leaf[i][2])}, 4,
            (RayMaterial){.translucency = 0.5, .coat = 0.03, .roughness = 0.3});
    const uint32_t blade[2] = {0x5E8A34, 0x86A048};
    for (int i = 0; i < 2; i++)
        f->blade[i] = ray_scene_add_material(
            f->scene, (RayMaterial){.texture = -1, .tint = paint_colour(blade[i]), .translucency = 0.5});
    const uint32_t petal[3] = {0xF2EFE6, 0xE8B830, 0xC23A5A};
    for (int i = 0; i < 3; i++)
        f->petal[i] = ray_scene_add_material(
            f->scene, (RayMaterial){.texture = -1, .tint = paint_colour(petal[i]), .translucency = 0.4});
    f->bark =
        painted(f, paint_bark, (Paint){5, 0, paint_colour(0x3E2E20), paint_colour(0x7A6248), paint_colour(0x5A6B3A)}, 2,
                (RayMaterial){.relief = 0.01});
    static const uint32_t slat[3][2] = {{0xD9D2C0, 0x8C7B62}, {0x7FA0A8, 0x54727A}, {0xB98A5A, 0x6E4A2C}};
    for (int i = 0; i < 3; i++)
        f->slat[i] = painted(
            f, paint_planks,
            (Paint){(uint32_t)(10 + i), 3, paint_colour(slat[i][0]), paint_colour(slat[i][1]), paint_colour(0x3A2A1C)},
            1, (RayMaterial){.relief = 0.002});
    f->metal = ray_scene_add_material(
        f->scene, (RayMaterial){.texture = -1, .tint = paint_colour(0x9A9CA0), .coat = 0.25, .roughness = 0.2});
}

static void build_ground(const Fence *f) {
    int grass =
        painted(f, paint_grass, (Paint){20, 0, paint_colour(0x3E5A22), paint_colour(0x7E9A48), paint_colour(0x8A7450)},
                0, (RayMaterial){.relief = 0.02});
    int gravel = painted(f, paint_gravel,
                         (Paint){21, 40, paint_colour(0xC8B89C), paint_colour(0x94887A), paint_colour(0xA8704C)}, 0,
                         (RayMaterial){.relief = 0.012});
    int stone = painted(f, paint_granite,
                        (Paint){22, 0, paint_colour(0xA8A29A), paint_colour(0x7A766E), paint_colour(0xD8D4CC)}, 1,
                        (RayMaterial){.relief = 0.01});
    ray_shape_patch(f->mesh, vec3(-14, -6, 0), vec3(28, 0, 0), vec3(0, 20, 0),
                    (RayGrid){cells(f, 150), cells(f, 110), 18, 13, grass});
    ray_shape_patch(f->mesh, vec3(-9, -2.4, 0.006), vec3(18, 0, 0), vec3(0, 1.5, 0),
                    (RayGrid){cells(f, 130), cells(f, 14), 15, 1.25, gravel});
    for (int i = 0; i < 24; i++) { // kerb stones between path and grass
        Rng rng = rng_at(f->request->seed, RNG_SCENE_LAYOUT, STONE_KIND, (uint32_t)i);
        RayFrame at =
            ray_frame_turned(vec3(-4.2 + 0.36 * i, -0.88 + 0.01 * rng_normal(&rng), 0.02), 0.05 * rng_normal(&rng));
        ray_shape_box(f->mesh, at, vec3(0.165, 0.055, 0.05 + 0.008 * rng_normal(&rng)), cell(f, 0.06), 0.8, stone);
    }
}

static void build_wall(const Fence *f) {
    int brick =
        painted(f, paint_brick, (Paint){30, 12, paint_colour(0x9C4A34), paint_colour(0xC47A55), paint_colour(0xC9BFAE)},
                0, (RayMaterial){.relief = 0.012});
    int cap = painted(f, paint_granite,
                      (Paint){31, 0, paint_colour(0xB8AE9C), paint_colour(0x8A8272), paint_colour(0xDCD6C8)}, 2,
                      (RayMaterial){.relief = 0.008});
    RayFrame at = {vec3(0, 1.45, 0.8), vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1)};
    ray_shape_box(f->mesh, at, vec3(4.5, 0.12, 0.8), cell(f, 0.07), 0.95, brick);
    for (int i = 0; i < 15; i++) {
        at.origin = vec3(-4.2 + 0.6 * i, 1.45, 1.63);
        ray_shape_box(f->mesh, at, vec3(0.297, 0.17, 0.035), cell(f, 0.07), 0.7, cap);
    }
}

static void build_slats(const Fence *f) {
    RayFrame at = ray_frame_turned(vec3(0, 0, 0), 0);
    for (int k = -1; k <= 1; k++) { // posts with pointed heads
        at.origin = vec3(1.5 * k, 0.06, 0.62);
        ray_shape_box(f->mesh, at, vec3(0.05, 0.05, 0.62), cell(f, 0.04), 0.5, f->slat[2]);
        at.origin.z = 1.24;
        static const RayOutline head[] = {{0.075, 0},    {0.075, 0.02}, {0.075, 0.02},  {0.04, 0.035},
                                          {0.04, 0.035}, {0.055, 0.07}, {0.045, 0.115}, {0.0, 0.135}};
        ray_shape_turned(f->mesh, at, head, 8, (RayGrid){cells(f, 24), cells(f, 24), 1, 1, f->slat[0]});
    }
    for (int k = 0; k < 2; k++) { // rails
        at.origin = vec3(0, 0.02, 0.32 + 0.55 * k);
        ray_shape_box(f->mesh, at, vec3(1.5, 0.012, 0.035), cell(f, 0.04), 0.6, f->slat[2]);
    }
    for (int i = 0; i < 22; i++) {
        Rng rng = rng_at(f->request->seed, RNG_SCENE_LAYOUT, SLAT_KIND, (uint32_t)i);
        double x = -1.42 + 2.84 * i / 21, lean = 0.13 * rng_normal(&rng), twist = 0.2 * rng_normal(&rng);
        double tall = rng_range(&rng, 0.47, 0.57);
        if (i == 8 || i == 15) lean = i == 8 ? 0.42 : -0.5; // two have come loose
        Vec3 up = vec3_normalize(vec3(sin(lean), 0.03 * rng_normal(&rng), cos(lean)));
        Vec3 side = vec3_normalize(vec3(cos(twist), sin(twist), 0));
        Vec3 front = vec3_normalize(vec3_cross(up, side));
        RayFrame axes = {vec3(x, -0.018, tall + 0.06), up, vec3_cross(front, up),
                         front}; // fibres run along x of the frame
        ray_shape_box(f->mesh, axes, vec3(tall, rng_range(&rng, 0.022, 0.034), 0.007), cell(f, 0.04), 0.5,
                      f->slat[rng_below(&rng, 8) < 5 ? 0 : 1]);
    }
}

static void build_wires(const Fence *f) {
    static const double height[5] = {0.18, 0.5, 0.7, 1.0, 1.15};
    for (int i = 0; i < 5; i++)
        for (int k = 0; k < 2; k++) {
            Rng rng = rng_at(f->request->seed, RNG_SCENE_LAYOUT, WIRE_KIND, (uint32_t)(2 * i + k));
            double x0 = k ? 0 : -1.5, sag = rng_range(&rng, 0.01, 0.06), bulge = 0.03 * rng_normal(&rng);
            Vec3 points[5];
            for (int j = 0; j < 5; j++) {
                double s = j / 4.0, drop = 4 * s * (1 - s);
                points[j] = vec3(x0 + 1.5 * s, 0.12 + bulge * drop, height[i] - sag * drop);
            }
            ray_shape_rod(f->mesh, points, 5, 0.004, cells(f, 40), 8, 1, f->metal);
        }
    for (int k = 0; k < 4; k++) { // stays from post to post, crosswise
        double x = k < 2 ? -1.5 : 0, up = k & 1 ? 1 : 0;
        Vec3 stay[2] = {vec3(x, 0.12, 0.15 + 1.0 * up), vec3(x + 1.5, 0.12, 1.15 - 1.0 * up)};
        ray_shape_rod(f->mesh, stay, 2, 0.003, cells(f, 40), 8, 1, f->metal);
    }
    double turns = 9;
    Vec3 coil[64];
    for (int j = 0; j < 64; j++) { // a coil of spare wire hangs on the middle post
        double a = 2 * PI * turns * j / 63;
        coil[j] = vec3(0.16 * sin(a) * (1 + 0.03 * sin(3.3 * a)), -0.035 - 0.03 * sin(0.7 * a) * sin(0.7 * a),
                       0.93 + 0.17 * cos(a));
    }
    ray_shape_rod(f->mesh, coil, 64, 0.0045, cells(f, 640), 6, 20, f->metal);
}

// A little house for birds on the right post.
static void build_birdhouse(const Fence *f) {
    RayFrame at = ray_frame_turned(vec3(1.5, 0.03, 1.5), 0.3);
    ray_shape_box(f->mesh, at, vec3(0.1, 0.1, 0.13), cell(f, 0.03), 0.4, f->slat[1]);
    for (int side = -1; side <= 1; side += 2) {
        Vec3 down = vec3_normalize(vec3(side * 0.75, 0, -0.66));
        RayFrame roof = {ray_frame_point(&at, side * 0.07, 0, 0.155),
                         vec3_add(vec3_scale(at.x, down.x), vec3(0, 0, down.z)),
                         at.y,
                         {0, 0, 0}};
        roof.z = vec3_cross(roof.x, roof.y);
        ray_shape_box(f->mesh, roof, vec3(0.11, 0.15, 0.008), cell(f, 0.03), 0.4, f->slat[2]);
    }
    int dark = ray_scene_add_material(f->scene, (RayMaterial){.texture = -1, .tint = {0.015, 0.012, 0.01}});
    RayFrame hole = {ray_frame_point(&at, 0, -0.1, 0.03), at.x, vec3(0, 0, 1), vec3_scale(at.y, -1)};
    static const RayOutline disc[] = {{0.034, 0.003}, {0.0, 0.003}};
    ray_shape_turned(f->mesh, hole, disc, 2, (RayGrid){cells(f, 24), 4, 1, 1, dark});
}

static void put_pots(Fence *f) {
    int clay = painted(f, paint_terracotta, (Paint){40, 0, paint_colour(0xB4623C), paint_colour(0xD8C0A4), {0, 0, 0}},
                       1, (RayMaterial){.relief = 0.006});
    static const RayOutline pot[] = {{0.09, 0},    {0.125, 0.16},  {0.135, 0.2},   {0.135, 0.2},  {0.155, 0.2},
                                     {0.155, 0.2}, {0.158, 0.245}, {0.158, 0.245}, {0.14, 0.245}, {0.135, 0.2}};
    static const double place[4][3] = {
        {-1.05, -0.5, 1.0}, {1.15, -0.55, 1.15}, {0.78, -0.42, 0.7}, {-0.7, -0.62, 0.62}};
    for (int i = 0; i < 4; i++) {
        double size = place[i][2];
        RayOutline outline[10];
        for (int k = 0; k < 10; k++) outline[k] = (RayOutline){size * pot[k].radius, size * pot[k].height};
        Vec3 foot = vec3(place[i][0], place[i][1], 0);
        ray_shape_turned(f->mesh, ray_frame_turned(foot, i), outline, 10,
                         (RayGrid){cells(f, 48), cells(f, 40), 2, 1, clay});
        Foliage bush = {f->request->seed, (uint32_t)(10 + i), (int)(240 * size), 0.07, 0.038, f->leaf, 3};
        foliage_bush(f->mesh, &bush, vec3_add(foot, vec3(0, 0, 0.34 * size)),
                     vec3(0.2 * size, 0.2 * size, 0.17 * size));
        Foliage bloom = {f->request->seed, (uint32_t)(20 + i), (int)(70 * size), 0.05, 0.05, &f->petal[i % 3], 1};
        foliage_bush(f->mesh, &bloom, vec3_add(foot, vec3(0, 0, 0.39 * size)),
                     vec3(0.22 * size, 0.22 * size, 0.17 * size));
    }
}

static void plant(Fence *f) {
    uint64_t seed = f->request->seed;
    for (int side = -1; side <= 1; side += 2) { // hedges beside the fence
        Foliage hedge = {seed, (uint32_t)(30 + side), 2600, 0.1, 0.055, f->leaf, 3};
        foliage_bush(f->mesh, &hedge, vec3(side * 2.55, 0.35, 0.55), vec3(0.75, 0.7, 0.75));
    }
    for (int i = 0; i < 4; i++) { // trees behind the wall
        Foliage tree = {seed, (uint32_t)(40 + i), 2400, 0.22, 0.12, f->leaf, 3};
        foliage_tree(f->mesh, &tree, vec3(-5.2 + 3.3 * i, 4.5 + (i & 1) * 1.6, 0), 2.6 + 0.3 * (i % 3), 1.5, 5,
                     f->bark);
    }
    Foliage turf = {seed, 50, 5200, 0.12, 0.011, f->blade, 2};
    foliage_grass(f->mesh, &turf, vec3(-2.2, -0.8, 0), vec3(2.2, 0.5, 0));
    Foliage tuft = {seed, 51, 2600, 0.14, 0.012, f->blade, 2};
    foliage_grass(f->mesh, &tuft, vec3(-3.2, 0.9, 0), vec3(3.2, 1.32, 0));
    for (int i = 0; i < 3; i++) {
        Foliage flower = {seed, (uint32_t)(60 + i), 110, 0.035, 0.03, &f->petal[i], 1};
        foliage_bush(f->mesh, &flower, vec3(-0.9 + 0.85 * i, -0.35, 0.1), vec3(0.45, 0.3, 0.09));
    }
    Vec3 vine[6] = {{-1.5, 0.1, 0},    {-1.43, -0.02, 0.3}, {-1.56, 0, 0.62},
                    {-1.42, 0.0, 0.9}, {-1.2, -0.02, 1.08}, {-0.75, 0.0, 1.12}};
    Foliage ivy = {seed, 70, 420, 0.075, 0.055, f->leaf, 3};
    foliage_vine(f->mesh, &ivy, vine, 6, 0.09, f->bark);
    Vec3 on_wall[5] = {{2.5, 1.3, 0}, {2.2, 1.3, 0.5}, {2.35, 1.3, 0.95}, {1.9, 1.3, 1.35}, {1.3, 1.3, 1.6}};
    Foliage creeper = {seed, 71, 900, 0.1, 0.075, f->leaf, 3};
    foliage_vine(f->mesh, &creeper, on_wall, 5, 0.26, f->bark);
}

void scene_fence_build(const SceneRequest *request, RayScene *scene, ScenePath *path) {
    Fence f = {.request = request, .scene = scene, .mesh = &scene->mesh};
    mix_materials(&f);
    build_ground(&f);
    build_wall(&f);
    build_slats(&f);
    build_wires(&f);
    build_birdhouse(&f);
    put_pots(&f);
    plant(&f);
    scene->sun = (RaySun){vec3_normalize(vec3(-0.62, -0.72, 0.85)), vec3(2.1, 1.86, 1.5), 0.012};
    scene->sky = (RaySky){
        vec3(0.16, 0.32, 0.66), vec3(0.68, 0.78, 0.88), vec3(0.18, 0.17, 0.13), 0.5, (uint32_t)request->seed + 5, 0};
    *path = (ScenePath){.target = {0, 0.25, 0.62},
                        .radius = 2.5,
                        .height = 0.5,
                        .start_rad = -2.45,
                        .sweep_rad = 1.8,
                        .sway = 0.07,
                        .fov_x_rad = 58 * PI / 180};
}
