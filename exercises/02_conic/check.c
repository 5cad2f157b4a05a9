// check.c - E02: what conic, distance and box must fulfil.
#include "exercises/harness/blob_picture.h"
#include "exercises/harness/catalogue.h"

#include <math.h>

// A case is theta, sx, sy, and what the rung adds: an offset (dx, dy), or k.
enum { THETA, SX, SY, DX, DY, K_SIGMA = DX };

static const double ASPECT_MAX = 30;
static const double SCALE_MIN = 1e-2, SCALE_MAX = 1e2; // px

// Round and axis-aligned blobs would hide most mistakes: only the first two cases are such.
static void draw_blob(Rng *rng, int k, double *in) {
    double aspect = exp(rng_range(rng, 0, log(ASPECT_MAX))), mean = exp(rng_range(rng, log(SCALE_MIN), log(SCALE_MAX)));
    in[THETA] = k == 1 ? 0 : rng_range(rng, -4 * M_PI, 4 * M_PI);
    in[SX] = mean * sqrt(aspect);
    in[SY] = k == 0 ? in[SX] : mean / sqrt(aspect);
}

static bool allows_blob(const double *in) {
    return in[SX] >= 1e-3 && in[SY] >= 1e-3 && in[SX] <= 1e3 && in[SY] <= 1e3 && in[SX] <= in[SY] * 1.1 * ASPECT_MAX &&
           in[SY] <= in[SX] * 1.1 * ASPECT_MAX;
}

// As float sees it: then both precisions invert the same matrix. (volatile: GCC 12 at -O2 loses the rounding of a plain cast when it
// copies the struct.)
static double as_float(double x) {
    volatile float narrow = (float)x;
    return (double)narrow;
}

static Sym2 covariance_of(const double *in) {
    Sym2 S = covariance_from_angle(in[THETA], in[SX], in[SY]);
    return (Sym2){as_float(S.xx), as_float(S.xy), as_float(S.yy)};
}

static Sym2 conic_of(const double *in) { return covariance_from_angle(in[THETA], 1 / in[SX], 1 / in[SY]); }

static double condition_of(const double *in) {
    double aspect = fmax(in[SX] / in[SY], in[SY] / in[SX]);
    return aspect * aspect;
}

static Sym2 call_conic(Trial *t, Sym2 cov, double *returned_value) {
    double S[3] = {cov.xx, cov.xy, cov.yy}, K[3], returned;
    CALL(trial_call, t, "conic_from_cov2", IN_ARRAY(S, 3), OUT_ARRAY(K, 3), OUT(returned));
    *returned_value = returned;
    return (Sym2){K[0], K[1], K[2]};
}

static double call_mahal2(Trial *t, Sym2 conic, double dx, double dy) {
    double K[3] = {conic.xx, conic.xy, conic.yy}, returned;
    CALL(trial_call, t, "mahal2", IN_ARRAY(K, 3), IN(dx), IN(dy), OUT(returned));
    return returned;
}

static void call_box(Trial *t, Sym2 cov, double k, double half[2]) {
    double S[3] = {cov.xx, cov.xy, cov.yy};
    CALL(trial_call, t, "aabb_ksigma", IN_ARRAY(S, 3), IN(k), OUT_ARRAY(half, 2));
}

// ---- rungs ----

static void inverse(Trial *t, const double *in) {
    double returned;
    Sym2 S = covariance_of(in), K = call_conic(t, S, &returned);
    trial_equal(t, "the returned value, for a blob with an area", returned, 1);
    double product[4] = {S.xx * K.xx + S.xy * K.xy, S.xx * K.xy + S.xy * K.yy, S.xy * K.xx + S.yy * K.xy,
                         S.xy * K.xy + S.yy * K.yy};
    trial_near(t, "S K = 1 0 0 1, the unit matrix, row by row", product, (double[]){1, 0, 0, 1}, 4, condition_of(in));
}

// A case is xx, xy, yy: of no area (exactly, in whole numbers), of an eigenvalue below zero, or with a NaN.
static void draw_no_blob(Rng *rng, int k, double *in) {
    double a = (int)rng_below(rng, 19) - 9, b = (int)rng_below(rng, 19) - 9;
    in[0] = a * a;
    in[1] = a * b;
    in[2] = b * b;
    if (k % 3 == 1) in[1] += in[1] < 0 ? -rng_range(rng, 0.1, 5) : rng_range(rng, 0.1, 5);
    if (k == 2) in[rng_below(rng, 3)] = NAN;
}

static bool allows_no_blob(const double *in) {
    double below = in[0] * in[2] - in[1] * in[1];
    bool is_whole = in[0] == rint(in[0]) && in[1] == rint(in[1]) && in[2] == rint(in[2]);
    return in[0] >= 0 && in[2] >= 0 && ((below == 0 && is_whole) || below < -0.01) && fabs(in[1]) < 200;
}

static void refused(Trial *t, const double *in) {
    double returned;
    call_conic(t, (Sym2){in[0], in[1], in[2]}, &returned);
    trial_equal(t, "the returned value, where det S is not above zero", returned, 0);
}

static void draw_offset(Rng *rng, int k, double *in) {
    draw_blob(rng, k, in);
    double m = rng_range(rng, 0.1, 4), phi = rng_range(rng, 0, 2 * M_PI), c = cos(in[THETA]), s = sin(in[THETA]);
    double u = m * in[SX] * cos(phi), v = m * in[SY] * sin(phi);
    in[DX] = c * u - s * v;
    in[DY] = s * u + c * v;
}

static double whitened2(const double *in) {
    double c = cos(in[THETA]), s = sin(in[THETA]);
    double u = (c * in[DX] + s * in[DY]) / in[SX], v = (c * in[DY] - s * in[DX]) / in[SY];
    return u * u + v * v;
}

// What the terms of d^T K d are made of: they cancel.
static double distance_scale(const double *in) {
    double minor = fmin(in[SX], in[SY]), scale = (in[DX] * in[DX] + in[DY] * in[DY]) / (minor * minor);
    return scale > 0 ? scale : 1;
}

static void distance(Trial *t, const double *in) {
    trial_near1(t, "the squared length of (dx, dy) turned back by theta and divided by sx, sy",
                call_mahal2(t, conic_of(in), in[DX], in[DY]), whitened2(in), distance_scale(in));
}

// Inverse and distance together, for a point of the ellipse of (DX = k) standard deviations at the angle DY of its own axes.
static void draw_level(Rng *rng, int k, double *in) {
    draw_blob(rng, k, in);
    in[K_SIGMA] = rng_range(rng, 0.5, 4);
    in[DY] = rng_range(rng, 0, 2 * M_PI);
}

static bool allows_k(const double *in) { return allows_blob(in) && in[K_SIGMA] >= 0.5 && in[K_SIGMA] <= 10; }

static void level(Trial *t, const double *in) {
    double returned, k = in[K_SIGMA], c = cos(in[THETA]), s = sin(in[THETA]);
    double u = k * in[SX] * cos(in[DY]), v = k * in[SY] * sin(in[DY]);
    Sym2 K = call_conic(t, covariance_from_angle(in[THETA], in[SX], in[SY]), &returned);
    double m2 = call_mahal2(t, K, c * u - s * v, s * u + c * v);
    trial_near1(t, "m^2 at a point of the ellipse of k standard deviations, by your conic: k^2", m2, k * k,
                k * k * condition_of(in));
}

static void draw_k(Rng *rng, int k, double *in) {
    draw_blob(rng, k, in);
    in[K_SIGMA] = k == 2 ? 1 : rng_range(rng, 0.5, 4);
}

static void box(Trial *t, const double *in) {
    double half[2], want[2], k = in[K_SIGMA];
    Sym2 S = covariance_of(in);
    call_box(t, S, k, half);
    covariance_box(S, k, &want[0], &want[1]);
    trial_near(t, "half = half width, half height", half, want, 2, fmax(want[0], want[1]));
}

// The largest |x| and |y| of points all round the ellipse.
enum { POINTS = 1000 };
static void touches(Trial *t, const double *in) {
    double half[2], k = in[K_SIGMA], reach[2] = {0}, c = cos(in[THETA]), s = sin(in[THETA]);
    call_box(t, covariance_of(in), k, half);
    for (int i = 0; i < POINTS; i++) {
        double u = k * in[SX] * cos(2 * M_PI * i / POINTS), v = k * in[SY] * sin(2 * M_PI * i / POINTS);
        reach[0] = fmax(reach[0], fabs(c * u - s * v));
        reach[1] = fmax(reach[1], fabs(s * u + c * v));
    }
    trial_at_most(t, "how far the ellipse sticks out of the box, of its width", reach[0] / half[0] - 1, 1e-6);
    trial_at_most(t, "how far the ellipse sticks out of the box, of its height", reach[1] / half[1] - 1, 1e-6);
    trial_at_most(t, "the gap between ellipse and box, of its width", 1 - reach[0] / half[0], 1e-4);
    trial_at_most(t, "the gap between ellipse and box, of its height", 1 - reach[1] / half[1], 1e-4);
}

// ---- pictures ----

// The blob whose conic yours is: what is none is drawn red.
static bool picture_conic(Subject *subject, const double *in, ImageF *yours, ImageF *reference) {
    Sym2 cov = covariance_of(in), back = {0};
    double S[3] = {cov.xx, cov.xy, cov.yy}, K[3], returned;
    if (!CALL(subject_call, subject, "conic_from_cov2", IN_ARRAY(S, 3), OUT_ARRAY(K, 3), OUT(returned))) return false;
    covariance_conic((Sym2){K[0], K[1], K[2]}, &back);
    *yours = blob_picture(back, blob_picture_fit(cov));
    *reference = blob_picture(cov, blob_picture_fit(cov));
    return true;
}

// The Gaussian by your distance, pixel by pixel, with rings at m = 1, 2, 3.
static void paint_distance(ImageF *image, int index, double m2) {
    float *rgb = &image->values[index * 3], g = (float)exp(-m2 / 2);
    double m = sqrt(m2), ring = fabs(m - rint(m));
    bool on_ring = m >= 0.5 && m < 3.5 && ring < 0.05;
    rgb[0] = on_ring ? 1 : g;
    rgb[1] = on_ring ? 0.6f : g;
    rgb[2] = on_ring ? 0.1f : g;
}

static bool picture_distance(Subject *subject, const double *in, ImageF *yours, ImageF *reference) {
    Sym2 conic = conic_of(in);
    enum { SIDE = 120 };
    double K[3] = {conic.xx, conic.xy, conic.yy}, returned, half = 4 * fmax(in[SX], in[SY]);
    *yours = imagef_create(SIDE, SIDE, 3);
    *reference = imagef_create(SIDE, SIDE, 3);
    bool good = true;
    for (int i = 0; good && i < SIDE * SIDE; i++) {
        double dx = ((i % SIDE + 0.5) / SIDE * 2 - 1) * half, dy = ((i / SIDE + 0.5) / SIDE * 2 - 1) * half;
        good = CALL(subject_call, subject, "mahal2", IN_ARRAY(K, 3), IN(dx), IN(dy), OUT(returned));
        paint_distance(yours, i, returned);
        paint_distance(reference, i, conic_mahalanobis2(conic, dx, dy));
    }
    return good;
}

// The blob with a box round its ellipse of k standard deviations.
static ImageF box_picture(Sym2 cov, double k, const double half[2], double half_width) {
    Sym2 conic = {0};
    covariance_conic(cov, &conic);
    ImageF image = blob_picture(cov, half_width);
    double pixel = 2 * half_width / image.width;
    for (int y = 0; y < image.height; y++)
        for (int x = 0; x < image.width; x++) {
            float *rgb = &image.values[(y * image.width + x) * 3];
            double dx = (x + 0.5) * pixel - half_width, dy = (y + 0.5) * pixel - half_width;
            double out_x = fabs(dx) - half[0], out_y = fabs(dy) - half[1], out = fmax(out_x, out_y);
            double m = sqrt(conic_mahalanobis2(conic, dx, dy));
            if (fabs(m - k) < 0.06) rgb[0] = 0.9f, rgb[1] = 0.9f, rgb[2] = 0.2f;
            if (fabs(out) < pixel) rgb[0] = 0.2f, rgb[1] = 0.8f, rgb[2] = 1;
        }
    return image;
}

static bool picture_box(Subject *subject, const double *in, ImageF *yours, ImageF *reference) {
    Sym2 cov = covariance_of(in);
    double S[3] = {cov.xx, cov.xy, cov.yy}, k = in[K_SIGMA], half[2], want[2];
    if (!CALL(subject_call, subject, "aabb_ksigma", IN_ARRAY(S, 3), IN(k), OUT_ARRAY(half, 2))) return false;
    covariance_box(cov, k, &want[0], &want[1]);
    double seen = 1.3 * k * fmax(in[SX], in[SY]);
    *yours = box_picture(cov, k, half, seen);
    *reference = box_picture(cov, k, want, seen);
    return true;
}

static const Rung RUNGS[] = {
    {.name = "inverse",
     .claim = "S K = I: the conic is the inverse of the covariance",
     .count = 3,
     .draw = draw_blob,
     .allows = allows_blob,
     .check = inverse,
     .picture = picture_conic},
    {.name = "refused",
     .claim = "what has no area, or is no covariance, is refused",
     .count = 3,
     .draw = draw_no_blob,
     .allows = allows_no_blob,
     .check = refused},
    {.name = "distance",
     .claim = "m^2 is the squared length in units of the blob's own axes",
     .count = 5,
     .draw = draw_offset,
     .allows = allows_blob,
     .check = distance,
     .picture = picture_distance},
    {.name = "level",
     .claim = "on the ellipse of k standard deviations m^2 is k^2 everywhere",
     .count = 5,
     .draw = draw_level,
     .allows = allows_k,
     .check = level,
     .picture = picture_conic},
    {.name = "touches",
     .claim = "the box touches the ellipse of k standard deviations on all sides, and nothing sticks out",
     .cases = 4,
     .count = 4,
     .draw = draw_k,
     .allows = allows_k,
     .check = touches,
     .picture = picture_box},
    {.name = "box",
     .claim = "the box is exact to the last digits",
     .count = 4,
     .draw = draw_k,
     .allows = allows_k,
     .check = box,
     .picture = picture_box},
};

const Exercise EXERCISE_CONIC = {
    .number = 2,
    .name = "conic",
    .title = "from a covariance to its conic, a distance and a box",
    .minutes = 40,
    .unlocks = "your conics in the picture of the widget: splatlab widget --mine",
    .rungs = RUNGS,
    .rung_count = sizeof RUNGS / sizeof *RUNGS,
};
