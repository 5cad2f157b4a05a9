// check.c - E03: what gradients by raw entries and by factors must fulfil, and where they lead.
#include "exercises/harness/blob_picture.h"
#include "exercises/harness/catalogue.h"
#include "splat2d/adam.h"
#include "splat3d/camera.h"
#include "splat3d/reference.h"

#include <float.h>
#include <math.h>

// ---- the blob in the picture: a case is width, height, theta, ln sx, ln sy, and dL/dg of each pixel ----

enum { WIDTH, HEIGHT, FACTORS, ERRORS = FACTORS + 3, SIDE_MAX = 15, NUMBERS = ERRORS + SIDE_MAX * SIDE_MAX };

static Sym2 covariance_of(const double factors[3]) {
    return covariance_from_angle(factors[0], exp(factors[1]), exp(factors[2]));
}

static void draw_blob(Rng *rng, int k, double *in) {
    in[WIDTH] = 1 + rng_below(rng, SIDE_MAX);
    in[HEIGHT] = 1 + rng_below(rng, SIDE_MAX);
    in[FACTORS] = rng_range(rng, -4, 4);
    for (int i = 1; i <= 2; i++) in[FACTORS + i] = rng_range(rng, log(0.8), log(6));
    if (k == 1) in[FACTORS + 2] = in[FACTORS + 1];
}

static void draw_one_pixel(Rng *rng, int k, double *in) {
    draw_blob(rng, k, in);
    int at = (int)rng_below(rng, (uint32_t)(in[WIDTH] * in[HEIGHT]));
    in[ERRORS + at] = 1;
}

static void draw_all_pixels(Rng *rng, int k, double *in) {
    draw_blob(rng, k, in);
    for (int i = 0; i < in[WIDTH] * in[HEIGHT]; i++) in[ERRORS + i] = rng_range(rng, -1, 1);
}

static bool allows_blob(const double *in) {
    for (int i = 0; i < 2; i++)
        if (in[i] != floor(in[i]) || in[i] < 1 || in[i] > SIDE_MAX) return false;
    for (int i = 1; i <= 2; i++)
        if (in[FACTORS + i] < log(0.7) || in[FACTORS + i] > 2) return false;
    return fabs(in[FACTORS]) <= 4;
}

// The picture, and what the errors say of it: L = sum of e g. In `size` is summed how large the terms are of L and of its
// derivatives.
static double loss_of(const double *in, Sym2 cov, double *size) {
    Sym2 conic = {0};
    covariance_conic(cov, &conic);
    int width = (int)in[WIDTH], height = (int)in[HEIGHT];
    double sum = 0;
    for (int i = 0; i < width * height; i++) {
        double dx = i % width + 0.5 - in[WIDTH] / 2, dy = i / width + 0.5 - in[HEIGHT] / 2;
        double m2 = conic_mahalanobis2(conic, dx, dy), g = exp(-m2 / 2);
        sum += in[ERRORS + i] * g;
        if (size) *size += fabs(in[ERRORS + i]) * g * (1 + m2);
    }
    return sum;
}

typedef double LossAt(const double *in, const double at[3]);

static double loss_raw(const double *in, const double at[3]) { return loss_of(in, (Sym2){at[0], at[1], at[2]}, NULL); }

static double loss_factored(const double *in, const double at[3]) { return loss_of(in, covariance_of(at), NULL); }

// Central differences of fourth order: the error is that of h^4.
static void differences(LossAt *loss, const double *in, const double at[3], double h, double gradient[3]) {
    static const double WEIGHTS[4] = {1.0 / 12, -8.0 / 12, 8.0 / 12, -1.0 / 12}, STEPS[4] = {-2, -1, 1, 2};
    for (int i = 0; i < 3; i++) {
        gradient[i] = 0;
        for (int k = 0; k < 4; k++) {
            double moved[3] = {at[0], at[1], at[2]};
            moved[i] += STEPS[k] * h;
            gradient[i] += WEIGHTS[k] * loss(in, moved) / h;
        }
    }
}

static double minor_of(const double *in) { return exp(2 * fmin(in[FACTORS + 1], in[FACTORS + 2])); }

static double major_of(const double *in) { return exp(2 * fmax(in[FACTORS + 1], in[FACTORS + 2])); }

// As large as the terms whose sums are the gradient and the loss that is differenced; never zero.
static double scale_of(const double *in, double per) {
    double size = 0;
    loss_of(in, covariance_of(in + FACTORS), &size);
    return per * (size + 1e-3);
}

static void expected_raw(const double *in, double gradient[3]) {
    Sym2 S = covariance_of(in + FACTORS);
    differences(loss_raw, in, (double[]){S.xx, S.xy, S.yy}, 1e-3 * minor_of(in), gradient);
}

static void expected_factored(const double *in, double gradient[3]) {
    differences(loss_factored, in, in + FACTORS, 1e-3 * sqrt(minor_of(in) / major_of(in)), gradient);
}

static void call_raw(Trial *t, const double *in, double g[3]) {
    Sym2 cov = covariance_of(in + FACTORS);
    double S[3] = {cov.xx, cov.xy, cov.yy}, width = in[WIDTH], height = in[HEIGHT];
    const double *e = in + ERRORS;
    CALL(trial_call, t, "grad_raw", IN_ARRAY(S, 3), IN(width), IN(height), IN_ARRAY(e, (int)(width * height)),
         OUT_ARRAY(g, 3));
}

static void call_factored(Trial *t, const double *in, double g[3]) {
    double th = in[FACTORS], width = in[WIDTH], height = in[HEIGHT];
    const double *logs = in + FACTORS + 1, *e = in + ERRORS;
    CALL(trial_call, t, "grad_factored", IN(th), IN_ARRAY(logs, 2), IN(width), IN(height),
         IN_ARRAY(e, (int)(width * height)), OUT_ARRAY(g, 3));
}

static void raw(Trial *t, const double *in) {
    double g[3], want[3];
    call_raw(t, in, g);
    expected_raw(in, want);
    trial_near(t, "g = dL/dxx, dL/dxy, dL/dyy; expected: by central differences of the stored numbers", g, want, 3,
               scale_of(in, 1 / minor_of(in)));
}

static void factored(Trial *t, const double *in) {
    double g[3], want[3];
    call_factored(t, in, g);
    expected_factored(in, want);
    trial_near(t, "g = dL/dth, dL/dlogs[0], dL/dlogs[1]; expected: by central differences", g, want, 3,
               scale_of(in, sqrt(major_of(in) / minor_of(in))));
}

// A step d of the factors moves S by dS, so L must change as much by either gradient: <g_factored, d> = <g_raw, dS>. Scaling the
// blob by a part of it (both logs by the same d) moves S by 2 d S.
static void adjoint(Trial *t, const double *in) {
    double by_factors[3], by_entries[3];
    Sym2 S = covariance_of(in + FACTORS);
    call_factored(t, in, by_factors);
    call_raw(t, in, by_entries);
    trial_near1(t,
                "what growing on all sides does to L: by the factors' gradient; expected: by yours of the raw entries",
                by_factors[1] + by_factors[2], 2 * (S.xx * by_entries[0] + S.xy * by_entries[1] + S.yy * by_entries[2]),
                scale_of(in, sqrt(major_of(in) / minor_of(in))));
    trial_near1(t, "what turning does to L: by the factors' gradient; expected: by yours of the raw entries",
                by_factors[0], -2 * S.xy * by_entries[0] + (S.xx - S.yy) * by_entries[1] + 2 * S.xy * by_entries[2],
                scale_of(in, sqrt(major_of(in) / minor_of(in))));
}

// ---- two walks from a disc to a streak: a case is the streak's theta, its length and its aspect ----

enum { PHOTO_SIDE = 20, PHOTO_PIXELS = PHOTO_SIDE * PHOTO_SIDE, RAW_STEPS = 60, FACTORED_STEPS = 100 };
static const double DISC_PX = 3, RAW_RATE_PX2 = 0.3, FACTORED_RATE = 0.1;

static void draw_streak(Rng *rng, int k, double *in) {
    (void)k;
    in[0] = rng_range(rng, 0.3, 1.3);
    in[1] = rng_range(rng, 4.5, 5.5);
    in[2] = rng_range(rng, 14, 18);
}

// A walk is as easy to read from any streak: no simpler one is looked for.
static bool allows_no_other(const double *in) {
    (void)in;
    return false;
}

static Sym2 streak_of(const double *in) { return covariance_from_angle(in[0], in[1], in[1] / in[2]); }

static void photo_of(Sym2 cov, double g[PHOTO_PIXELS]) {
    Sym2 conic = {0};
    covariance_conic(cov, &conic);
    for (int i = 0; i < PHOTO_PIXELS; i++) {
        double dx = i % PHOTO_SIDE + 0.5 - PHOTO_SIDE / 2.0, dy = i / PHOTO_SIDE + 0.5 - PHOTO_SIDE / 2.0;
        g[i] = exp(-conic_mahalanobis2(conic, dx, dy) / 2);
    }
}

// L = sum of (g - photo)^2 / 2, so dL/dg = g - photo. Returns L.
static double errors_of(Sym2 cov, const double photo[PHOTO_PIXELS], double e[PHOTO_PIXELS]) {
    double sum = 0;
    photo_of(cov, e);
    for (int i = 0; i < PHOTO_PIXELS; i++) {
        e[i] -= photo[i];
        sum += e[i] * e[i] / 2;
    }
    return sum;
}

// By the house's own way: first the conic, then through the inverse.
static void reference_raw(Sym2 cov, const double e[PHOTO_PIXELS], double g[3]) {
    Sym2 conic = {0}, d_conic = {0};
    covariance_conic(cov, &conic);
    for (int i = 0; i < PHOTO_PIXELS; i++) {
        double dx = i % PHOTO_SIDE + 0.5 - PHOTO_SIDE / 2.0, dy = i / PHOTO_SIDE + 0.5 - PHOTO_SIDE / 2.0;
        double d = -e[i] * exp(-conic_mahalanobis2(conic, dx, dy) / 2) / 2;
        d_conic = (Sym2){d_conic.xx + d * dx * dx, d_conic.xy + 2 * d * dx * dy, d_conic.yy + d * dy * dy};
    }
    Sym2 d = covariance_conic_backward(conic, d_conic);
    g[0] = d.xx, g[1] = d.xy, g[2] = d.yy;
}

// Adam on xx, xy, yy, with your gradients (t == NULL: ours). Returns the step after which an eigenvalue was not above zero; 0
// when that did not happen.
static int raw_walk(Trial *t, const double *in) {
    double S[3] = {DISC_PX * DISC_PX, 0, DISC_PX * DISC_PX}, m[3] = {0}, v[3] = {0}, g[3];
    double photo[PHOTO_PIXELS], errors[PHOTO_PIXELS], width = PHOTO_SIDE, height = PHOTO_SIDE, *e = errors;
    AdamRule rule = adam_rule_default(RAW_RATE_PX2);
    photo_of(streak_of(in), photo);
    for (int step = 1; step <= RAW_STEPS; step++) {
        Sym2 cov = {S[0], S[1], S[2]};
        errors_of(cov, photo, e);
        reference_raw(cov, e, g);
        if (t)
            CALL(trial_call, t, "grad_raw", IN_ARRAY(S, 3), IN(width), IN(height), IN_ARRAY(e, PHOTO_PIXELS),
                 OUT_ARRAY(g, 3));
        if (!isfinite(g[0] + g[1] + g[2])) return 0;
        adam_step(&rule, step, 3, g, S, m, v);
        if (!(sym2_eigen((Sym2){S[0], S[1], S[2]}).minor > 0)) return step;
    }
    return 0;
}

static void wall(Trial *t, const double *in) {
    trial_equal(t, "the step at which Adam leaves the matrices that are covariances, at 0.3 px^2 a step",
                raw_walk(t, in), raw_walk(NULL, in));
}

// Adam on theta, ln sx, ln sy with your gradients; returns what is left of the loss. *end: where it ended.
static double factored_walk(Trial *t, const double *in, Sym2 *end) {
    double f[3] = {0.3, log(DISC_PX), log(DISC_PX)}, m[3] = {0}, v[3] = {0}, g[3];
    double photo[PHOTO_PIXELS], errors[PHOTO_PIXELS], width = PHOTO_SIDE, height = PHOTO_SIDE, *e = errors;
    AdamRule rule = adam_rule_default(FACTORED_RATE);
    photo_of(streak_of(in), photo);
    double first = errors_of(covariance_of(f), photo, e);
    for (int step = 1; step <= FACTORED_STEPS; step++) {
        double th = f[0], *logs = f + 1;
        CALL(trial_call, t, "grad_factored", IN(th), IN_ARRAY(logs, 2), IN(width), IN(height),
             IN_ARRAY(e, PHOTO_PIXELS), OUT_ARRAY(g, 3));
        if (!isfinite(g[0] + g[1] + g[2])) return NAN;
        adam_step(&rule, step, 3, g, f, m, v);
        errors_of(covariance_of(f), photo, e);
    }
    *end = covariance_of(f);
    return errors_of(*end, photo, e) / first;
}

static void no_wall(Trial *t, const double *in) {
    Sym2 end;
    trial_at_most(t, "what is left of the loss after 100 steps on theta, ln sx, ln sy, as a part of the first",
                  factored_walk(t, in, &end), 0.1);
}

// ---- 3-D: a case is a quaternion and three logarithms ----

static void draw_factors3(Rng *rng, int k, double *in) {
    for (int i = 0; i < 4; i++) in[i] = rng_normal(rng);
    for (int i = 4; i < 7; i++) in[i] = rng_range(rng, -5, 5);
    if (k == 0) in[5] = in[6] = in[4];
    if (k == 1) in[0] = 1, in[1] = in[2] = in[3] = 0;
}

static bool allows_factors3(const double *in) {
    double length2 = in[0] * in[0] + in[1] * in[1] + in[2] * in[2] + in[3] * in[3];
    return length2 > 0.01 && fabs(in[4]) <= 5 && fabs(in[5]) <= 5 && fabs(in[6]) <= 5;
}

static double largest3(const double *in) { return exp(2 * fmax(in[4], fmax(in[5], in[6]))); }

static void call_cov3(Trial *t, const double *in, double S[6]) {
    Mat3 rotation = camera_rotation_from_quaternion(in);
    const double *R = rotation.m, *logs = in + 4;
    CALL(trial_call, t, "cov3_from_factors", IN_ARRAY(R, 9), IN_ARRAY(logs, 3), OUT_ARRAY(S, 6));
}

// One turn that makes a[p][q] zero (Jacobi 1846).
static void jacobi_turn(double a[3][3], int p, int q) {
    if (a[p][q] == 0) return;
    double phi = atan2(2 * a[p][q], a[q][q] - a[p][p]) / 2, c = cos(phi), s = sin(phi);
    for (int k = 0; k < 3; k++) {
        double kp = a[k][p], kq = a[k][q];
        a[k][p] = c * kp - s * kq;
        a[k][q] = s * kp + c * kq;
    }
    for (int k = 0; k < 3; k++) {
        double pk = a[p][k], qk = a[q][k];
        a[p][k] = c * pk - s * qk;
        a[q][k] = s * pk + c * qk;
    }
}

enum { JACOBI_SWEEPS = 8 };

static void eigenvalues3(const double S[6], double *smallest, double *largest) {
    double a[3][3] = {{S[0], S[1], S[2]}, {S[1], S[3], S[4]}, {S[2], S[4], S[5]}};
    for (int sweep = 0; sweep < JACOBI_SWEEPS; sweep++)
        for (int p = 0; p < 2; p++)
            for (int q = p + 1; q < 3; q++) jacobi_turn(a, p, q);
    *smallest = fmin(a[0][0], fmin(a[1][1], a[2][2]));
    *largest = fmax(a[0][0], fmax(a[1][1], a[2][2]));
}

static void cone3(Trial *t, const double *in) {
    double S[6], smallest, largest, epsilon = t->precision == PRECISION_FLOAT ? (double)FLT_EPSILON : DBL_EPSILON;
    call_cov3(t, in, S);
    eigenvalues3(S, &smallest, &largest);
    trial_at_most(t, "how far the smallest eigenvalue of S is below zero, as a part of the largest: rounding alone",
                  -smallest / largest, 4 * epsilon);
}

static void shape3(Trial *t, const double *in) {
    double S[6];
    Sym3 want = reference_covariance_forward(in + 4, in);
    call_cov3(t, in, S);
    trial_near(t, "S = xx, xy, xz, yy, yz, zz", S, (double[]){want.xx, want.xy, want.xz, want.yy, want.yz, want.zz}, 6,
               largest3(in));
}

// ---- pictures: the blob after a step against the gradient ----

static double largest_of(const double g[3]) { return fmax(fabs(g[0]), fmax(fabs(g[1]), fabs(g[2]))) + 1e-30; }

static bool picture_raw(Subject *subject, const double *in, ImageF *yours, ImageF *reference) {
    Sym2 cov = covariance_of(in + FACTORS);
    double S[3] = {cov.xx, cov.xy, cov.yy}, width = in[WIDTH], height = in[HEIGHT], g[3], want[3];
    const double *e = in + ERRORS;
    if (!CALL(subject_call, subject, "grad_raw", IN_ARRAY(S, 3), IN(width), IN(height),
              IN_ARRAY(e, (int)(width * height)), OUT_ARRAY(g, 3)))
        return false;
    expected_raw(in, want);
    double step = 0.4 * minor_of(in) / largest_of(want), seen = blob_picture_fit(cov);
    *yours = blob_picture((Sym2){S[0] - step * g[0], S[1] - step * g[1], S[2] - step * g[2]}, seen);
    *reference = blob_picture((Sym2){S[0] - step * want[0], S[1] - step * want[1], S[2] - step * want[2]}, seen);
    return true;
}

static ImageF stepped_picture(const double *in, const double g[3], double step) {
    const double *f = in + FACTORS, moved[3] = {f[0] - step * g[0], f[1] - step * g[1], f[2] - step * g[2]};
    return blob_picture(covariance_of(moved), blob_picture_fit(covariance_of(f)));
}

static bool picture_factored(Subject *subject, const double *in, ImageF *yours, ImageF *reference) {
    double th = in[FACTORS], width = in[WIDTH], height = in[HEIGHT], g[3], want[3];
    const double *logs = in + FACTORS + 1, *e = in + ERRORS;
    if (!CALL(subject_call, subject, "grad_factored", IN(th), IN_ARRAY(logs, 2), IN(width), IN(height),
              IN_ARRAY(e, (int)(width * height)), OUT_ARRAY(g, 3)))
        return false;
    expected_factored(in, want);
    *yours = stepped_picture(in, g, 0.4 / largest_of(want));
    *reference = stepped_picture(in, want, 0.4 / largest_of(want));
    return true;
}

// Where the walk ended, and where it was to end.
static bool picture_walk(Subject *subject, const double *in, ImageF *yours, ImageF *reference) {
    Trial trial = {.subject = subject, .precision = PRECISION_DOUBLE};
    Sym2 end = {0}, want = streak_of(in);
    factored_walk(&trial, in, &end);
    *yours = blob_picture(end, blob_picture_fit(want));
    *reference = blob_picture(want, blob_picture_fit(want));
    return !trial.failed;
}

static const Rung RUNGS[] = {
    {.name = "raw_pixel",
     .claim = "one pixel's pull on xx, xy and yy",
     .cases = 8,
     .count = NUMBERS,
     .double_only = true,
     .draw = draw_one_pixel,
     .allows = allows_blob,
     .check = raw,
     .picture = picture_raw},
    {.name = "raw",
     .claim = "the gradient by the three stored numbers, over the whole picture",
     .cases = 8,
     .count = NUMBERS,
     .double_only = true,
     .draw = draw_all_pixels,
     .allows = allows_blob,
     .check = raw,
     .picture = picture_raw},
    {.name = "wall",
     .claim =
         "by its raw entries the disc on its way to a streak leaves the covariances, at the step at which ours does",
     .cases = 1,
     .count = 3,
     .double_only = true,
     .draw = draw_streak,
     .allows = allows_no_other,
     .check = wall},
    {.name = "factored",
     .claim = "the gradient by theta, ln sx and ln sy",
     .cases = 8,
     .count = NUMBERS,
     .double_only = true,
     .draw = draw_all_pixels,
     .allows = allows_blob,
     .check = factored,
     .picture = picture_factored},
    {.name = "adjoint",
     .claim = "both gradients say the same of growing and of turning",
     .cases = 8,
     .count = NUMBERS,
     .double_only = true,
     .draw = draw_all_pixels,
     .allows = allows_blob,
     .check = adjoint},
    {.name = "no_wall",
     .claim = "by its factors the same disc becomes the streak",
     .cases = 1,
     .count = 3,
     .double_only = true,
     .draw = draw_streak,
     .allows = allows_no_other,
     .check = no_wall,
     .picture = picture_walk},
    {.name = "cone3",
     .claim = "in 3-D no choice of factors gives an eigenvalue below zero",
     .cases = 60,
     .count = 7,
     .draw = draw_factors3,
     .allows = allows_factors3,
     .check = cone3},
    {.name = "shape3",
     .claim = "the six numbers are those of R S S^T R^T",
     .count = 7,
     .draw = draw_factors3,
     .allows = allows_factors3,
     .check = shape3},
};

const Exercise EXERCISE_PSD = {
    .number = 3,
    .name = "psd",
    .title = "which numbers of a covariance to learn",
    .minutes = 60,
    .unlocks = "the wall round the covariances, where both descents run: splatlab demo psd",
    .rungs = RUNGS,
    .rung_count = sizeof RUNGS / sizeof *RUNGS,
};
