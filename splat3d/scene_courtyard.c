// The courtyard: a fountain in a village square without walls; houses, trees, hills and clouds go on to the horizon.
#include "lab/base/rng.h"
#include "splat3d/ray_noise.h"
#include "splat3d/ray_shapes.h"
#include "splat3d/scene_foliage.h"
#include "splat3d/scene_kinds.h"

#include <stdbool.h>

static const double PI = 3.14159265358979323846;

enum { HOUSE_KIND = 10, TREE_KIND }; // of random numbers
enum { FACADES = 4 };

typedef struct {
    const SceneRequest *request;
    RayScene *scene;
    RayMesh *mesh;
    int leaf[3], bloom[3], bark, clay, stone, trim;
    int facade[FACADES], plaster[FACADES], roof, door, forest;
} Yard;

static int painted(const Yard *y, RayPainter *painter, Paint paint, int smaller, RayMaterial material) {
    return scene_painted(y->request, y->scene, painter, paint, smaller, material);
}

static int cells(const Yard *y, int finest) { return scene_cells(y->request, finest, 4); }

static double cell(const Yard *y, double finest) { return finest / y->request->detail; }

static void mix_plants(Yard *y) {
    static const uint32_t leaf[3][3] = {
        {0x3A6426, 0x66963C, 0xA0B868}, {0x52782A, 0x88A848, 0xC0CC80}, {0x2C5430, 0x4A7A3C, 0x88A860}};
    static const uint32_t bloom[3] = {0xC8304E, 0xF0E8E0, 0xB060B8};
    for (int i = 0; i < 3; i++) {
        y->leaf[i] = painted(
            y, paint_leaf,
            (Paint){(uint32_t)i, 0, paint_colour(leaf[i][0]), paint_colour(leaf[i][1]), paint_colour(leaf[i][2])}, 4,
            (RayMaterial){.translucency = 0.5, .coat = 0.03, .roughness = 0.3});
        y->bloom[i] = ray_scene_add_material(
            y->scene, (RayMaterial){.texture = -1, .tint = paint_colour(bloom[i]), .translucency = 0.4});
    }
    y->bark =
        painted(y, paint_bark, (Paint){5, 0, paint_colour(0x43352A), paint_colour(0x857060), paint_colour(0x66703E)}, 2,
                (RayMaterial){.relief = 0.015});
    y->forest =
        painted(y, paint_forest, (Paint){6, 0, paint_colour(0x2F4A28), paint_colour(0x8FA050), paint_colour(0xC0B060)},
                0, (RayMaterial){0});
}

static void mix_stones(Yard *y) {
    y->clay = painted(y, paint_terracotta, (Paint){10, 0, paint_colour(0xB86A44), paint_colour(0xDCC8B0), {0, 0, 0}}, 1,
                      (RayMaterial){.relief = 0.006});
    y->stone = painted(y, paint_granite,
                       (Paint){11, 0, paint_colour(0xD0C6B2), paint_colour(0x948A78), paint_colour(0xEFE8DC)}, 1,
                       (RayMaterial){.relief = 0.006});
    y->trim = painted(y, paint_granite,
                      (Paint){12, 0, paint_colour(0xC8B898), paint_colour(0xA89878), paint_colour(0xE0D4BC)}, 2,
                      (RayMaterial){0});
    y->roof =
        painted(y, paint_roof, (Paint){13, 14, paint_colour(0xB0583A), paint_colour(0x86402C), paint_colour(0x6A6A48)},
                0, (RayMaterial){.relief = 0.03});
    y->door =
        painted(y, paint_planks, (Paint){14, 7, paint_colour(0x6A4A30), paint_colour(0x3E2A1A), paint_colour(0x1E140C)},
                2, (RayMaterial){0});
    static const uint32_t wall[FACADES][2] = {
        {0xE6CFA0, 0x4E7A5E}, {0xD89A78, 0x3E6488}, {0xEAE2D0, 0x9A4636}, {0xC8B89A, 0x5A6E8A}};
    for (int i = 0; i < FACADES; i++) {
        Paint paint = {(uint32_t)(20 + i), 4, paint_colour(wall[i][0]), paint_colour(wall[i][1]),
                       paint_colour(0xE8E0D0)};
        y->facade[i] = painted(y, paint_facade, paint, 0, (RayMaterial){0});
        paint.second = vec3_scale(paint.base, 0.55);
        y->plaster[i] = painted(y, paint_plaster, paint, 1, (RayMaterial){.relief = 0.01});
    }
}

typedef struct {
    double inner, outer, height;
} Ring;

static Vec3 ring_point(const void *context, double u, double v) {
    const Ring *ring = context;
    double r = ring->inner + v * (ring->outer - ring->inner), angle = 2 * PI * u;
    return vec3(r * cos(angle), r * sin(angle), ring->height);
}

// Facing up: the radius shrinks with v.
static void lay_ring(const Yard *y, double inner, double outer, double height, RayGrid grid) {
    Ring ring = {outer, inner, height};
    ray_shape_surface(y->mesh, ring_point, &ring, grid);
}

static void build_ground(const Yard *y) {
    int paving =
        painted(y, paint_paving, (Paint){30, 6, paint_colour(0xC4B49A), paint_colour(0x9A8C78), paint_colour(0x5E564A)},
                0, (RayMaterial){.relief = 0.02});
    int cobble = painted(y, paint_cobble,
                         (Paint){31, 12, paint_colour(0xB0A08C), paint_colour(0x7E746A), paint_colour(0x544C42)}, 0,
                         (RayMaterial){.relief = 0.03});
    lay_ring(y, 0.9, 3.3, 0.0, (RayGrid){cells(y, 140), cells(y, 32), 8, 2, paving});
    lay_ring(y, 3.3, 3.55, 0.012, (RayGrid){cells(y, 120), cells(y, 6), 40, 0.6, y->trim});
    ray_shape_patch(y->mesh, vec3(-24, -24, -0.012), vec3(48, 0, 0), vec3(0, 48, 0),
                    (RayGrid){cells(y, 120), cells(y, 120), 26, 26, cobble});
}

static void build_fountain(const Yard *y) {
    RayFrame at = ray_frame_turned(vec3(0, 0, 0), 0);
    static const RayOutline basin[] = {{1.08, 0},   {1.08, 0.08}, {1.08, 0.08}, {1.02, 0.1}, {1.02, 0.1}, {0.99, 0.2},
                                       {1.0, 0.38}, {1.08, 0.44}, {1.08, 0.44}, {1.1, 0.47}, {1.08, 0.5}, {1.08, 0.5},
                                       {0.9, 0.5},  {0.9, 0.5},   {0.86, 0.46}, {0.86, 0.3}};
    ray_shape_turned(y->mesh, at, basin, 16, (RayGrid){cells(y, 96), cells(y, 48), 10, 1, y->stone});
    static const RayOutline column[] = {
        {0.24, 0.3},  {0.24, 0.48}, {0.24, 0.48},  {0.17, 0.5},  {0.13, 0.58}, {0.1, 0.75},  {0.14, 0.88},
        {0.17, 0.92}, {0.17, 0.92}, {0.3, 0.96},   {0.45, 1.06}, {0.5, 1.13},  {0.5, 1.13},  {0.47, 1.145},
        {0.44, 1.12}, {0.3, 1.06},  {0.1, 1.04},   {0.1, 1.04},  {0.08, 1.15}, {0.06, 1.3},  {0.1, 1.4},
        {0.1, 1.4},   {0.2, 1.45},  {0.25, 1.52},  {0.25, 1.52}, {0.22, 1.53}, {0.12, 1.49}, {0.05, 1.5},
        {0.05, 1.5},  {0.04, 1.6},  {0.075, 1.66}, {0.09, 1.73}, {0.06, 1.8},  {0.0, 1.84}};
    ray_shape_turned(y->mesh, at, column, 34, (RayGrid){cells(y, 56), cells(y, 120), 4, 1, y->stone});
    int water = painted(y, paint_water, (Paint){40, 0, paint_colour(0x2E5A5C), {0, 0, 0}, {0, 0, 0}}, 2,
                        (RayMaterial){.coat = 0.04, .relief = 0.012});
    lay_ring(y, 0.1, 0.88, 0.41, (RayGrid){cells(y, 72), cells(y, 24), 4, 0.6, water});
    lay_ring(y, 0.05, 0.45, 1.105, (RayGrid){cells(y, 48), cells(y, 12), 3, 0.4, water});
    int jet = ray_scene_add_material(
        y->scene,
        (RayMaterial){.texture = -1, .tint = {0.75, 0.82, 0.86}, .coat = 0.1, .roughness = 0.1, .translucency = 0.6});
    for (int k = 0; k < 8; k++) { // water falls over the upper bowl's rim in thin strings
        double c = cos(2 * PI * (k + 0.2) / 8), s = sin(2 * PI * (k + 0.2) / 8);
        Vec3 fall[5];
        for (int j = 0; j < 5; j++) {
            double t = j / 4.0, r = 0.46 + 0.22 * t;
            fall[j] = vec3(r * c, r * s, 1.15 + 0.06 * t - 0.78 * t * t);
        }
        ray_shape_rod(y->mesh, fall, 5, 0.007, cells(y, 32), 8, 3, jet);
    }
}

static void put_pots(const Yard *y) {
    static const RayOutline pot[] = {{0.13, 0},     {0.18, 0.05},  {0.25, 0.2},  {0.24, 0.33},
                                     {0.2, 0.4},    {0.2, 0.4},    {0.25, 0.42}, {0.25, 0.42},
                                     {0.255, 0.47}, {0.255, 0.47}, {0.22, 0.47}, {0.2, 0.4}};
    for (int i = 0; i < 9; i++) {
        double angle = 2 * PI * (i + 0.35) / 9 + 0.12 * sin(7.0 * i), size = 0.8 + 0.35 * noise_cell(i, 0, 0, 5);
        double away = 1.55 + 0.5 * noise_cell(i, 1, 0, 5);
        RayOutline outline[12];
        for (int k = 0; k < 12; k++) outline[k] = (RayOutline){size * pot[k].radius, size * pot[k].height};
        Vec3 foot = vec3(away * cos(angle), away * sin(angle), 0);
        ray_shape_turned(y->mesh, ray_frame_turned(foot, i), outline, 12,
                         (RayGrid){cells(y, 56), cells(y, 40), 3, 1, y->clay});
        Foliage bush = {y->request->seed, (uint32_t)i, 420, 0.09, 0.045, y->leaf, 3};
        double tall = size * (i % 3 == 0 ? 0.42 : 0.26);
        foliage_bush(y->mesh, &bush, vec3_add(foot, vec3(0, 0, 0.45 * size + 0.85 * tall)),
                     vec3(0.3 * size, 0.3 * size, tall));
        if (i % 3 == 0) continue;
        Foliage bloom = {y->request->seed, (uint32_t)(20 + i), 130, 0.055, 0.055, &y->bloom[i % 3], 1};
        foliage_bush(y->mesh, &bloom, vec3_add(foot, vec3(0, 0, 0.47 * size + tall)),
                     vec3(0.31 * size, 0.31 * size, tall));
    }
}

// A house of `storeys`, its front towards the square; axes: x along the front, y away from the square.
static void build_house(const Yard *y, RayFrame at, double width, double depth, int storeys, int kind) {
    const double storey = 2.6, height = storey * storeys, overhang = 0.35, rise = 0.55 * depth / 2;
    Vec3 up = {0, 0, 1}, half = vec3_scale(at.x, width / 2), back = vec3_scale(at.y, depth);
    Vec3 left = vec3_sub(at.origin, half), right = vec3_add(at.origin, half);
    RayGrid front = {cells(y, 24), cells(y, 8 * storeys), width / 6.5, storeys, y->facade[kind]};
    ray_shape_patch(y->mesh, left, vec3_scale(at.x, width), vec3_scale(up, height), front);
    ray_shape_patch(y->mesh, vec3_add(right, back), vec3_scale(at.x, -width), vec3_scale(up, height), front);
    RayGrid side = {cells(y, 12), cells(y, 8 * storeys), depth / 3, height / 3, y->plaster[kind]};
    ray_shape_patch(y->mesh, vec3_add(left, back), vec3_scale(back, -1), vec3_scale(up, height), side);
    ray_shape_patch(y->mesh, right, back, vec3_scale(up, height), side);
    Vec3 ridge = vec3_scale(up, height + rise), middle = vec3_scale(back, 0.5);
    for (int k = -1; k <= 1; k += 2) { // gables, and the two slopes of the roof
        Vec3 corner = vec3_add(k < 0 ? left : right, vec3_scale(up, height));
        int a = ray_mesh_vertex(y->mesh, corner, vec3_scale(at.x, k), 0, 0);
        int b = ray_mesh_vertex(y->mesh, vec3_add(corner, back), vec3_scale(at.x, k), depth / 3, 0);
        int c = ray_mesh_vertex(y->mesh, vec3_add(vec3_add(corner, middle), vec3_scale(up, rise)), vec3_scale(at.x, k),
                                depth / 6, rise / 3);
        ray_mesh_triangle(y->mesh, a, b, c, y->plaster[kind]);
        Vec3 eave = k < 0 ? vec3_sub(at.origin, vec3_scale(at.y, overhang))
                          : vec3_add(at.origin, vec3_scale(at.y, depth + overhang));
        Vec3 along = vec3_scale(at.x, -k * (width / 2 + overhang));
        eave = vec3_sub(vec3_add(eave, vec3_scale(up, height - overhang * 0.55)), along);
        Vec3 top = vec3_sub(vec3_add(vec3_add(at.origin, middle), ridge), along);
        ray_shape_patch(y->mesh, eave, vec3_scale(along, 2), vec3_sub(top, eave),
                        (RayGrid){cells(y, 16), cells(y, 8), width / 4, depth / 7, y->roof});
    }
    RayFrame chimney = at;
    chimney.origin = vec3_add(ray_frame_point(&at, 0.28 * width, 0.62 * depth, 0), ridge);
    ray_shape_box(y->mesh, chimney, vec3(0.35, 0.3, 0.7), cell(y, 0.5), 1.5, y->plaster[kind]);
    RayFrame entry = at;
    entry.origin = ray_frame_point(&at, -0.02 * width, 0.02, 1.05);
    ray_shape_box(y->mesh, entry, vec3(0.55, 0.06, 1.05), cell(y, 0.3), 0, y->door);
    entry.origin = ray_frame_point(&at, -0.02 * width, 0.0, 2.17);
    ray_shape_box(y->mesh, entry, vec3(0.75, 0.08, 0.09), cell(y, 0.3), 1, y->trim);
}

// Near houses round the square, with gaps to look through; farther ones behind.
static void build_village(const Yard *y) {
    static const double house[][5] = {
        // angle (turns), distance, width, depth, storeys
        {0.04, 14, 9, 7, 2},  {0.135, 15.5, 7.5, 7, 3}, {0.4, 14.5, 9, 7, 2}, {0.5, 16, 8, 8, 3},
        {0.72, 15, 10, 7, 2}, {0.9, 30, 12, 8, 2},      {0.86, 42, 10, 8, 3}, {0.22, 29, 11, 8, 2},
        {0.27, 38, 11, 8, 3}, {0.33, 33, 10, 8, 2},     {0.58, 34, 12, 8, 2}, {0.63, 45, 10, 8, 3},
        {0.8, 52, 14, 9, 2},  {0.96, 36, 10, 8, 3},     {0.3, 56, 14, 9, 3},  {0.61, 27, 9, 7, 2}};
    for (int i = 0; i < (int)(sizeof house / sizeof house[0]); i++) {
        Rng rng = rng_at(y->request->seed, RNG_SCENE_LAYOUT, HOUSE_KIND, (uint32_t)i);
        double angle = 2 * PI * house[i][0], turn = angle - PI / 2 + 0.08 * rng_normal(&rng);
        RayFrame at = ray_frame_turned(vec3(house[i][1] * cos(angle), house[i][1] * sin(angle), -0.012), turn);
        build_house(y, at, house[i][2], house[i][3], (int)house[i][4], i % FACADES);
    }
}

static Vec3 hill_point(const void *context, double u, double v) {
    const Yard *y = context;
    double r = 22 * pow(18, v), angle = -2 * PI * u, rise = noise_step(35, 330, r);
    Vec3 p = vec3(r * cos(angle), r * sin(angle), 0);
    double hills = noise_fbm(vec3_scale(p, 0.011), 0, 4, (uint32_t)y->request->seed + 3);
    return vec3(p.x, p.y, -0.05 + rise * (22 + 60 * hills) + 0.6 * noise_step(22, 40, r) * hills);
}

static void plant(const Yard *y) {
    ray_shape_surface(y->mesh, hill_point, y, (RayGrid){cells(y, 140), cells(y, 50), 24, 9, y->forest});
    static const double tree[][4] = {
        // angle (turns), distance, height, spread
        {0.09, 8.5, 3.4, 1.6}, {0.26, 10, 3.6, 1.7}, {0.45, 9, 3.2, 1.5}, {0.57, 11, 3.6, 1.7}, {0.76, 9.5, 3.8, 1.9},
        {0.94, 12, 3.6, 1.7},  {0.66, 21, 5, 2.6},   {0.34, 24, 5, 2.6},  {0.85, 22, 4.5, 2.4}, {0.19, 22, 5, 2.4}};
    for (int i = 0; i < (int)(sizeof tree / sizeof tree[0]); i++) {
        double angle = 2 * PI * tree[i][0];
        Foliage crown = {y->request->seed, (uint32_t)(40 + i), 2600, 0.11 * tree[i][3], 0.065 * tree[i][3], y->leaf, 3};
        foliage_tree(y->mesh, &crown, vec3(tree[i][1] * cos(angle), tree[i][1] * sin(angle), -0.02), tree[i][2],
                     tree[i][3], 5, y->bark);
    }
    for (int i = 0; i < 14; i++) { // bushes along the houses
        Rng rng = rng_at(y->request->seed, RNG_SCENE_LAYOUT, TREE_KIND, (uint32_t)i);
        double angle = 2 * PI * (i + 0.6 * rng_uniform(&rng)) / 14, away = rng_range(&rng, 5.6, 9),
               size = rng_range(&rng, 0.35, 0.7);
        Foliage bush = {y->request->seed, (uint32_t)(60 + i), 700, 0.13, 0.07, y->leaf, 3};
        foliage_bush(y->mesh, &bush, vec3(away * cos(angle), away * sin(angle), 0.6 * size),
                     vec3(size, size, 0.8 * size));
    }
}

static void put_benches(const Yard *y) {
    for (int i = 0; i < 4; i++) {
        double angle = 2 * PI * (i + 0.55) / 4;
        RayFrame at = ray_frame_turned(vec3(4.6 * cos(angle), 4.6 * sin(angle), 0), angle - PI / 2);
        for (int k = 0; k < 8; k++) { // four slats to sit on, four to lean on
            RayFrame slat = at;
            bool seat = k < 4;
            slat.origin = seat ? ray_frame_point(&at, 0, 0.11 * k, 0.45)
                               : ray_frame_point(&at, 0, 0.42 + 0.03 * (k - 4), 0.55 + 0.1 * (k - 4));
            ray_shape_box(y->mesh, slat, vec3(0.75, seat ? 0.045 : 0.012, seat ? 0.014 : 0.042), cell(y, 0.12), 0.7,
                          y->door);
        }
        for (int k = -1; k <= 1; k += 2) {
            RayFrame leg = at;
            leg.origin = ray_frame_point(&at, 0.6 * k, 0.17, 0.21);
            ray_shape_box(y->mesh, leg, vec3(0.05, 0.2, 0.225), cell(y, 0.12), 0.7, y->stone);
        }
    }
}

void scene_courtyard_build(const SceneRequest *request, RayScene *scene, ScenePath *path) {
    Yard y = {.request = request, .scene = scene, .mesh = &scene->mesh};
    mix_plants(&y);
    mix_stones(&y);
    build_ground(&y);
    build_fountain(&y);
    put_pots(&y);
    put_benches(&y);
    build_village(&y);
    plant(&y);
    scene->sun = (RaySun){vec3_normalize(vec3(-0.55, -0.6, 0.8)), vec3(2.0, 1.78, 1.42), 0.014};
    scene->sky = (RaySky){
        vec3(0.15, 0.31, 0.66), vec3(0.66, 0.76, 0.86), vec3(0.2, 0.18, 0.14), 0.6, (uint32_t)request->seed + 9, 420};
    *path = (ScenePath){.target = {0, 0, 1.0},
                        .radius = 4.1,
                        .height = 0.62,
                        .start_rad = 0.4,
                        .sweep_rad = 2 * PI,
                        .sway = 0.06,
                        .fov_x_rad = 60 * PI / 180};
}
