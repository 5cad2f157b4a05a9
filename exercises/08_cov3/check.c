// check.c - E08: what a covariance from a quaternion and log-scales, and its gradient, must fulfil.
#include "exercises/harness/blob_picture.h"
#include "exercises/harness/catalogue.h"
#include "exercises/harness/sym3_eigen.h"

#include <string.h>

// A case begins with q and logs; a gradient's goes on with dS.
enum { Q = 4, LOGS = 3, SHAPE = Q + LOGS, STORED = 6 };

static const double LENGTH_MIN = 0.1, LENGTH_MAX = 10, LENGTH_LEAST = 1e-3; // of q; the least for smaller cases
static const double ASPECT_MAX = 30, LOGS_MAX = 20;

// ---- cases ----

static double norm_of(const double *v, int count) {
    double sum = 0;
    for (int i = 0; i < count; i++) sum += v[i] * v[i];
    return sum > 0 ? sqrt(sum) : 1;
}

static void draw_quaternion(Rng *rng, double q[4]) {
    for (int i = 0; i < Q; i++) q[i] = rng_normal(rng);
    double wanted = exp(rng_range(rng, log(LENGTH_MIN), log(LENGTH_MAX))), length = norm_of(q, Q);
    for (int i = 0; i < Q; i++) q[i] *= wanted / length;
}

static void draw_shape(Rng *rng, int k, double *in) {
    draw_quaternion(rng, in);
    double base = rng_range(rng, -5, 1.5);
    for (int i = 0; i < LOGS; i++) in[Q + i] = base + rng_range(rng, 0, log(ASPECT_MAX));
    if (k == 1) in[Q + 1] = in[Q]; // a disc or a cigar
}

static bool allows(const double *in) {
    for (int i = 0; i < LOGS; i++)
        if (fabs(in[Q + i]) > LOGS_MAX) return false;
    return sqrt(in[0] * in[0] + in[1] * in[1] + in[2] * in[2] + in[3] * in[3]) >= LENGTH_LEAST;
}

static void draw_unturned(Rng *rng, int k, double *in) {
    draw_shape(rng, k, in);
    in[1] = in[2] = in[3] = 0;
}
static bool allows_unturned(const double *in) { return in[1] == 0 && in[2] == 0 && in[3] == 0 && allows(in); }

static void draw_ball(Rng *rng, int k, double *in) {
    draw_shape(rng, k, in);
    in[Q + 1] = in[Q + 2] = in[Q];
}
static bool is_ball(const double *in) { return in[Q] == in[Q + 1] && in[Q] == in[Q + 2]; }

// Whatever an optimiser may leave there.
static void draw_any(Rng *rng, int k, double *in) {
    draw_quaternion(rng, in);
    for (int i = 0; i < LOGS; i++) in[Q + i] = rng_range(rng, -8, 3);
    if (k == 0) in[Q] = -8, in[Q + 1] = -8, in[Q + 2] = 3; // a needle
    if (k == 1) in[Q] = -8, in[Q + 1] = 3, in[Q + 2] = 3;  // a leaf
}

// One or two scales so small that their squares are nothing beside the others'.
static void draw_flat(Rng *rng, int k, double *in) {
    draw_shape(rng, k, in);
    in[Q + k % 3] = rng_range(rng, -150, -60);
    if (k % 2) in[Q + (k + 1) % 3] = rng_range(rng, -150, -60);
}
static bool allows_flat(const double *in) {
    double largest = fmax(in[Q], fmax(in[Q + 1], in[Q + 2])), smallest = fmin(in[Q], fmin(in[Q + 1], in[Q + 2]));
    return fabs(largest) < LOGS_MAX && smallest < -50 && norm_of(in, Q) >= LENGTH_LEAST;
}

// One stored number alone and all together, by turns.
static void draw_gradient(Rng *rng, int k, double *in) {
    draw_shape(rng, k + 2, in);
    for (int i = 0; i < STORED; i++) in[SHAPE + i] = k % 2 ? rng_normal(rng) : i == k / 2;
}

static void draw_trace(Rng *rng, int k, double *in) {
    draw_shape(rng, k + 2, in);
    for (int i = 0; i < STORED; i++) in[SHAPE + i] = i == 0 || i == 3 || i == 5;
}
static bool allows_trace(const double *in) {
    const double *dS = in + SHAPE;
    return allows(in) && dS[0] == 1 && dS[1] == 0 && dS[2] == 0 && dS[3] == 1 && dS[4] == 0 && dS[5] == 1;
}

// After the shape comes a direction n of any length.
static void draw_direction(Rng *rng, int k, double *in) {
    draw_shape(rng, k + 2, in);
    for (int i = 0; i < 3; i++) in[SHAPE + i] = k < 3 ? i == k : rng_normal(rng);
}

static void draw_ball_gradient(Rng *rng, int k, double *in) {
    draw_gradient(rng, k, in);
    in[Q + 1] = in[Q + 2] = in[Q];
}
static bool allows_ball(const double *in) { return allows(in) && is_ball(in); }

static void draw_adjoint(Rng *rng, int k, double *in) {
    draw_gradient(rng, 2 * k + 1, in);
    for (int i = 0; i < SHAPE; i++) in[SHAPE + STORED + i] = rng_normal(rng);
}

// ---- the covariance ----

static double trace_of(const double *logs) { return exp(2 * logs[0]) + exp(2 * logs[1]) + exp(2 * logs[2]); }

static Sym3 call(Trial *trial, const double *in) {
    const double *q = in, *logs = in + Q;
    double S[6];
    CALL(trial_call, trial, "cov3", IN_ARRAY(q, 4), IN_ARRAY(logs, 3), OUT_ARRAY(S, 6));
    return (Sym3){S[0], S[1], S[2], S[3], S[4], S[5]};
}

static void unturned(Trial *trial, const double *in) {
    Sym3 S = call(trial, in);
    const double *logs = in + Q, want[6] = {exp(2 * logs[0]), 0, 0, exp(2 * logs[1]), 0, exp(2 * logs[2])};
    trial_near(trial, "S = xx, xy, xz, yy, yz, zz of a blob that is not turned: exp(2 logs) and zeros", &S.xx, want, 6,
               trace_of(logs));
}

// S times the k-th column of R is s_k^2 times that column.
static void axes(Trial *trial, const double *in) {
    static const char *const CLAIMS[3] = {"S u for u = the first column of R: s^2 u of the first scale",
                                          "S u for u = the second column of R: s^2 u of the second scale",
                                          "S u for u = the third column of R: s^2 u of the third scale"};
    Sym3 S = call(trial, in);
    Mat3 R = reference_rotation_forward(in);
    for (int k = 0; k < 3; k++) {
        double x = R.m[k], y = R.m[3 + k], z = R.m[6 + k], square = exp(2 * in[Q + k]);
        const double yours[3] = {S.xx * x + S.xy * y + S.xz * z, S.xy * x + S.yy * y + S.yz * z,
                                 S.xz * x + S.yz * y + S.zz * z};
        trial_near(trial, CLAIMS[k], yours, (double[]){square * x, square * y, square * z}, 3, trace_of(in + Q));
    }
}

static void ball(Trial *trial, const double *in) {
    Sym3 S = call(trial, in);
    double square = exp(2 * in[Q]);
    trial_near(trial, "S = xx, xy, xz, yy, yz, zz of a ball: s^2 I, however it is turned", &S.xx,
               (double[]){square, 0, 0, square, 0, square}, 6, square);
}

static void sort_up(double v[3]) {
    double low = fmin(v[0], fmin(v[1], v[2])), high = fmax(v[0], fmax(v[1], v[2]));
    double middle = fmax(fmin(v[0], v[1]), fmin(fmax(v[0], v[1]), v[2]));
    v[0] = low, v[1] = middle, v[2] = high;
}

static void psd(Trial *trial, const double *in) {
    double values[3], squares[3];
    sym3_eigenvalues(call(trial, in), values);
    for (int k = 0; k < 3; k++) squares[k] = exp(2 * in[Q + k]);
    sort_up(squares);
    trial_near1(trial, "the smallest eigenvalue of S, where it is below 0: never, but for rounding", fmin(values[0], 0),
                0, squares[2]);
    trial_near(trial, "the eigenvalues of S, smallest first: the squares of the scales", values, squares, 3,
               squares[2]);
}

static void flat(Trial *trial, const double *in) {
    Sym3 S = call(trial, in), want = reference_covariance_forward(in + Q, in);
    trial_near(trial, "S = xx, xy, xz, yy, yz, zz of a blob without thickness", &S.xx, &want.xx, 6, trace_of(in + Q));
}

// ---- the gradient ----

typedef struct {
    double q[4], logs[3];
} Gradient;

static Gradient call_vjp(Trial *trial, const double *in) {
    const double *q = in, *logs = in + Q, *dS = in + SHAPE;
    Gradient d;
    CALL(trial_call, trial, "cov3_vjp", IN_ARRAY(q, 4), IN_ARRAY(logs, 3), IN_ARRAY(dS, 6), ARG_OUT("dq", d.q, 4),
         ARG_OUT("dlogs", d.logs, 3));
    return d;
}

static double gradient_scale(const double *in) { return trace_of(in + Q) * norm_of(in + SHAPE, STORED); }

static void trace(Trial *trial, const double *in) {
    Gradient d = call_vjp(trial, in);
    const double *logs = in + Q, scale = gradient_scale(in);
    trial_near(trial, "dlogs for the trace of S, dS = 1, 0, 0, 1, 0, 1: twice the squares of the scales", d.logs,
               (double[]){2 * exp(2 * logs[0]), 2 * exp(2 * logs[1]), 2 * exp(2 * logs[2])}, 3, scale);
    trial_near(trial, "dq for the trace of S: 0, no turn changes it", d.q, (double[]){0, 0, 0, 0}, 4,
               scale / norm_of(in, Q));
}

// n . S n is the sum of s_k^2 (r_k . n)^2: the reason why it is never negative. By log s_k each part gives twice itself.
static void spread(Trial *trial, const double *in) {
    const double *n = in + SHAPE;
    double with_dS[SHAPE + STORED], want[3];
    const double dS[STORED] = {n[0] * n[0], 2 * n[0] * n[1], 2 * n[0] * n[2],
                               n[1] * n[1], 2 * n[1] * n[2], n[2] * n[2]};
    memcpy(with_dS, in, SHAPE * sizeof *in);
    memcpy(with_dS + SHAPE, dS, sizeof dS);
    Gradient d = call_vjp(trial, with_dS);
    Mat3 R = reference_rotation_forward(in);
    for (int k = 0; k < 3; k++) {
        double along = R.m[k] * n[0] + R.m[3 + k] * n[1] + R.m[6 + k] * n[2];
        want[k] = 2 * exp(2 * in[Q + k]) * along * along;
    }
    trial_near(trial, "dlogs for n . S n, the variance along n: 2 s^2 (r . n)^2 for each scale s and its column r of R",
               d.logs, want, 3, gradient_scale(with_dS));
}

static void gradient(Trial *trial, const double *in) {
    Gradient d = call_vjp(trial, in), want = {0};
    Sym3 d_covariance;
    memcpy(&d_covariance.xx, in + SHAPE, sizeof d_covariance);
    reference_covariance_backward(in + Q, in, d_covariance, want.logs, want.q);
    double scale = gradient_scale(in);
    trial_near(trial, "dlogs", d.logs, want.logs, 3, scale);
    trial_near(trial, "dq = w, x, y, z", d.q, want.q, 4, scale / norm_of(in, Q));
}

static void still_ball(Trial *trial, const double *in) {
    Gradient d = call_vjp(trial, in);
    trial_near(trial, "dq of a ball: 0, a turn does not change it", d.q, (double[]){0, 0, 0, 0}, 4,
               gradient_scale(in) / norm_of(in, Q));
}

static void tangent(Trial *trial, const double *in) {
    Gradient d = call_vjp(trial, in);
    double along = in[0] * d.q[0] + in[1] * d.q[1] + in[2] * d.q[2] + in[3] * d.q[3];
    trial_near1(trial, "q . dq: 0, a longer q is the same blob", along, 0, gradient_scale(in));
}

// dS . (S(p + h v) - S(p - h v)) / 2h against dp . v for p = (q, logs): yours against yours, no reference in it.
static void adjoint(Trial *trial, const double *in) {
    static const double WEIGHT[4] = {1.0 / 12, -8.0 / 12, 8.0 / 12, -1.0 / 12}; // at -2h, -h, h, 2h: of fourth order
    const double *dS = in + SHAPE, *v = dS + STORED;
    double moved[SHAPE], length = norm_of(in, Q), h = 1e-3 * fmin(length, 1) / norm_of(v, SHAPE), slope = 0, along = 0;
    for (int step = 0; step < 4; step++) {
        int at = step < 2 ? step - 2 : step - 1;
        for (int i = 0; i < SHAPE; i++) moved[i] = in[i] + at * h * v[i];
        Sym3 S = call(trial, moved);
        for (int i = 0; i < STORED; i++) slope += WEIGHT[step] / h * (&S.xx)[i] * dS[i];
    }
    Gradient d = call_vjp(trial, in);
    for (int i = 0; i < Q; i++) along += d.q[i] * v[i];
    for (int i = 0; i < LOGS; i++) along += d.logs[i] * v[Q + i];
    trial_near1(trial, "dq, dlogs times a step v of both: the change of dS . S, by central differences of your own S",
                along, slope, gradient_scale(in) * norm_of(v, SHAPE) / fmin(length, 1));
}

// ---- pictures ----

// Seen along z, y and x: a blob's picture from a direction is the 2x2 block of the other two.
static ImageF three_views(Sym3 S, double half_width) {
    ImageF views[3] = {blob_picture((Sym2){S.xx, S.xy, S.yy}, half_width),
                       blob_picture((Sym2){S.xx, S.xz, S.zz}, half_width),
                       blob_picture((Sym2){S.yy, S.yz, S.zz}, half_width)};
    int side = views[0].width;
    ImageF all = imagef_create(3 * side, side, 3);
    for (int k = 0; k < 3; k++) {
        imagef_paste(&all, &views[k], k * side, 0);
        imagef_destroy(&views[k]);
    }
    return all;
}

static bool picture(Subject *subject, const double *in, ImageF *yours, ImageF *reference) {
    const double *q = in, *logs = in + Q;
    double S[6];
    if (!CALL(subject_call, subject, "cov3", IN_ARRAY(q, 4), IN_ARRAY(logs, 3), OUT_ARRAY(S, 6))) return false;
    Sym3 want = reference_covariance_forward(logs, q);
    double half_width = 3 * exp(fmax(logs[0], fmax(logs[1], logs[2])));
    *yours = three_views((Sym3){S[0], S[1], S[2], S[3], S[4], S[5]}, half_width);
    *reference = three_views(want, half_width);
    return true;
}

static const Rung RUNGS[] = {
    {.name = "unturned",
     .claim = "without a turn, S holds the squares of the scales, exp(2 logs)",
     .count = SHAPE,
     .draw = draw_unturned,
     .allows = allows_unturned,
     .check = unturned,
     .picture = picture},
    {.name = "ball",
     .claim = "a ball stays a ball, however it is turned",
     .count = SHAPE,
     .draw = draw_ball,
     .allows = allows_ball,
     .check = ball,
     .picture = picture},
    {.name = "axes",
     .claim = "the blob's axes are the columns of R(q), each with its own scale",
     .count = SHAPE,
     .draw = draw_shape,
     .allows = allows,
     .check = axes,
     .picture = picture},
    {.name = "psd",
     .claim = "any seven numbers give a covariance: no eigenvalue is below zero",
     .count = SHAPE,
     .draw = draw_any,
     .allows = allows,
     .check = psd,
     .picture = picture},
    {.name = "flat",
     .claim = "scales near zero give a leaf or a needle, and no NaN",
     .count = SHAPE,
     .draw = draw_flat,
     .allows = allows_flat,
     .check = flat},
    {.name = "trace",
     .claim = "the trace of S is the sum of the squared scales: only the scales change it",
     .count = SHAPE + STORED,
     .double_only = true,
     .draw = draw_trace,
     .allows = allows_trace,
     .check = trace},
    {.name = "still_ball",
     .claim = "turning a ball changes nothing",
     .count = SHAPE + STORED,
     .double_only = true,
     .draw = draw_ball_gradient,
     .allows = allows_ball,
     .check = still_ball},
    {.name = "tangent",
     .claim = "the gradient by q has no part along q",
     .count = SHAPE + STORED,
     .double_only = true,
     .draw = draw_gradient,
     .allows = allows,
     .check = tangent},
    {.name = "spread",
     .claim = "the variance along n is a sum of squares, and each scale answers for its own part of it",
     .count = SHAPE + 3,
     .double_only = true,
     .draw = draw_direction,
     .allows = allows,
     .check = spread},
    {.name = "gradient",
     .claim = "dq and dlogs are the derivatives, dS being by the stored numbers",
     .count = SHAPE + STORED,
     .double_only = true,
     .draw = draw_gradient,
     .allows = allows,
     .check = gradient},
    {.name = "adjoint",
     .claim = "the gradient belongs to your own cov3(): small steps of q and logs change S as it says",
     .count = SHAPE + STORED + SHAPE,
     .double_only = true,
     .draw = draw_adjoint,
     .allows = allows,
     .check = adjoint},
};

const Exercise EXERCISE_COV3 = {
    .number = 8,
    .name = "cov3",
    .title = "a blob in space: its covariance from seven free numbers, and the gradient",
    .minutes = 60,
    .unlocks = "your own ellipsoids: splatlab render --mine",
    .rungs = RUNGS,
    .rung_count = sizeof RUNGS / sizeof *RUNGS,
};
