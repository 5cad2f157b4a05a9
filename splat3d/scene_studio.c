// The studio: things that shine on a table in a room, lit by a window and a wide lamp overhead; what they mirror moves with the viewer.
#include "lab/base/rng.h"
#include "splat3d/ray_shapes.h"
#include "splat3d/scene_kinds.h"

static const double PI = 3.14159265358979323846;

static const double ROOM = 3.3, FLOOR = -0.75, CEILING = 2.1; // half width; heights above the table top

typedef struct {
    const SceneRequest *request;
    RayScene *scene;
    RayMesh *mesh;
} Studio;

static int painted(const Studio *s, RayPainter *painter, Paint paint, int smaller, RayMaterial material) {
    return scene_painted(s->request, s->scene, painter, paint, smaller, material);
}

static int cells(const Studio *s, int finest) { return scene_cells(s->request, finest, 4); }

static double cell(const Studio *s, double finest) { return finest / s->request->detail; }

// A picture in its frame on a wall; `right` and `up` span it, `out` points into the room.
static void hang_picture(const Studio *s, Vec3 middle, Vec3 right, Vec3 out, double width, double height, int canvas,
                         int frame) {
    Vec3 up = {0, 0, 1};
    Vec3 low = vec3_sub(middle, vec3_add(vec3_scale(right, width / 2), vec3_scale(up, height / 2)));
    ray_shape_patch(s->mesh, vec3_add(low, vec3_scale(out, 0.012)), vec3_scale(right, width), vec3_scale(up, height),
                    (RayGrid){cells(s, 16), cells(s, 16), 1, 1, canvas});
    RayFrame axes = {middle, right, up, vec3_cross(right, up)};
    const double rim = 0.035;
    for (int side = -1; side <= 1; side += 2) {
        axes.origin = vec3_add(middle, vec3_scale(up, side * (height / 2 + rim)));
        ray_shape_box(s->mesh, axes, vec3(width / 2 + 2 * rim, rim, 0.03), cell(s, 0.1), 0.4, frame);
        axes.origin = vec3_add(middle, vec3_scale(right, side * (width / 2 + rim)));
        ray_shape_box(s->mesh, axes, vec3(rim, height / 2, 0.03), cell(s, 0.1), 0.4, frame);
    }
}

static void build_walls(const Studio *s) {
    int paper = painted(s, paint_wallpaper,
                        (Paint){11, 4, paint_colour(0x7FA3A0), paint_colour(0xB9CFC4), paint_colour(0xE8C98F)}, 0,
                        (RayMaterial){0});
    int panel =
        painted(s, paint_panel, (Paint){12, 8, paint_colour(0xE6DFD0), paint_colour(0xD2C8B4), paint_colour(0x9A8C78)},
                1, (RayMaterial){.coat = 0.03, .roughness = 0.25});
    int wood =
        painted(s, paint_planks, (Paint){13, 2, paint_colour(0x6B4226), paint_colour(0x3C2415), paint_colour(0x22140C)},
                2, (RayMaterial){.coat = 0.04, .roughness = 0.15});
    static const uint32_t canvas_colour[4][3] = {{0x3D6C9B, 0x2E4A3A, 0xE0A030},
                                                 {0xC96A4A, 0x40304A, 0xF2D9A0},
                                                 {0x88A8A0, 0x7A3B2E, 0xE7B04C},
                                                 {0x4A5580, 0x2F6A60, 0xD9583B}};
    const double rail = FLOOR + 0.72;
    for (int wall = 0; wall < 4; wall++) {
        double angle = wall * PI / 2;
        Vec3 out = {-cos(angle), -sin(angle), 0}, up = {0, 0, 1};
        Vec3 right = vec3_cross(up, out);
        Vec3 foot = vec3_sub(vec3_scale(out, -ROOM), vec3_scale(right, ROOM));
        ray_shape_patch(s->mesh, vec3_add(foot, vec3(0, 0, FLOOR)), vec3_scale(right, 2 * ROOM),
                        vec3_scale(up, rail - FLOOR), (RayGrid){cells(s, 100), cells(s, 14), 5, 0.55, panel});
        ray_shape_patch(s->mesh, vec3_add(foot, vec3(0, 0, rail)), vec3_scale(right, 2 * ROOM),
                        vec3_scale(up, CEILING - rail), (RayGrid){cells(s, 100), cells(s, 32), 6, 1.94, paper});
        RayFrame axes = {vec3_add(vec3_scale(out, -ROOM), vec3(0, 0, rail)), right, up, vec3_cross(right, up)};
        ray_shape_box(s->mesh, axes, vec3(ROOM, 0.035, 0.03), cell(s, 0.1), 0.5, wood);
        if (wall == 2) continue; // the window's
        const uint32_t *c = canvas_colour[wall];
        for (int k = 0; k < 2; k++) {
            int canvas = painted(s, paint_canvas,
                                 (Paint){(uint32_t)(20 + 2 * wall + k), 0, paint_colour(c[k]), paint_colour(c[1 - k]),
                                         paint_colour(c[2])},
                                 2, (RayMaterial){0});
            Vec3 middle = vec3_add(vec3_scale(out, -ROOM), vec3_scale(right, k ? 1.15 : -1.0));
            hang_picture(s, vec3_add(middle, vec3(0, 0, k ? 0.98 : 0.9)), right, out, k ? 0.9 : 1.3, k ? 1.1 : 0.9,
                         canvas, wood);
        }
    }
}

// Bright panes behind bars in the wall at -x, and a wide lamp under the ceiling.
static void build_lamps(const Studio *s) {
    int frame =
        painted(s, paint_panel, (Paint){31, 1, paint_colour(0xF0EDE4), paint_colour(0xE0DACB), paint_colour(0xB0A590)},
                3, (RayMaterial){.coat = 0.04, .roughness = 0.2});
    const double x = -ROOM, low = 0.32, high = 1.95, half = 1.1;
    ray_scene_add_lamp(s->scene, (RayLamp){vec3(x + 0.02, -half, low), vec3(0, 2 * half, 0), vec3(0, 0, high - low),
                                           vec3(4.2, 4.8, 5.6)});
    RayFrame axes = {vec3(x, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1)};
    for (int i = 0; i <= 4; i++) {
        axes.origin = vec3(x, -half + i * half / 2, (low + high) / 2);
        double thick = i % 4 == 0 ? 0.05 : 0.022;
        ray_shape_box(s->mesh, axes, vec3(0.06, thick, (high - low) / 2 + 0.05), cell(s, 0.1), 0.5, frame);
    }
    for (int i = 0; i <= 2; i++) {
        axes.origin = vec3(x, 0, low + i * (high - low) / 2);
        ray_shape_box(s->mesh, axes, vec3(i == 0 ? 0.12 : 0.06, half, i == 1 ? 0.022 : 0.05), cell(s, 0.1), 0.5, frame);
    }
    ray_scene_add_lamp(
        s->scene, (RayLamp){vec3(0.1, -0.45, CEILING - 0.08), vec3(0, 1.3, 0), vec3(1.1, 0, 0), vec3(9.5, 8.2, 6.7)});
    const double wide = 2.6; // light that the ceiling spreads
    ray_scene_add_lamp(s->scene, (RayLamp){vec3(-wide, -wide, CEILING - 0.01), vec3(0, 2 * wide, 0),
                                           vec3(2 * wide, 0, 0), vec3(0.62, 0.58, 0.52)});
}

static void build_floor(const Studio *s) {
    int parquet = painted(s, paint_planks,
                          (Paint){41, 10, paint_colour(0xB98852), paint_colour(0x7D5128), paint_colour(0x3A2412)}, 0,
                          (RayMaterial){.coat = 0.04, .roughness = 0.08});
    int rug =
        painted(s, paint_rug, (Paint){42, 0, paint_colour(0x7E2A26), paint_colour(0x2A3F5F), paint_colour(0xD9BE8C)}, 0,
                (RayMaterial){0});
    int ceiling = ray_scene_add_material(s->scene, (RayMaterial){.texture = -1, .tint = {0.8, 0.79, 0.76}});
    ray_shape_patch(s->mesh, vec3(-ROOM, -ROOM, FLOOR), vec3(2 * ROOM, 0, 0), vec3(0, 2 * ROOM, 0),
                    (RayGrid){cells(s, 130), cells(s, 130), 3, 3.3, parquet});
    ray_shape_patch(s->mesh, vec3(-1.9, -1.35, FLOOR + 0.006), vec3(3.8, 0, 0), vec3(0, 2.7, 0),
                    (RayGrid){cells(s, 100), cells(s, 70), 1, 1, rug});
    ray_shape_patch(s->mesh, vec3(-ROOM, -ROOM, CEILING), vec3(0, 2 * ROOM, 0), vec3(2 * ROOM, 0, 0),
                    (RayGrid){cells(s, 16), cells(s, 16), 1, 1, ceiling});
}

// The runner lies on the table in gentle waves and hangs over both its ends.
static Vec3 runner_point(const void *context, double u, double v) {
    const double *half_table = context;
    double x = (2 * u - 1) * (half_table[0] + 0.22), y = (v - 0.5) * 0.5, over = fabs(x) - half_table[0];
    double wave = 0.0035 + 0.0022 * sin(9 * x + 14 * y) * sin(5 * x - 11 * y);
    if (over <= 0) return vec3(x, y, wave);
    double bend = fmin(over / 0.02, PI / 2), down = fmax(over - 0.02 * PI / 2, 0);
    double away = half_table[0] + 0.02 * sin(bend) + 0.012 * sin(16 * y) * down / 0.2;
    return vec3(copysign(away, x), y, wave - 0.02 * (1 - cos(bend)) - down);
}

static void build_table(const Studio *s) {
    int top =
        painted(s, paint_planks, (Paint){51, 6, paint_colour(0xC89058), paint_colour(0x84522A), paint_colour(0x4A2C16)},
                0, (RayMaterial){.coat = 0.045, .roughness = 0.02});
    int cloth =
        painted(s, paint_cloth, (Paint){52, 4, paint_colour(0xE9E0CC), paint_colour(0x3F6A8A), paint_colour(0xB8452F)},
                0, (RayMaterial){0});
    static const double half[2] = {1.0, 0.68};
    RayFrame at = ray_frame_turned(vec3(0, 0, -0.02), 0);
    ray_shape_patch(s->mesh, vec3(-half[0], -half[1], 0), vec3(2 * half[0], 0, 0), vec3(0, 2 * half[1], 0),
                    (RayGrid){cells(s, 160), cells(s, 108), 2 * half[0] / 1.3, 2 * half[1] / 1.3, top});
    ray_shape_box(s->mesh, at, vec3(half[0], half[1], 0.0195), cell(s, 0.1), 1.3, top);
    at.origin.z = -0.085;
    ray_shape_box(s->mesh, at, vec3(half[0] - 0.08, half[1] - 0.08, 0.045), cell(s, 0.06), 1.3, top);
    for (int k = 0; k < 4; k++) {
        RayFrame foot = ray_frame_turned(vec3(k & 1 ? 0.86 : -0.86, k & 2 ? 0.54 : -0.54, FLOOR), 0);
        static const RayOutline leg[] = {{0.03, 0},    {0.022, 0.06}, {0.035, 0.3}, {0.045, 0.42},
                                         {0.03, 0.46}, {0.05, 0.49},  {0.05, 0.68}};
        ray_shape_turned(s->mesh, foot, leg, 7, (RayGrid){cells(s, 20), cells(s, 40), 1, 1, top});
    }
    ray_shape_surface(s->mesh, runner_point, half, (RayGrid){cells(s, 220), cells(s, 44), 4.9, 1, cloth});
}

static void put_vase(const Studio *s, RayFrame at) {
    int glaze = painted(s, paint_ceramic, (Paint){61, 6, paint_colour(0xF2EEE2), paint_colour(0x1E3A7A), {0, 0, 0}}, 0,
                        (RayMaterial){.coat = 0.07});
    static const RayOutline vase[] = {{0.07, 0},      {0.075, 0},    {0.075, 0},     {0.078, 0.015},
                                      {0.1, 0.06},    {0.148, 0.17}, {0.145, 0.25},  {0.09, 0.34},
                                      {0.056, 0.385}, {0.06, 0.42},  {0.082, 0.445}, {0.082, 0.445},
                                      {0.078, 0.449}, {0.055, 0.42}, {0.05, 0.385},  {0.08, 0.33}};
    ray_shape_turned(s->mesh, at, vase, 16, (RayGrid){cells(s, 96), cells(s, 110), 1, 1, glaze});
}

static void put_bowl(const Studio *s, Vec3 place) {
    int glaze =
        ray_scene_add_material(s->scene, (RayMaterial){.texture = -1, .tint = paint_colour(0x2F7F78), .coat = 0.06});
    int orange =
        painted(s, paint_peel, (Paint){62, 0, paint_colour(0xE8801E), paint_colour(0xD05A10), paint_colour(0x35502A)},
                2, (RayMaterial){.coat = 0.03, .roughness = 0.12, .relief = 0.002});
    int apple =
        painted(s, paint_peel, (Paint){63, 0, paint_colour(0xB8201C), paint_colour(0xD8B04A), paint_colour(0x3A2818)},
                2, (RayMaterial){.coat = 0.045});
    static const RayOutline bowl[] = {{0.06, 0},     {0.06, 0.012}, {0.06, 0.012}, {0.1, 0.03},
                                      {0.16, 0.085}, {0.18, 0.125}, {0.18, 0.125}, {0.172, 0.13},
                                      {0.15, 0.085}, {0.09, 0.035}, {0.0, 0.022}};
    RayFrame at = ray_frame_turned(place, 0);
    ray_shape_turned(s->mesh, at, bowl, 11, (RayGrid){cells(s, 72), cells(s, 60), 1, 1, glaze});
    static const double fruit[5][4] = {{0.075, 0.01, 0.095, 0.062},
                                       {-0.045, 0.07, 0.095, 0.06},
                                       {-0.05, -0.065, 0.098, 0.064},
                                       {0.01, 0.0, 0.178, 0.06},
                                       {0.03, -0.11, 0.115, 0.05}};
    for (int k = 0; k < 5; k++) {
        RayFrame axes = ray_frame_along(vec3_add(place, vec3(fruit[k][0], fruit[k][1], fruit[k][2])),
                                        vec3(0.5 * sin(3.0 * k), 0.6 * cos(5.0 * k), 0.8));
        ray_shape_ball(s->mesh, axes, fruit[k][3], cells(s, 48), k & 1 ? apple : orange);
    }
}

static void put_books(const Studio *s, Vec3 place) {
    static const struct {
        double length, width, thick, turn;
        uint32_t cover, dark, print;
    } book[3] = {{0.21, 0.15, 0.026, 0.35, 0x7A2430, 0x4A141C, 0xE2C27A},
                 {0.19, 0.135, 0.02, 0.62, 0x24506B, 0x143346, 0xDCE4E0},
                 {0.165, 0.115, 0.024, 0.2, 0x3E6B3A, 0x24431F, 0xF0D890}};
    int pages =
        painted(s, paint_pages, (Paint){64, 0, paint_colour(0xE6DCC2), {0, 0, 0}, {0, 0, 0}}, 3, (RayMaterial){0});
    double height = place.z;
    for (int k = 0; k < 3; k++) {
        const double board = 0.003;
        int cover = painted(s, paint_book,
                            (Paint){(uint32_t)(65 + k), 5 + k, paint_colour(book[k].cover), paint_colour(book[k].dark),
                                    paint_colour(book[k].print)},
                            1, (RayMaterial){.coat = 0.04, .roughness = 0.12});
        RayFrame at = ray_frame_turned(vec3(place.x, place.y, height + book[k].thick), book[k].turn);
        ray_shape_box(s->mesh, at, vec3(book[k].width - 0.005, book[k].length - 0.005, book[k].thick - board),
                      cell(s, 0.02), 0, pages);
        for (int side = -1; side <= 1; side += 2) {
            RayFrame lid = at;
            lid.origin = ray_frame_point(&at, 0, 0, side * (book[k].thick - board));
            ray_shape_box(s->mesh, lid, vec3(book[k].width, book[k].length, board), cell(s, 0.014), 0, cover);
        }
        RayFrame spine = at;
        spine.origin = ray_frame_point(&at, -book[k].width, 0, 0);
        ray_shape_box(s->mesh, spine, vec3(board, book[k].length, book[k].thick), cell(s, 0.014), 0, cover);
        height += 2 * book[k].thick;
    }
}

static void put_blocks(const Studio *s, Vec3 place) {
    static const double block[3][4] = {{0, 0, 0, 0.3}, {0.115, 0.03, 0, 0.9}, {0.055, 0.01, 1, 0.55}};
    static const uint32_t colour[3] = {0xC23B2E, 0x2F6FA8, 0xE0A422};
    for (int k = 0; k < 3; k++) {
        int face = painted(s, paint_block,
                           (Paint){(uint32_t)(70 + k), 0, paint_colour(0xE3C493), paint_colour(colour[k]), {0, 0, 0}},
                           2, (RayMaterial){.coat = 0.035, .roughness = 0.1});
        const double half = 0.048;
        RayFrame at = ray_frame_turned(vec3_add(place, vec3(block[k][0], block[k][1], half * (1 + 2 * block[k][2]))),
                                       block[k][3]);
        ray_shape_box(s->mesh, at, vec3(half, half, half), cell(s, 0.01), 0, face);
    }
}

static void put_balls_and_pawn(const Studio *s) {
    int marble =
        painted(s, paint_marble, (Paint){81, 0, paint_colour(0xE9E4DA), paint_colour(0x5A6B62), paint_colour(0x8A5A2A)},
                0, (RayMaterial){.coat = 0.06});
    int gold = ray_scene_add_material(
        s->scene,
        (RayMaterial){.texture = -1, .tint = {1.0, 0.74, 0.36}, .coat = 0.92, .roughness = 0.015, .metal = true});
    int checker = painted(s, paint_checker, (Paint){82, 8, paint_colour(0xEDE6D6), paint_colour(0x1F2A33), {0, 0, 0}},
                          1, (RayMaterial){.coat = 0.05});
    int lacquer =
        ray_scene_add_material(s->scene, (RayMaterial){.texture = -1, .tint = paint_colour(0x9E1B1B), .coat = 0.06});
    const double on_cloth = 0.004;
    ray_shape_ball(s->mesh, ray_frame_along(vec3(-0.13, -0.19, 0.125 + on_cloth), vec3(0.5, 0.3, 1)), 0.125,
                   cells(s, 112), marble);
    ray_shape_ball(s->mesh, ray_frame_turned(vec3(0.2, -0.1, 0.105 + on_cloth), 0), 0.105, cells(s, 112), gold);
    ray_shape_ball(s->mesh, ray_frame_along(vec3(0.56, -0.3, 0.08), vec3(0.6, -0.4, 1)), 0.08, cells(s, 80), checker);
    static const RayOutline pawn[] = {{0.062, 0},    {0.062, 0.015}, {0.058, 0.028}, {0.058, 0.028}, {0.045, 0.035},
                                      {0.026, 0.08}, {0.021, 0.13},  {0.021, 0.13},  {0.038, 0.14},  {0.021, 0.15},
                                      {0.021, 0.15}, {0.034, 0.162}, {0.042, 0.187}, {0.034, 0.214}, {0.0, 0.227}};
    ray_shape_turned(s->mesh, ray_frame_turned(vec3(0.03, 0.1, on_cloth), 0), pawn, 15,
                     (RayGrid){cells(s, 64), cells(s, 90), 1, 1, lacquer});
}

void scene_studio_build(const SceneRequest *request, RayScene *scene, ScenePath *path) {
    Studio s = {request, scene, &scene->mesh};
    build_walls(&s);
    build_lamps(&s);
    build_floor(&s);
    build_table(&s);
    put_vase(&s, ray_frame_turned(vec3(-0.3, 0.2, 0.003), 0.4));
    put_bowl(&s, vec3(-0.62, -0.16, 0.003));
    put_books(&s, vec3(0.42, 0.24, 0.003));
    put_blocks(&s, vec3(0.1, -0.46, 0.0));
    put_balls_and_pawn(&s);
    *path = (ScenePath){.target = {0, 0, 0.1},
                        .radius = 1.42,
                        .height = 0.74,
                        .start_rad = -1.9,
                        .sweep_rad = 2 * PI,
                        .sway = 0.06,
                        .fov_x_rad = 57 * PI / 180};
}
