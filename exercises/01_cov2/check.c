// check.c - E01: what a covariance from angle and scales must fulfil.
#include "exercises/harness/blob_picture.h"
#include "exercises/harness/catalogue.h"

#include <math.h>

static const double SCALE_MIN = 1e-3, SCALE_MAX = 1e3; // px

// A case is theta, sx, sy.
static void draw(Rng *rng, int k, double *in) {
    in[0] = rng_range(rng, -4 * M_PI, 4 * M_PI);
    for (int i = 1; i <= 2; i++) in[i] = exp(rng_range(rng, log(SCALE_MIN), log(SCALE_MAX)));
    if (k == 1) in[2] = in[1];
}

static bool allows(const double *in) { return in[1] >= 0 && in[2] >= 0; }

static Sym2 call(Trial *t, double theta, double sx, double sy) {
    double S[3];
    CALL(trial_call, t, "cov2_from_rs", IN(theta), IN(sx), IN(sy), OUT_ARRAY(S, 3));
    return (Sym2){S[0], S[1], S[2]};
}

static double trace_of(double sx, double sy) { return sx * sx + sy * sy > 0 ? sx * sx + sy * sy : 1; }

// ---- rungs ----

static void draw_unturned(Rng *rng, int k, double *in) {
    draw(rng, k, in);
    in[0] = 0;
}

static bool allows_unturned(const double *in) { return in[0] == 0 && allows(in); }

static void unturned(Trial *t, const double *in) {
    Sym2 S = call(t, in[0], in[1], in[2]);
    trial_near(t, "S = xx, xy, yy at theta = 0: sx^2, 0, sy^2", (double[]){S.xx, S.xy, S.yy},
               (double[]){in[1] * in[1], 0, in[2] * in[2]}, 3, trace_of(in[1], in[2]));
}

static void eigenvalues(Trial *t, const double *in) {
    Eigen2 eigen = sym2_eigen(call(t, in[0], in[1], in[2]));
    double sx = in[1], sy = in[2];
    trial_near(t, "the eigenvalues of S, larger first: the squares of the scales", (double[]){eigen.major, eigen.minor},
               (double[]){fmax(sx * sx, sy * sy), fmin(sx * sx, sy * sy)}, 2, trace_of(sx, sy));
}

// S u = sx^2 u for the unit vector u at the angle theta.
static void direction(Trial *t, const double *in) {
    double c = cos(in[0]), s = sin(in[0]), x2 = in[1] * in[1];
    Sym2 S = call(t, in[0], in[1], in[2]);
    trial_near(t, "S u for u = (cos theta, sin theta), the axis of sx: sx^2 u",
               (double[]){S.xx * c + S.xy * s, S.xy * c + S.yy * s}, (double[]){x2 * c, x2 * s}, 2,
               trace_of(in[1], in[2]));
}

static void determinant(Trial *t, const double *in) {
    double trace = trace_of(in[1], in[2]), area = in[1] * in[2];
    trial_near1(t, "the determinant of S: (sx sy)^2", sym2_determinant(call(t, in[0], in[1], in[2])), area * area,
                trace * trace);
}

// A quarter turn written as a double is not exact in float, so the turned angle is rounded and its reference is computed.
static void turns(Trial *t, const double *in) {
    double theta = (float)(in[0] + M_PI / 2);
    Sym2 S = call(t, theta, in[2], in[1]), want = covariance_from_angle(theta, in[2], in[1]);
    trial_near(t, "S = xx, xy, yy after a quarter turn with the scales exchanged", (double[]){S.xx, S.xy, S.yy},
               (double[]){want.xx, want.xy, want.yy}, 3, trace_of(in[1], in[2]));
}

static void draw_flat(Rng *rng, int k, double *in) {
    draw(rng, k, in);
    in[1 + k % 2] = 0;
    if (k == 4) in[1] = in[2] = 0;
}

static bool allows_flat(const double *in) { return allows(in) && in[1] * in[2] == 0; }

static void flat(Trial *t, const double *in) {
    Sym2 S = call(t, in[0], in[1], in[2]), want = covariance_from_angle(in[0], in[1], in[2]);
    trial_near(t, "S = xx, xy, yy of a blob without width: of rank 1, and no NaN", (double[]){S.xx, S.xy, S.yy},
               (double[]){want.xx, want.xy, want.yy}, 3, trace_of(in[1], in[2]));
}

static bool picture(Subject *subject, const double *in, ImageF *yours, ImageF *reference) {
    double theta = in[0], sx = in[1], sy = in[2], S[3];
    if (!CALL(subject_call, subject, "cov2_from_rs", IN(theta), IN(sx), IN(sy), OUT_ARRAY(S, 3))) return false;
    Sym2 want = covariance_from_angle(theta, sx, sy);
    *yours = blob_picture((Sym2){S[0], S[1], S[2]}, blob_picture_fit(want));
    *reference = blob_picture(want, blob_picture_fit(want));
    return true;
}

static const Rung RUNGS[] = {
    {.name = "unturned",
     .claim = "without a turn, S holds the squares of the scales",
     .count = 3,
     .draw = draw_unturned,
     .allows = allows_unturned,
     .check = unturned,
     .picture = picture},
    {.name = "eigenvalues",
     .claim = "turning does not change the eigenvalues: they are sx^2 and sy^2",
     .count = 3,
     .draw = draw,
     .allows = allows,
     .check = eigenvalues,
     .picture = picture},
    {.name = "direction",
     .claim = "the axis of sx points along theta, from +x towards +y",
     .count = 3,
     .draw = draw,
     .allows = allows,
     .check = direction,
     .picture = picture},
    {.name = "determinant",
     .claim = "the determinant is (sx sy)^2, the area squared",
     .count = 3,
     .draw = draw,
     .allows = allows,
     .check = determinant,
     .picture = picture},
    {.name = "turns",
     .claim = "a quarter turn exchanges the scales",
     .count = 3,
     .draw = draw,
     .allows = allows,
     .check = turns,
     .picture = picture},
    {.name = "flat",
     .claim = "a scale of zero gives a matrix of rank 1",
     .count = 3,
     .draw = draw_flat,
     .allows = allows_flat,
     .check = flat},
};

const Exercise EXERCISE_COV2 = {
    .number = 1,
    .name = "cov2",
    .title = "a blob's covariance from its angle and two scales",
    .minutes = 20,
    .unlocks = "your blobs in the widget: splatlab widget --mine",
    .rungs = RUNGS,
    .rung_count = sizeof RUNGS / sizeof *RUNGS,
};
