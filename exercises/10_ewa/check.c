// check.c - E10: what the projection of a Gaussian onto the screen, and its gradient by the mean, must fulfil.
#include "exercises/harness/blob_picture.h"
#include "exercises/harness/camera_case.h"
#include "exercises/harness/catalogue.h"

#include "kernels/shared.h"

#include <math.h>
#include <string.h>

static const double LOW_PASS = 0.3; // px^2

static CameraCase case_of(const double *in) {
    CameraCase c;
    memcpy(&c, in, sizeof c);
    return c;
}

// What the functions are given.
typedef struct {
    Camera camera;
    Vec3 mean; // in camera axes
    Sym3 shape;
} View;

static View view_of(const CameraCase *c) {
    return (View){camera_case_camera(c), camera_case_mean(c), camera_case_shape(c)};
}

static Sym2 call(Trial *trial, const View *view) {
    double c[CAM_NUMBERS], t[3] = {view->mean.x, view->mean.y, view->mean.z}, S2[3];
    double S3[6] = {view->shape.xx, view->shape.xy, view->shape.xz, view->shape.yy, view->shape.yz, view->shape.zz};
    camera_case_record(&view->camera, c);
    CALL(trial_call, trial, "cov2_project", IN_ARRAY(c, CAM_NUMBERS), IN_ARRAY(t, 3), IN_ARRAY(S3, 6),
         OUT_ARRAY(S2, 3));
    return (Sym2){S2[0], S2[1], S2[2]};
}

static Vec3 call_vjp(Trial *trial, const View *view, const double dS2[3]) {
    double c[CAM_NUMBERS], t[3] = {view->mean.x, view->mean.y, view->mean.z}, dt[3];
    double S3[6] = {view->shape.xx, view->shape.xy, view->shape.xz, view->shape.yy, view->shape.yz, view->shape.zz};
    camera_case_record(&view->camera, c);
    CALL(trial_call, trial, "cov2_project_vjp", IN_ARRAY(c, CAM_NUMBERS), IN_ARRAY(t, 3), IN_ARRAY(S3, 6),
         IN_ARRAY(dS2, 3), OUT_ARRAY(dt, 3));
    return vec3(dt[0], dt[1], dt[2]);
}

static Sym2 reference(const View *view) {
    return sym2_add_diagonal(reference_ewa_forward(&view->camera, view->mean, view->shape), LOW_PASS);
}

static void same(Trial *trial, const char *claim, Sym2 yours, Sym2 want) {
    trial_near(trial, claim, (double[]){yours.xx, yours.xy, yours.yy}, (double[]){want.xx, want.xy, want.yy}, 3,
               want.xx + want.yy);
}

// ---- where the mean lies ----

// How far the ratio is inside (> 0) or outside of the range that J leaves alone, as a share of the range.
static double inside_by(double ratio, double size, double focal, double centre) {
    double beyond = (double)FRUSTUM_MARGIN * size / 2, width = (size + 2 * beyond) / focal;
    double low = (-centre - beyond) / focal, high = (size - centre + beyond) / focal;
    return fmin(ratio - low, high - ratio) / width;
}

typedef struct {
    double x, y;
} Inside;

static Inside inside_of(const CameraCase *c) {
    return (Inside){inside_by(c->ratio[0], c->width, c->fx, c->cx), inside_by(c->ratio[1], c->height, c->fy, c->cy)};
}

static const double CLEAR = 0.01; // share of the range: cases keep away from its end, where the derivative jumps

static bool is_inside(const CameraCase *c) {
    Inside inside = inside_of(c);
    return camera_case_allows(c) && inside.x > CLEAR && inside.y > CLEAR;
}

static bool is_outside(const CameraCase *c) {
    Inside inside = inside_of(c);
    return camera_case_allows(c) && fabs(inside.x) > CLEAR && fabs(inside.y) > CLEAR && (inside.x < 0 || inside.y < 0);
}

static void draw_inside(Rng *rng, int k, double *in) {
    (void)k;
    CameraCase c;
    camera_case_draw(rng, 1.2, &c);
    memcpy(in, &c, sizeof c);
}

static bool allows_inside(const double *in) {
    CameraCase c = case_of(in);
    return is_inside(&c);
}

static bool allows_outside(const double *in) {
    CameraCase c = case_of(in);
    return is_outside(&c);
}

// Beyond the left and right edge, the upper and lower one, a corner.
static void draw_outside(Rng *rng, int k, double *in) {
    do {
        CameraCase c;
        camera_case_draw(rng, 1.2, &c);
        double far_x = rng_range(rng, -4, 4), far_y = rng_range(rng, -4, 4);
        if (k % 3 != 1) c.ratio[0] = (c.width * (1 + far_x) / 2 - c.cx) / c.fx;
        if (k % 3 != 0) c.ratio[1] = (c.height * (1 + far_y) / 2 - c.cy) / c.fy;
        memcpy(in, &c, sizeof c);
    } while (!allows_outside(in));
}

// ---- rungs ----

static CameraCase ahead_of(const double *in) {
    CameraCase c = case_of(in);
    c.quat[0] = 1, c.quat[1] = c.quat[2] = c.quat[3] = 0;
    c.ratio[0] = c.ratio[1] = 0;
    return c;
}

static bool allows_ahead(const double *in) {
    CameraCase c = ahead_of(in);
    return is_inside(&c);
}

static void ahead(Trial *trial, const double *in) {
    CameraCase c = ahead_of(in);
    View view = view_of(&c);
    double x = c.fx / c.depth, y = c.fy / c.depth;
    Sym3 s = view.shape;
    same(trial, "S2 = xx, xy, yy straight ahead: (fx/z)^2 xx, fx fy/z^2 xy, (fy/z)^2 yy of S3, and 0.3 added",
         call(trial, &view), (Sym2){x * x * s.xx + LOW_PASS, x * y * s.xy, y * y * s.yy + LOW_PASS});
}

static CameraCase ball_of(const double *in) {
    CameraCase c = case_of(in);
    c.quat[0] = 1, c.quat[1] = c.quat[2] = c.quat[3] = 0;
    c.log_scale[1] = c.log_scale[2] = c.log_scale[0];
    c.ratio[1] *= c.fy / c.fx;
    c.fy = c.fx;
    return c;
}

static bool allows_ball(const double *in) {
    CameraCase c = ball_of(in);
    return is_inside(&c);
}

// A ball of radius s at depth z, angle theta off the axis: radial f s / (z cos theta), tangential f s / z.
static void ball(Trial *trial, const double *in) {
    CameraCase c = ball_of(in);
    View view = view_of(&c);
    Sym2 S2 = sym2_add_diagonal(call(trial, &view), -LOW_PASS);
    double off = hypot(c.ratio[0], c.ratio[1]), tangential = pow(c.fx * exp(c.log_scale[0]) / c.depth, 2);
    double radial = tangential * (1 + off * off); // 1 / cos^2 theta = 1 + tan^2 theta
    double x = off > 0 ? c.ratio[0] / off : 1, y = off > 0 ? c.ratio[1] / off : 0;
    trial_near(trial, "a ball's variance along the radius (f s/(z cos th))^2, across it (f s/z)^2, and between them 0",
               (double[]){x * x * S2.xx + 2 * x * y * S2.xy + y * y * S2.yy,
                          y * y * S2.xx - 2 * x * y * S2.xy + x * x * S2.yy,
                          x * y * (S2.yy - S2.xx) + (x * x - y * y) * S2.xy},
               (double[]){radial, tangential, 0}, 3, radial + LOW_PASS);
}

static CameraCase beside_of(const double *in) {
    CameraCase c = case_of(in);
    c.quat[0] = 1, c.quat[1] = c.quat[2] = c.quat[3] = 0;
    return c;
}

static bool allows_beside(const double *in) {
    CameraCase c = beside_of(in);
    return is_inside(&c);
}

static void beside(Trial *trial, const double *in) {
    CameraCase c = beside_of(in);
    View view = view_of(&c);
    same(trial, "S2 = xx, xy, yy of an ellipsoid off the axis", call(trial, &view), reference(&view));
}

static void projected(Trial *trial, const double *in) {
    CameraCase c = case_of(in);
    View view = view_of(&c);
    same(trial, "S2 = xx, xy, yy", call(trial, &view), reference(&view));
}

enum { TURN = CAMERA_CASE_NUMBERS, GROWTH = TURN + 4, GAUGE_NUMBERS = GROWTH + 1 };

static void draw_gauge(Rng *rng, int k, double *in) {
    k % 2 ? draw_outside(rng, k, in) : draw_inside(rng, k, in);
    for (int i = 0; i < 4; i++) in[TURN + i] = rng_normal(rng);
    in[GROWTH] = exp(rng_range(rng, -5, 5));
}

static bool allows_gauge(const double *in) {
    CameraCase c = case_of(in);
    double turn = 0;
    for (int i = 0; i < 4; i++) turn += in[TURN + i] * in[TURN + i];
    return camera_case_allows(&c) && turn > 0 && in[GROWTH] > 1e-3 && in[GROWTH] < 1e3;
}

// The world is turned and grown, and the camera with it.
static void gauge(Trial *trial, const double *in) {
    CameraCase c = case_of(in);
    View view = view_of(&c), other = view;
    Mat3 turn = camera_rotation_from_quaternion(in + TURN), back = mat3_transpose(&turn);
    double k = in[GROWTH];
    other.camera.rotation = mat3_multiply(&view.camera.rotation, &back);
    other.camera.translation = vec3_scale(view.camera.translation, k);
    other.mean = vec3_scale(view.mean, k);
    Sym3 s = sym3_turned(view.shape, &turn);
    other.shape = (Sym3){k * k * s.xx, k * k * s.xy, k * k * s.xz, k * k * s.yy, k * k * s.yz, k * k * s.zz};
    Sym2 before = call(trial, &view), after = call(trial, &other);
    same(trial, "S2 after turning the world with the camera in it and growing sizes and distances alike: as before",
         after, before);
}

enum { D_S2 = CAMERA_CASE_NUMBERS, GRADIENT_NUMBERS = D_S2 + 3 };

static void draw_gradient_inside(Rng *rng, int k, double *in) {
    draw_inside(rng, k, in);
    for (int i = 0; i < 3; i++) in[D_S2 + i] = rng_normal(rng);
}

static void draw_gradient_outside(Rng *rng, int k, double *in) {
    draw_outside(rng, k, in);
    for (int i = 0; i < 3; i++) in[D_S2 + i] = rng_normal(rng);
}

static void draw_gradient(Rng *rng, int k, double *in) {
    k % 2 ? draw_gradient_outside(rng, k, in) : draw_gradient_inside(rng, k, in);
}

static bool allows_gradient(const double *in) { return allows_inside(in) || allows_outside(in); }

// What d_mean is made of: it can be no larger than about this.
static double gradient_scale(const View *view, const double *dS2) {
    Sym2 s = reference(view);
    double off = hypot(view->mean.x, view->mean.y) / view->mean.z;
    double largest = fabs(dS2[0]) + fabs(dS2[1]) + fabs(dS2[2]);
    return largest > 0 ? largest * (s.xx + s.yy) * (1 + off) / view->mean.z : 1;
}

static void gradient(Trial *trial, const double *in) {
    CameraCase c = case_of(in);
    View view = view_of(&c);
    const double *d = in + D_S2;
    Vec3 yours = call_vjp(trial, &view, d), want = {0};
    Sym3 unused = {0};
    reference_ewa_backward(&view.camera, view.mean, view.shape, (Sym2){d[0], d[1], d[2]}, &want, &unused);
    trial_near(trial, "dt: the gradient by the mean in camera axes", (double[]){yours.x, yours.y, yours.z},
               (double[]){want.x, want.y, want.z}, 3, gradient_scale(&view, d));
}

// d (dS2 . S2) along one axis, from the answer's own cov2_project(), by central differences of fourth order.
static double slope(Trial *trial, const View *view, const double *d, double *number) {
    static const double WEIGHTS[4] = {1.0 / 12, -8.0 / 12, 8.0 / 12, -1.0 / 12};
    static const int STEPS[4] = {-2, -1, 1, 2};
    double h = 1e-3 * view->mean.z, sum = 0, keep = *number;
    for (int i = 0; i < 4; i++) {
        *number = keep + h * STEPS[i];
        Sym2 s = call(trial, view);
        sum += WEIGHTS[i] * (d[0] * s.xx + d[1] * s.xy + d[2] * s.yy);
    }
    *number = keep;
    return sum / h;
}

static void own(Trial *trial, const double *in) {
    CameraCase c = case_of(in);
    View view = view_of(&c);
    const double *d = in + D_S2;
    double want[3] = {slope(trial, &view, d, &view.mean.x), slope(trial, &view, d, &view.mean.y),
                      slope(trial, &view, d, &view.mean.z)};
    Vec3 yours = call_vjp(trial, &view, d);
    trial_near(trial, "dt, against central differences of your own cov2_project()",
               (double[]){yours.x, yours.y, yours.z}, want, 3, gradient_scale(&view, d));
}

static bool picture_of(Subject *subject, const CameraCase *c, ImageF *yours, ImageF *expected) {
    View view = view_of(c);
    Trial trial = {.subject = subject};
    Sym2 mine = call(&trial, &view), want = reference(&view);
    bool good = !trial.failed;
    trial_free(&trial);
    if (!good) return false;
    *yours = blob_picture(mine, blob_picture_fit(want));
    *expected = blob_picture(want, blob_picture_fit(want));
    return true;
}

static bool picture(Subject *subject, const double *in, ImageF *yours, ImageF *expected) {
    CameraCase c = case_of(in);
    return picture_of(subject, &c, yours, expected);
}

static bool picture_ahead(Subject *subject, const double *in, ImageF *yours, ImageF *expected) {
    CameraCase c = ahead_of(in);
    return picture_of(subject, &c, yours, expected);
}

static bool picture_ball(Subject *subject, const double *in, ImageF *yours, ImageF *expected) {
    CameraCase c = ball_of(in);
    return picture_of(subject, &c, yours, expected);
}

static bool picture_beside(Subject *subject, const double *in, ImageF *yours, ImageF *expected) {
    CameraCase c = beside_of(in);
    return picture_of(subject, &c, yours, expected);
}

static const Rung RUNGS[] = {
    {.name = "ahead",
     .claim = "straight ahead of an unturned camera, the splat's front view times (f/z)^2, and the low-pass",
     .count = CAMERA_CASE_NUMBERS,
     .draw = draw_inside,
     .allows = allows_ahead,
     .check = ahead,
     .picture = picture_ahead},
    {.name = "ball",
     .claim = "off the axis a ball is drawn longer along the radius, by 1/cos theta",
     .count = CAMERA_CASE_NUMBERS,
     .draw = draw_inside,
     .allows = allows_ball,
     .check = ball,
     .picture = picture_ball},
    {.name = "beside",
     .claim = "off the axis the depth of an ellipsoid mixes in through the third column of J",
     .count = CAMERA_CASE_NUMBERS,
     .draw = draw_inside,
     .allows = allows_beside,
     .check = beside,
     .picture = picture_beside},
    {.name = "turned",
     .claim = "a turned camera sees the world's covariance in its own axes",
     .count = CAMERA_CASE_NUMBERS,
     .draw = draw_inside,
     .allows = allows_inside,
     .check = projected,
     .picture = picture},
    {.name = "outside",
     .claim = "beyond the margin around the picture, J is taken at the margin",
     .count = CAMERA_CASE_NUMBERS,
     .draw = draw_outside,
     .allows = allows_outside,
     .check = projected,
     .picture = picture},
    {.name = "gauge",
     .claim = "turning the world with the camera, and growing sizes and distances alike, changes nothing",
     .count = GAUGE_NUMBERS,
     .draw = draw_gauge,
     .allows = allows_gauge,
     .check = gauge},
    {.name = "gradient",
     .claim = "inside the picture the mean moves the shape through z, x/z and y/z",
     .count = GRADIENT_NUMBERS,
     .double_only = true,
     .draw = draw_gradient_inside,
     .allows = allows_inside,
     .check = gradient},
    {.name = "clamped",
     .claim = "where x/z or y/z is clamped, it passes no gradient",
     .count = GRADIENT_NUMBERS,
     .double_only = true,
     .draw = draw_gradient_outside,
     .allows = allows_outside,
     .check = gradient},
    {.name = "own",
     .claim = "the gradient is the derivative of your own projection",
     .cases = 4,
     .count = GRADIENT_NUMBERS,
     .double_only = true,
     .draw = draw_gradient,
     .allows = allows_gradient,
     .check = own},
};

const Exercise EXERCISE_EWA = {
    .number = 10,
    .name = "ewa",
    .title = "the ellipse that a Gaussian makes on the screen",
    .minutes = 70,
    .unlocks = "your projection in the picture: splatlab render --mine",
    .rungs = RUNGS,
    .rung_count = sizeof RUNGS / sizeof *RUNGS,
};
