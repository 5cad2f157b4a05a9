// check.c - E11: what a Monte Carlo projection must fulfil, and what it must find out about EWA.
//
// Expected moments come from perspective.h, an integral and no draw; tolerances are multiples of the standard errors that
// the same integral gives. The laws of the last two rungs are the ones that the page states.
#include "exercises/harness/camera_case.h"
#include "exercises/harness/catalogue.h"
#include "exercises/harness/cut_draws.h"
#include "exercises/harness/ewa_picture.h"
#include "exercises/harness/perspective.h"

#include <math.h>
#include <string.h>

enum { SAMPLES = 6000, LAW_SAMPLES = 3000, SEED_COUNT = 1000000 };
static const double SIGMAS = 5;         // of the standard error: a right answer leaves them once in a million times
static const double FLOAT_ERROR = 2e-4; // relative: what a sum of SAMPLES numbers loses in float

// ---- cases: a camera and a splat, and a seed ----

enum { SEED = CAMERA_CASE_NUMBERS, NUMBERS = SEED + 1 };

static CameraCase case_of(const double *in) {
    CameraCase c;
    memcpy(&c, in, sizeof c);
    return c;
}

static double largest_log(const CameraCase *c) { return fmax(c->log_scale[0], fmax(c->log_scale[1], c->log_scale[2])); }

// The largest standard deviation becomes `size` times the depth.
static void draw_of_size(Rng *rng, double size, double *in) {
    CameraCase c;
    camera_case_draw(rng, 0.9, &c);
    double change = log(size * c.depth) - largest_log(&c);
    for (int i = 0; i < 3; i++) c.log_scale[i] += change;
    memcpy(in, &c, sizeof c);
    in[SEED] = 1 + rng_below(rng, SEED_COUNT);
}

static bool is_case(const double *in, double size_max) {
    CameraCase c = case_of(in);
    return camera_case_allows(&c) && in[SEED] >= 0 && in[SEED] <= SEED_COUNT && in[SEED] == floor(in[SEED]) &&
           largest_log(&c) <= log(1.001 * size_max * c.depth) && fabs(c.ratio[0]) < 3 && fabs(c.ratio[1]) < 3;
}

typedef struct {
    Camera camera;
    Vec3 mean_world, mean_cam;
    Sym3 world, in_camera; // covariance
} View;

static View view_of(const CameraCase *c) {
    View v = {.camera = camera_case_camera(c), .mean_cam = camera_case_mean(c), .world = camera_case_shape(c)};
    Mat3 to_world = mat3_transpose(&v.camera.rotation);
    v.mean_world = mat3_apply(&to_world, vec3_sub(v.mean_cam, v.camera.translation));
    v.in_camera = sym3_turned(v.world, &v.camera.rotation);
    return v;
}

static Vec3 centre_of(const View *v) {
    Vec3 p = v->mean_cam;
    return vec3(v->camera.fx * p.x / p.z + v->camera.cx, v->camera.fy * p.y / p.z + v->camera.cy, p.z);
}

typedef struct {
    double mean[2];
    Sym2 cov;
} Found;

static Found call(Trial *t, const View *v, double n, double seed) {
    double c[CAM_NUMBERS], mu[3] = {v->mean_world.x, v->mean_world.y, v->mean_world.z}, cov[3];
    double S3[6] = {v->world.xx, v->world.xy, v->world.xz, v->world.yy, v->world.yz, v->world.zz};
    Found found;
    double *mean = found.mean;
    camera_case_record(&v->camera, c);
    CALL(trial_call, t, "mc_project", IN_ARRAY(c, CAM_NUMBERS), IN_ARRAY(mu, 3), IN_ARRAY(S3, 6), IN(n), IN(seed),
         OUT_ARRAY(mean, 2), OUT_ARRAY(cov, 3));
    found.cov = (Sym2){cov[0], cov[1], cov[2]};
    return found;
}

// Pixel coordinates as they are computed: what rounding is to be compared with.
static double coordinates_of(const View *v) {
    Vec3 centre = centre_of(v);
    return fabs(centre.x) + fabs(centre.y) + fabs(v->camera.cx) + fabs(v->camera.cy) +
           (v->camera.fx + v->camera.fy) * vec3_length(v->camera.translation) / v->mean_cam.z;
}

// ---- rungs of mc_project() ----

enum { COUNT = NUMBERS, POINT_NUMBERS = COUNT + 1 };

static void draw_point(Rng *rng, int k, double *in) {
    draw_of_size(rng, 0.1, in);
    in[COUNT] = 1 + k;
}

static bool allows_point(const double *in) {
    return is_case(in, 0.1) && in[COUNT] >= 1 && in[COUNT] <= 20 && in[COUNT] == floor(in[COUNT]);
}

static void point(Trial *t, const double *in) {
    CameraCase c = case_of(in);
    View view = view_of(&c), speck = view;
    speck.world = (Sym3){0};
    double scale = coordinates_of(&view);
    Vec3 centre = centre_of(&view);
    Found found = call(t, &speck, in[COUNT], in[SEED]);
    trial_near(t, "mean of a Gaussian without extent: the pixel of mu", found.mean, (double[]){centre.x, centre.y}, 2,
               scale);
    trial_near(t, "cov of a Gaussian without extent", (double[]){found.cov.xx, found.cov.xy, found.cov.yy},
               (double[]){0, 0, 0}, 3, scale * scale);
    found = call(t, &view, 1, in[SEED]);
    trial_near(t, "cov of one point (over n, not n - 1)", (double[]){found.cov.xx, found.cov.xy, found.cov.yy},
               (double[]){0, 0, 0}, 3, scale * scale);
}

static void draw_moderate(Rng *rng, int k, double *in) {
    (void)k;
    draw_of_size(rng, 0.1, in);
}

static bool allows_moderate(const double *in) { return is_case(in, 0.1); }

// A tiny ball, at distance 1 from three cameras that look along the three axes. Whatever root L of r^2 I is taken, it is r
// times a rotation, so the sum of all three pictures' variances is that of the draws themselves: an exact number.
enum { DRAWS_SEED, DRAWS_COUNT, DRAWS_NUMBERS };
enum { DRAWS_MAX = 400 };

static void draw_draws(Rng *rng, int k, double *in) {
    in[DRAWS_SEED] = 1 + rng_below(rng, SEED_COUNT);
    in[DRAWS_COUNT] = 2 + (k % 2 ? rng_below(rng, 5) : rng_below(rng, DRAWS_MAX - 2));
}

static bool allows_draws(const double *in) {
    return in[DRAWS_SEED] >= 0 && in[DRAWS_SEED] <= SEED_COUNT && in[DRAWS_SEED] == floor(in[DRAWS_SEED]) &&
           in[DRAWS_COUNT] >= 2 && in[DRAWS_COUNT] <= DRAWS_MAX && in[DRAWS_COUNT] == floor(in[DRAWS_COUNT]);
}

static void draws(Trial *t, const double *in) {
    static const Mat3 LOOKS[3] = {
        {{1, 0, 0, 0, 1, 0, 0, 0, 1}}, {{0, 1, 0, 0, 0, 1, 1, 0, 0}}, {{0, 0, 1, 1, 0, 0, 0, 1, 0}}};
    static const double R = 1e-6;
    double my_mean2 = 0, my_spread = 0, n = in[DRAWS_COUNT];
    CutDraws want = cut_draws((unsigned long)in[DRAWS_SEED], (int)n);
    for (int k = 0; k < 3; k++) {
        View v = {.camera = {.width = 2, .height = 2, .fx = 1, .fy = 1, .rotation = LOOKS[k]}, .mean_cam = {0, 0, 1}};
        Mat3 to_world = mat3_transpose(&LOOKS[k]);
        v.mean_world = mat3_apply(&to_world, v.mean_cam);
        v.world = (Sym3){.xx = R * R, .yy = R * R, .zz = R * R};
        Found found = call(t, &v, n, in[DRAWS_SEED]);
        my_mean2 += (found.mean[0] * found.mean[0] + found.mean[1] * found.mean[1]) / (2 * R * R);
        my_spread += (found.cov.xx + found.cov.yy) / (2 * R * R);
    }
    trial_near1(
        t, "the square of `mean` of a tiny ball, over three views along the axes: that of the n first draws that count",
        my_mean2, want.mean2, 1 + want.mean2);
    trial_near1(t,
                "the trace of `cov` of a tiny ball, over three views along the axes: that of the draws, over 0.917820",
                my_spread, want.spread / ewa_cut_factor(EWA_CUT), 1 + want.spread);
}

// Within SIGMAS standard errors, each number by its own.
static void within(Trial *t, const Found *found, const View *v) {
    Perspective want = perspective_of(&v->camera, v->mean_cam, v->in_camera);
    double root = sqrt(SAMPLES), digits = 1e-6 * coordinates_of(v);
    static const char *const MEAN[2] = {"mean[0], within five standard errors of the exact one",
                                        "mean[1], within five standard errors of the exact one"};
    for (int i = 0; i < 2; i++)
        trial_within(t, MEAN[i], &found->mean[i], &want.mean[i], 1, SIGMAS * want.mean_error[i] / root + digits);
    double trace = want.covariance.xx + want.covariance.yy, lost = FLOAT_ERROR * trace;
    trial_within(t, "cov[0] = xx, within five standard errors of the exact one", &found->cov.xx, &want.covariance.xx, 1,
                 SIGMAS * want.covariance_error.xx / root + lost);
    trial_within(t, "cov[1] = xy, within five standard errors of the exact one", &found->cov.xy, &want.covariance.xy, 1,
                 SIGMAS * want.covariance_error.xy / root + lost);
    trial_within(t, "cov[2] = yy, within five standard errors of the exact one", &found->cov.yy, &want.covariance.yy, 1,
                 SIGMAS * want.covariance_error.yy / root + lost);
}

static void moments(Trial *t, const double *in) {
    CameraCase c = case_of(in);
    View view = view_of(&c);
    Found found = call(t, &view, SAMPLES, in[SEED]);
    within(t, &found, &view);
}

static const double SMALL = 0.004, NEAR = 0.28;

static void draw_small(Rng *rng, int k, double *in) {
    (void)k;
    draw_of_size(rng, SMALL, in);
}

static bool allows_small(const double *in) { return is_case(in, SMALL); }

static const double WIDE = 0.5; // largest standard deviation over the depth, where it lies across the view

// Its standard deviation in depth becomes a share of the depth: that is what perspective bends.
static void draw_near(Rng *rng, int k, double *in) {
    (void)k;
    draw_of_size(rng, 0.1, in);
    CameraCase c = case_of(in);
    double change = log(rng_range(rng, 0.2, NEAR) * c.depth) - log(view_of(&c).in_camera.zz) / 2;
    change = fmin(change, log(WIDE * c.depth) - largest_log(&c));
    for (int i = 0; i < 3; i++) c.log_scale[i] += change;
    memcpy(in, &c, sizeof c);
}

static bool allows_near(const double *in) {
    if (!is_case(in, WIDE)) return false;
    CameraCase c = case_of(in);
    return sqrt(view_of(&c).in_camera.zz) <= 1.001 * NEAR * c.depth;
}

// No extent along one axis, or along two.
static CameraCase flat_of(const double *in) {
    CameraCase c = case_of(in);
    c.log_scale[1] = -INFINITY;
    if ((int)in[SEED] % 2) c.log_scale[2] = -INFINITY;
    return c;
}

static void flat(Trial *t, const double *in) {
    CameraCase c = flat_of(in);
    View view = view_of(&c);
    Found found = call(t, &view, SAMPLES, in[SEED]);
    within(t, &found, &view);
}

enum { ZOOM = NUMBERS, GROWTH, ALIKE_NUMBERS };

static void draw_alike(Rng *rng, int k, double *in) {
    (void)k;
    draw_of_size(rng, 0.15, in);
    in[ZOOM] = exp(rng_range(rng, -1, 1));
    in[GROWTH] = exp(rng_range(rng, -3, 3));
}

static bool allows_alike(const double *in) {
    return is_case(in, 0.15) && in[ZOOM] > 0.1 && in[ZOOM] < 10 && in[GROWTH] > 0.01 && in[GROWTH] < 100;
}

static void alike(Trial *t, const double *in) {
    CameraCase c = case_of(in);
    View view = view_of(&c), other = view;
    enum { SOME = 200 };
    double zoom = in[ZOOM], k = in[GROWTH], k2 = k * k;
    other.camera.fx *= zoom, other.camera.fy *= zoom;
    other.camera.translation = vec3_scale(view.camera.translation, k);
    other.mean_world = vec3_scale(view.mean_world, k);
    Sym3 s = view.world;
    other.world = (Sym3){k2 * s.xx, k2 * s.xy, k2 * s.xz, k2 * s.yy, k2 * s.yz, k2 * s.zz};
    Found before = call(t, &view, SOME, in[SEED]), after = call(t, &other, SOME, in[SEED]);
    double cx = view.camera.cx, cy = view.camera.cy, scale = (1 + zoom) * coordinates_of(&view), z2 = zoom * zoom;
    trial_near(t, "mean less (cx, cy), of a longer focal length in a larger world: longer in proportion",
               (double[]){after.mean[0] - cx, after.mean[1] - cy},
               (double[]){zoom * (before.mean[0] - cx), zoom * (before.mean[1] - cy)}, 2, scale);
    Sym2 b = before.cov, a = after.cov;
    double trace = z2 * (b.xx + b.yy);
    trial_near(t, "cov of a longer focal length in a larger world: larger by the square of the focal lengths' ratio",
               (double[]){a.xx, a.xy, a.yy}, (double[]){z2 * b.xx, z2 * b.xy, z2 * b.yy}, 3,
               trace + scale * sqrt(fabs(trace)) + 1e-30);
}

// ---- rungs of ewa_error() ----

typedef struct {
    double mean[2], cov[3], centre[2], angle, sx, sy;
} ErrorCase;

enum { ERROR_NUMBERS = sizeof(ErrorCase) / sizeof(double) };

static void draw_error(Rng *rng, int k, double *in) {
    ErrorCase c;
    c.angle = rng_range(rng, 0, M_PI);
    c.sx = exp(rng_range(rng, log(0.5), log(60)));
    c.sy = c.sx / exp(rng_range(rng, 0, log(30)));
    for (int i = 0; i < 2; i++) {
        c.centre[i] = rng_range(rng, 0, 500);
        c.mean[i] = c.centre[i] + (k == 0 ? 0 : rng_normal(rng) * c.sx);
    }
    Sym2 cov = covariance_from_angle(c.angle + 0.3 * rng_normal(rng), c.sx * rng_range(rng, 0.7, 1.5), //
                                     c.sy * rng_range(rng, 0.7, 1.5));
    c.cov[0] = cov.xx, c.cov[1] = cov.xy, c.cov[2] = cov.yy;
    memcpy(in, &c, sizeof c);
}

static bool allows_error(const double *in) {
    ErrorCase c;
    memcpy(&c, in, sizeof c);
    return c.sx > 1e-2 && c.sy > 1e-2 && c.sx < 30.1 * c.sy && c.sy < 30.1 * c.sx;
}

typedef struct {
    double shift, relative;
} Measured;

static Measured call_error(Trial *t, const Found *found, const double centre[2], Sym2 ewa) {
    const double *mean = found->mean;
    double cov[3] = {found->cov.xx, found->cov.xy, found->cov.yy}, S2[3] = {ewa.xx, ewa.xy, ewa.yy}, shift, relative;
    CALL(trial_call, t, "ewa_error", IN_ARRAY(mean, 2), IN_ARRAY(cov, 3), IN_ARRAY(centre, 2), IN_ARRAY(S2, 3),
         OUT(shift), OUT(relative));
    return (Measured){shift, relative};
}

static void measure(Trial *t, const double *in) {
    ErrorCase c;
    memcpy(&c, in, sizeof c);
    Sym2 S2 = covariance_from_angle(c.angle, c.sx, c.sy), conic;
    Found found = {{c.mean[0], c.mean[1]}, {c.cov[0], c.cov[1], c.cov[2]}};
    Measured yours = call_error(t, &found, c.centre, S2);
    covariance_conic(S2, &conic);
    double shift = sqrt(conic_mahalanobis2(conic, c.mean[0] - c.centre[0], c.mean[1] - c.centre[1]));
    trial_near1(t, "shift: from centre to mean, in standard deviations of S2", yours.shift, shift, fmax(1, shift));
    Sym2 off = {c.cov[0] - S2.xx, c.cov[1] - S2.xy, c.cov[2] - S2.yy};
    trial_near1(t, "relative: |cov - S2| / |S2|, xy counted twice as it stands twice", yours.relative,
                sym2_length(off) / sym2_length(S2), 1);
}

// ---- the laws ----
// Two tricks keep the noise of the draws out. Common random numbers: a ball is compared with itself, drawn by the same seed at
// a size where EWA is exact and then scaled up, which has the sample's noise but no error of EWA. Antithetic draws: each ball is
// seen a second time with the world turned by half a turn about the mean, across the radius; that is the same ball with its
// draws mirrored, and in the average of both what is odd in them cancels.

static const double TINY = 1e-3;
enum { LAW_SEED = 0, LAW_ANGLE, LAW_DIRECTION, LAW_FOCAL, LAW_DEPTH, LAW_NUMBERS };

static void draw_law(Rng *rng, int k, double *in) {
    (void)k;
    in[LAW_SEED] = 1 + rng_below(rng, SEED_COUNT);
    in[LAW_ANGLE] = rng_range(rng, 20, 60);
    in[LAW_DIRECTION] = rng_range(rng, 0, 360);
    in[LAW_FOCAL] = exp(rng_range(rng, log(50), log(2000)));
    in[LAW_DEPTH] = exp(rng_range(rng, log(0.5), log(50)));
}

static bool allows_law(const double *in) {
    return in[LAW_SEED] >= 0 && in[LAW_SEED] <= SEED_COUNT && in[LAW_SEED] == floor(in[LAW_SEED]) &&
           in[LAW_ANGLE] >= 20 && in[LAW_ANGLE] <= 60 && in[LAW_FOCAL] >= 50 && in[LAW_FOCAL] <= 2000 &&
           in[LAW_DEPTH] >= 0.5 && in[LAW_DEPTH] <= 50;
}

static View ball_of(const double *in, double r, bool is_mirrored) {
    double off = tan(in[LAW_ANGLE] * M_PI / 180), turn = in[LAW_DIRECTION] * M_PI / 180, f = in[LAW_FOCAL];
    CameraCase c = {
        .width = 640, .height = 480, .fx = f, .fy = f, .cx = 320, .cy = 240, .quat = {1}, .splat_quat = {1}};
    if (is_mirrored) c.quat[0] = 0, c.quat[1] = -sin(turn), c.quat[2] = cos(turn);
    c.ratio[0] = off * cos(turn), c.ratio[1] = off * sin(turn);
    c.depth = in[LAW_DEPTH];
    for (int i = 0; i < 3; i++) c.log_scale[i] = log(r * c.depth);
    return view_of(&c);
}

static Found call_ball(Trial *t, const double *in, double r) {
    View plain = ball_of(in, r, false), mirrored = ball_of(in, r, true);
    Found a = call(t, &plain, LAW_SAMPLES, in[LAW_SEED]), b = call(t, &mirrored, LAW_SAMPLES, in[LAW_SEED]);
    return (Found){{(a.mean[0] + b.mean[0]) / 2, (a.mean[1] + b.mean[1]) / 2},
                   {(a.cov.xx + b.cov.xx) / 2, (a.cov.xy + b.cov.xy) / 2, (a.cov.yy + b.cov.yy) / 2}};
}

// *outward: px by which the mean left the middle of the picture.
static Measured error_at(Trial *t, const double *in, const Found *tiny, double r, double *outward) {
    View view = ball_of(in, r, false);
    Found found = call_ball(t, in, r);
    Vec3 at = centre_of(&view);
    double grown = r / TINY, centre[2] = {at.x + grown * (tiny->mean[0] - at.x), at.y + grown * (tiny->mean[1] - at.y)};
    Sym2 ewa = {grown * grown * tiny->cov.xx, grown * grown * tiny->cov.xy, grown * grown * tiny->cov.yy};
    double turn = in[LAW_DIRECTION] * M_PI / 180;
    *outward = cos(turn) * (found.mean[0] - centre[0]) + sin(turn) * (found.mean[1] - centre[1]);
    return call_error(t, &found, centre, ewa);
}

static const double LAW_R = 0.1, LAW_TOLERANCE = 0.15;

static void drift(Trial *t, const double *in) {
    Found tiny = call_ball(t, in, TINY);
    double outward, want = LAW_R * sin(in[LAW_ANGLE] * M_PI / 180);
    Measured error = error_at(t, in, &tiny, LAW_R, &outward);
    trial_within(t, "shift of a ball of r = sigma/z = 0.1 (less the noise of its draws): r sin(theta)", &error.shift,
                 &want, 1, LAW_TOLERANCE * want + SIGMAS * LAW_R / sqrt(LAW_SAMPLES));
    trial_at_most(t, "px that the mean moved towards the middle of the picture: it moves outward", -outward, 0);
}

static void slopes(Trial *t, const double *in) {
    static const double SHIFT_SLOPE = 1, COVARIANCE_SLOPE = 2;
    Found tiny = call_ball(t, in, TINY);
    double outward;
    Measured small = error_at(t, in, &tiny, 0.05, &outward), large = error_at(t, in, &tiny, 0.2, &outward);
    double shift = log(large.shift / small.shift) / log(4), covariance = log(large.relative / small.relative) / log(4);
    trial_within(t, "the power of r = sigma/z by which the shift grows", &shift, &SHIFT_SLOPE, 1, 0.15);
    trial_within(t, "the power of r = sigma/z by which the error of the covariance grows", &covariance,
                 &COVARIANCE_SLOPE, 1, 0.3);
}

// ---- pictures ----

static bool picture(Subject *subject, const double *in, ImageF *yours, ImageF *reference) {
    CameraCase c = case_of(in);
    View view = view_of(&c);
    Trial trial = {.subject = subject};
    Found found = call(&trial, &view, SAMPLES, in[SEED]);
    bool good = !trial.failed;
    trial_free(&trial);
    if (!good) return false;
    Perspective want = perspective_of(&view.camera, view.mean_cam, view.in_camera);
    Sym2 ewa = reference_ewa_forward(&view.camera, view.mean_cam, view.world);
    Vec3 centre = centre_of(&view);
    double half_width = 4 * sqrt(sym2_eigen(want.covariance).major);
    *yours = ewa_picture(ewa, found.mean[0] - centre.x, found.mean[1] - centre.y, found.cov, half_width);
    *reference = ewa_picture(ewa, want.mean[0] - centre.x, want.mean[1] - centre.y, want.covariance, half_width);
    return true;
}

static const Rung RUNGS[] = {
    {.name = "point",
     .claim = "a Gaussian without extent is one pixel, and one point has no spread",
     .cases = 6,
     .count = POINT_NUMBERS,
     .draw = draw_point,
     .allows = allows_point,
     .check = point},
    {.name = "draws",
     .claim = "the first n draws inside the cut count, each once; the covariance is over n and over 0.917820",
     .cases = 4,
     .count = DRAWS_NUMBERS,
     .draw = draw_draws,
     .allows = allows_draws,
     .check = draws},
    {.name = "small",
     .claim = "a small splat far away has the mean and covariance that EWA says",
     .cases = 1,
     .count = NUMBERS,
     .draw = draw_small,
     .allows = allows_small,
     .check = moments,
     .picture = picture},
    {.name = "near",
     .claim = "a splat that reaches far towards the camera has the mean and covariance of true perspective",
     .cases = 1,
     .count = NUMBERS,
     .draw = draw_near,
     .allows = allows_near,
     .check = moments,
     .picture = picture},
    {.name = "flat",
     .claim = "a splat without thickness, or without width too, is drawn from as well",
     .cases = 1,
     .count = NUMBERS,
     .draw = draw_moderate,
     .allows = allows_moderate,
     .check = flat},
    {.name = "alike",
     .claim = "neither focal length nor the world's unit changes the picture's proportions",
     .cases = 4,
     .count = ALIKE_NUMBERS,
     .draw = draw_alike,
     .allows = allows_alike,
     .check = alike},
    {.name = "measure",
     .claim = "the shift counts in standard deviations, the covariance's error in parts of EWA's",
     .count = ERROR_NUMBERS,
     .draw = draw_error,
     .allows = allows_error,
     .check = measure},
    {.name = "drift",
     .claim = "the law of the mean: a ball's mean lies r sin(theta) standard deviations outside of EWA's",
     .cases = 1,
     .count = LAW_NUMBERS,
     .double_only = true,
     .draw = draw_law,
     .allows = allows_law,
     .check = drift},
    {.name = "slopes",
     .claim = "half the size: half the shift, and a quarter of the covariance's error",
     .cases = 1,
     .count = LAW_NUMBERS,
     .double_only = true,
     .draw = draw_law,
     .allows = allows_law,
     .check = slopes},
};

const Exercise EXERCISE_EWA_ERROR = {
    .number = 11,
    .name = "ewa_error",
    .title = "what EWA gets wrong, measured by drawing points",
    .minutes = 60,
    .unlocks = "the lesson's map of the error over angle and size, now that you can measure every point of it",
    .rungs = RUNGS,
    .rung_count = sizeof RUNGS / sizeof *RUNGS,
};
