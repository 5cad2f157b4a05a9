// check.c - E09: what a projection and its derivative must fulfil.
#include "exercises/harness/catalogue.h"
#include "exercises/harness/line_picture.h"
#include "splat3d/camera.h"
#include "splat3d/reference.h"

#include <string.h>

// A case begins with a camera: width height fx fy cx cy, its turn as a quaternion, t; then comes a point of three numbers.
enum {
    WIDTH,
    HEIGHT,
    FX,
    FY,
    CX,
    CY,
    TURN,
    SHIFT = TURN + 4,
    CAMERA = SHIFT + 3,
    POINT = CAMERA,
    CASE = POINT + 3,
    CAM = 18
};

enum { SIDE_MIN = 8 };               // px
static const double MARGIN = 1e-3;   // world units that depths keep from the near plane
static const double RATIO_MAX = 1.2; // |x/z|, |y/z|: beyond the picture's edges, too
static const double DEPTH_MIN = 0.25, DEPTH_MAX = 40;

static double near_depth(void) { return (double)NEAR_DEPTH; }

// ---- cameras and points ----

static Camera camera_of(const double *in) {
    Camera camera = {.width = (int)in[WIDTH], .height = (int)in[HEIGHT], .fx = in[FX], .fy = in[FY], .cx = in[CX]};
    camera.cy = in[CY];
    camera.rotation = reference_rotation_forward(in + TURN);
    camera.translation = vec3(in[SHIFT], in[SHIFT + 1], in[SHIFT + 2]);
    return camera;
}

// The record Cam of exercise.h.
static void numbers_of(const Camera *camera, double c[CAM]) {
    const double head[6] = {camera->width, camera->height, camera->fx, camera->fy, camera->cx, camera->cy};
    memcpy(c, head, sizeof head);
    memcpy(c + 6, camera->rotation.m, sizeof camera->rotation.m);
    memcpy(c + 15, &camera->translation.x, 3 * sizeof *c);
}

static Vec3 point_of(const double *numbers) { return vec3(numbers[0], numbers[1], numbers[2]); }

// No square pixels, no square pictures, no centre in the middle.
static void draw_camera(Rng *rng, double *in) {
    in[WIDTH] = SIDE_MIN + rng_below(rng, 1000);
    in[HEIGHT] = SIDE_MIN + rng_below(rng, 1000);
    in[FX] = exp(rng_range(rng, log(50), log(1500)));
    in[FY] = in[FX] * rng_range(rng, 0.6, 1.6);
    in[CX] = in[WIDTH] * rng_range(rng, 0.2, 0.8);
    in[CY] = in[HEIGHT] * rng_range(rng, 0.2, 0.8);
    for (int i = 0; i < 4; i++) in[TURN + i] = rng_normal(rng);
    for (int i = 0; i < 3; i++) in[SHIFT + i] = rng_range(rng, -3, 3);
    for (int i = 0; i < CAMERA; i++)
        in[i] = (double)(float)in[i]; // points are then placed in the very camera that is tried
}

static bool allows_camera(const double *in) {
    double length = 0;
    for (int i = 0; i < 4; i++) length += in[TURN + i] * in[TURN + i];
    return in[WIDTH] >= SIDE_MIN && in[HEIGHT] >= SIDE_MIN && in[WIDTH] == floor(in[WIDTH]) &&
           in[HEIGHT] == floor(in[HEIGHT]) && in[FX] >= 1 && in[FY] >= 1 && length > 1e-3;
}

static void put_point(const double *in, Vec3 point_cam, double *point_world) {
    Camera camera = camera_of(in);
    Mat3 to_world = mat3_transpose(&camera.rotation);
    Vec3 p = mat3_apply(&to_world, vec3_sub(point_cam, camera.translation));
    point_world[0] = p.x, point_world[1] = p.y, point_world[2] = p.z;
}

static Vec3 draw_point_cam(Rng *rng, double depth) {
    double x = rng_range(rng, -RATIO_MAX, RATIO_MAX), y = rng_range(rng, -RATIO_MAX, RATIO_MAX);
    return vec3(x * depth, y * depth, depth);
}

static double draw_depth(Rng *rng) { return exp(rng_range(rng, log(DEPTH_MIN), log(DEPTH_MAX))); }

static double depth_of(const double *in) {
    Camera camera = camera_of(in);
    return camera_point(&camera, point_of(in + POINT)).z;
}

static void draw_in_front(Rng *rng, int k, double *in) {
    draw_camera(rng, in);
    put_point(in, draw_point_cam(rng, k == 2 ? 0.21 : draw_depth(rng)), in + POINT);
}
static bool allows_in_front(const double *in) { return allows_camera(in) && depth_of(in) >= near_depth() + MARGIN; }

static void draw_unturned(Rng *rng, int k, double *in) {
    (void)k;
    draw_camera(rng, in);
    for (int i = TURN; i < CAMERA; i++) in[i] = i == TURN;
    put_point(in, draw_point_cam(rng, draw_depth(rng)), in + POINT);
}
static bool allows_unturned(const double *in) {
    for (int i = TURN; i < CAMERA; i++)
        if (in[i] != (i == TURN)) return false;
    return allows_in_front(in);
}

// In place of the world point: column and row of a pixel, and a depth.
static void draw_pixel(Rng *rng, int k, double *in) {
    draw_camera(rng, in);
    in[POINT] = k == 0 ? 0 : rng_below(rng, (uint32_t)in[WIDTH]);
    in[POINT + 1] = k == 0 ? 0 : rng_below(rng, (uint32_t)in[HEIGHT]);
    in[POINT + 2] = draw_depth(rng);
}
static bool allows_pixel(const double *in) {
    const double *p = in + POINT;
    return allows_camera(in) && p[0] >= 0 && p[1] >= 0 && p[0] < in[WIDTH] && p[1] < in[HEIGHT] &&
           p[0] == floor(p[0]) && p[1] == floor(p[1]) && p[2] >= near_depth() + MARGIN;
}

// First the centre of the camera and the plane z = 0, exactly; then before the near plane; then behind.
static void draw_behind(Rng *rng, int k, double *in) {
    draw_camera(rng, in);
    double depth = k == 4 ? 0.19 : k == 5 ? rng_range(rng, 0, 0.19) : -draw_depth(rng);
    put_point(in, draw_point_cam(rng, depth), in + POINT);
    if (k > 3) return;
    for (int i = 0; i < 4; i++) in[TURN + i] = i == 0;
    for (int i = 0; i < 3; i++) {
        if (k < 2) in[SHIFT + i] = 0;
        if (k % 2 == 0 || i == 2) in[POINT + i] = 0 - in[SHIFT + i];
    }
}
static bool allows_behind(const double *in) { return allows_camera(in) && depth_of(in) <= near_depth() - MARGIN; }

static void draw_point_in_camera(Rng *rng, int k, double *in) {
    (void)k;
    draw_camera(rng, in);
    Vec3 t = draw_point_cam(rng, draw_depth(rng));
    in[POINT] = t.x, in[POINT + 1] = t.y, in[POINT + 2] = t.z;
}
static bool allows_point_in_camera(const double *in) {
    return allows_camera(in) && in[POINT + 2] >= near_depth() + MARGIN;
}

static void draw_step(Rng *rng, int k, double *in) {
    (void)k;
    draw_in_front(rng, 0, in);
    for (int i = 0; i < 3; i++) in[CASE + i] = rng_normal(rng);
}
static bool allows_step(const double *in) { return depth_of(in) >= DEPTH_MIN - MARGIN && allows_camera(in); }

// ---- the projection ----

typedef struct {
    double uv[2], z, returned;
} Place;

static Place call(Trial *trial, const Camera *camera, Vec3 point_world) {
    double c[CAM], p[3] = {point_world.x, point_world.y, point_world.z}, uv[2], z, returned;
    numbers_of(camera, c);
    CALL(trial_call, trial, "project", IN_ARRAY(c, CAM), IN_ARRAY(p, 3), OUT_ARRAY(uv, 2), OUT(z), OUT(returned));
    return (Place){{uv[0], uv[1]}, z, returned};
}

// What R p + t is a sum of, world units.
static double size_of(const Camera *camera, Vec3 point_world) {
    double size = vec3_length(point_world) + vec3_length(camera->translation);
    return size > 0 ? size : 1;
}

// A rounding of the point, seen through the camera, px.
static double pixel_scale(const Camera *camera, Vec3 point_world) {
    Vec3 t = camera_point(camera, point_world);
    return fmax(camera->fx, camera->fy) * (1 + vec3_length(t) / t.z) * size_of(camera, point_world) / t.z +
           fabs(camera->cx) + fabs(camera->cy);
}

static void expect_place(Trial *trial, const Camera *camera, Vec3 p, const char *claim, const double want[2]) {
    Place yours = call(trial, camera, p);
    trial_near(trial, claim, yours.uv, want, 2, pixel_scale(camera, p));
    trial_near1(trial, "z: the third number of R p + t", yours.z, camera_point(camera, p).z, size_of(camera, p));
    trial_equal(trial, "returned: 1, the point is beyond the near plane", yours.returned, 1);
}

static void pose(Trial *trial, const double *in) {
    Camera camera = camera_of(in);
    double want[2], depth;
    camera_project(&camera, point_of(in + POINT), &want[0], &want[1], &depth);
    expect_place(trial, &camera, point_of(in + POINT), "uv", want);
}

static void pixel(Trial *trial, const double *in) {
    Camera camera = camera_of(in);
    const double want[2] = {in[POINT] + 0.5, in[POINT + 1] + 0.5};
    Vec3 ray = camera_ray(&camera, want[0], want[1]),
         axis = vec3(camera.rotation.m[6], camera.rotation.m[7], camera.rotation.m[8]);
    Vec3 p = vec3_add(camera_position(&camera), vec3_scale(ray, in[POINT + 2] / vec3_dot(ray, axis)));
    expect_place(trial, &camera, p, "uv of a point on the ray through the centre of pixel (i, j): i + 0.5, j + 0.5",
                 want);
}

static void behind(Trial *trial, const double *in) {
    Camera camera = camera_of(in);
    Vec3 p = point_of(in + POINT);
    Place yours = call(trial, &camera, p);
    trial_equal(trial, "returned: 0, the point is not beyond the near plane at 0.2", yours.returned, 0);
    trial_near(trial, "uv of a point that has no place in the picture: 0, 0", yours.uv, (double[]){0, 0}, 2, 1);
    trial_near1(trial, "z: the third number of R p + t", yours.z, camera_point(&camera, p).z, size_of(&camera, p));
}

// ---- its derivative ----

static void call_jac(Trial *trial, const Camera *camera, Vec3 point_cam, double J[6]) {
    double c[CAM], t[3] = {point_cam.x, point_cam.y, point_cam.z};
    numbers_of(camera, c);
    CALL(trial_call, trial, "project_jac", IN_ARRAY(c, CAM), IN_ARRAY(t, 3), ARG_OUT("J", J, 6));
}

static const double WEIGHT[4] = {1.0 / 12, -8.0 / 12, 8.0 / 12, -1.0 / 12}; // of the values at -2h, -h, h, 2h
static int place_of_step(int step) { return step < 2 ? step - 2 : step - 1; }

// Central differences, of fourth order, of the lab's projection. (The principal point adds nothing to a derivative.)
static void differences(const Camera *camera, Vec3 t, double J[6]) {
    Camera plain = *camera;
    plain.rotation = (Mat3){{1, 0, 0, 0, 1, 0, 0, 0, 1}};
    plain.translation = vec3(0, 0, 0);
    plain.cx = plain.cy = 0;
    double h = 5e-4 * t.z;
    for (int k = 0; k < 3; k++) {
        J[k] = J[3 + k] = 0;
        for (int step = 0; step < 4; step++) {
            double u, v, z, by = place_of_step(step) * h;
            camera_project(&plain, vec3_add(t, vec3(by * (k == 0), by * (k == 1), by * (k == 2))), &u, &v, &z);
            J[k] += WEIGHT[step] / h * u;
            J[3 + k] += WEIGHT[step] / h * v;
        }
    }
}

static double jac_scale(const Camera *camera, Vec3 t) {
    return fmax(camera->fx, camera->fy) / t.z * vec3_length(t) / t.z;
}

static void jacobian(Trial *trial, const double *in) {
    Camera camera = camera_of(in);
    Vec3 t = point_of(in + POINT);
    double J[6], want[6];
    call_jac(trial, &camera, t, J);
    differences(&camera, t, want);
    trial_near(trial, "J = du/dx du/dy du/dz, dv/dx dv/dy dv/dz, against central differences of the lab's projection",
               J, want, 6, jac_scale(&camera, t));
}

static void ray(Trial *trial, const double *in) {
    Camera camera = camera_of(in);
    Vec3 t = point_of(in + POINT);
    double J[6];
    call_jac(trial, &camera, t, J);
    const double yours[2] = {vec3_dot(vec3(J[0], J[1], J[2]), t), vec3_dot(vec3(J[3], J[4], J[5]), t)};
    trial_near(trial, "J t: 0, 0, as a point that moves along its ray stays where it is", yours, (double[]){0, 0}, 2,
               jac_scale(&camera, t) * vec3_length(t));
}

// A step v in the world moves uv by J R v: yours against yours, no reference in it.
static void chain(Trial *trial, const double *in) {
    Camera camera = camera_of(in);
    Vec3 p = point_of(in + POINT), v = point_of(in + CASE), t = camera_point(&camera, p);
    double slope[2] = {0}, J[6], length = vec3_length(v) > 0 ? vec3_length(v) : 1, h = 5e-4 * t.z / length;
    for (int step = 0; step < 4; step++) {
        Place place = call(trial, &camera, vec3_add(p, vec3_scale(v, place_of_step(step) * h)));
        for (int i = 0; i < 2; i++) slope[i] += WEIGHT[step] / h * place.uv[i];
    }
    call_jac(trial, &camera, t, J);
    Vec3 turned = mat3_apply(&camera.rotation, v);
    const double yours[2] = {vec3_dot(vec3(J[0], J[1], J[2]), turned), vec3_dot(vec3(J[3], J[4], J[5]), turned)};
    trial_near(trial, "J R v for a step v in the world: the change of uv, by central differences of your own project()",
               yours, slope, 2, jac_scale(&camera, t) * length * size_of(&camera, p) / t.z);
}

// ---- pictures ----

enum { SIDE = 200, ZOOM_PX = 8, ARROW_PX = 80 };

// Left: the whole picture with the place in it. Right: the pixels around the right place, eight to a side.
static ImageF draw_place(const Camera *camera, const double uv[2], const double around[2]) {
    ImageF image = line_picture_create(2 * SIDE, SIDE);
    double scale = 0.5 * SIDE / fmax(camera->width, camera->height);
    double low[2] = {SIDE / 2 - 0.5 * scale * camera->width, SIDE / 2 - 0.5 * scale * camera->height};
    double high[2] = {low[0] + scale * camera->width, low[1] + scale * camera->height};
    line_picture_box(&image, low, high, LINE_GREY);
    double at[2] = {low[0] + scale * uv[0], low[1] + scale * uv[1]};
    if (at[0] < SIDE) line_picture_cross(&image, at, 6, LINE_YELLOW);
    double cell = (double)SIDE / ZOOM_PX, corner[2] = {floor(around[0]) - ZOOM_PX / 2, floor(around[1]) - ZOOM_PX / 2};
    for (int i = 0; i <= ZOOM_PX; i++) {
        line_picture_line(&image, (double[]){SIDE + i * cell, 0}, (double[]){SIDE + i * cell, SIDE}, LINE_GREY);
        line_picture_line(&image, (double[]){SIDE, i * cell}, (double[]){2 * SIDE, i * cell}, LINE_GREY);
    }
    double zoomed[2] = {SIDE + (uv[0] - corner[0]) * cell, (uv[1] - corner[1]) * cell};
    if (zoomed[0] >= SIDE) line_picture_cross(&image, zoomed, 8, LINE_YELLOW);
    return image;
}

static bool picture_of_point(Subject *subject, const Camera *camera, Vec3 point, ImageF *yours, ImageF *reference) {
    double c[CAM], p[3] = {point.x, point.y, point.z}, uv[2], z, returned, want[2] = {0}, depth;
    numbers_of(camera, c);
    if (!CALL(subject_call, subject, "project", IN_ARRAY(c, CAM), IN_ARRAY(p, 3), OUT_ARRAY(uv, 2), OUT(z),
              OUT(returned)))
        return false;
    camera_project(camera, point, &want[0], &want[1], &depth);
    *yours = draw_place(camera, uv, want);
    *reference = draw_place(camera, want, want);
    return true;
}

static bool picture(Subject *subject, const double *in, ImageF *yours, ImageF *reference) {
    Camera camera = camera_of(in);
    return picture_of_point(subject, &camera, point_of(in + POINT), yours, reference);
}

// The columns of J: where the place moves when the point moves along x (red), y (green), z (blue).
static ImageF draw_columns(const double J[6], double scale) {
    ImageF image = line_picture_create(SIDE, SIDE);
    static const float *const RGB[3] = {LINE_RED, LINE_GREEN, LINE_BLUE};
    const double middle[2] = {SIDE / 2, SIDE / 2};
    for (int k = 0; k < 3; k++) {
        double tip[2] = {middle[0] + scale * J[k], middle[1] + scale * J[3 + k]};
        line_picture_arrow(&image, middle, tip, RGB[k]);
    }
    return image;
}

static bool picture_of_columns(Subject *subject, const double *in, ImageF *yours, ImageF *reference) {
    Camera camera = camera_of(in);
    double c[CAM], J[6], want[6], largest = 0;
    const double *t = in + POINT;
    numbers_of(&camera, c);
    if (!CALL(subject_call, subject, "project_jac", IN_ARRAY(c, CAM), IN_ARRAY(t, 3), OUT_ARRAY(J, 6))) return false;
    differences(&camera, point_of(t), want);
    for (int k = 0; k < 3; k++) largest = fmax(largest, hypot(want[k], want[3 + k]));
    *yours = draw_columns(J, ARROW_PX / largest);
    *reference = draw_columns(want, ARROW_PX / largest);
    return true;
}

static const Rung RUNGS[] = {
    {.name = "unturned",
     .claim = "a camera at the origin that looks along z sees (x, y, z) at (fx x/z + cx, fy y/z + cy)",
     .count = CASE,
     .draw = draw_unturned,
     .allows = allows_unturned,
     .check = pose,
     .picture = picture},
    {.name = "pose",
     .claim = "a camera anywhere sees the point R p + t",
     .count = CASE,
     .draw = draw_in_front,
     .allows = allows_in_front,
     .check = pose,
     .picture = picture},
    {.name = "pixel",
     .claim = "what lies on the ray through the centre of pixel (i, j) comes back to (i + 0.5, j + 0.5)",
     .count = CASE,
     .draw = draw_pixel,
     .allows = allows_pixel,
     .check = pixel},
    {.name = "behind",
     .claim = "a point that is not beyond the near plane is refused: 0 is returned, and no number is NaN",
     .count = CASE,
     .draw = draw_behind,
     .allows = allows_behind,
     .check = behind},
    {.name = "jacobian",
     .claim = "J is the derivative of uv by the point in camera axes",
     .count = CASE,
     .draw = draw_point_in_camera,
     .allows = allows_point_in_camera,
     .check = jacobian,
     .picture = picture_of_columns},
    {.name = "ray",
     .claim = "a point that moves along its ray stays put: J t = 0",
     .count = CASE,
     .draw = draw_point_in_camera,
     .allows = allows_point_in_camera,
     .check = ray,
     .picture = picture_of_columns},
    {.name = "chain",
     .claim = "J belongs to your own project(): a step v in the world moves uv by J R v",
     .count = CASE + 3,
     .double_only = true,
     .draw = draw_step,
     .allows = allows_step,
     .check = chain},
};

const Exercise EXERCISE_CAMERA = {
    .number = 9,
    .name = "camera",
    .title = "from a point in the world to a pixel, and how the pixel moves with it",
    .minutes = 50,
    .unlocks = "your own camera: splatlab render --mine",
    .rungs = RUNGS,
    .rung_count = sizeof RUNGS / sizeof *RUNGS,
};
