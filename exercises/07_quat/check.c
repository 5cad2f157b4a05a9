// check.c - E07: what a rotation from a quaternion, and its gradient, must fulfil.
#include "exercises/harness/catalogue.h"
#include "exercises/harness/line_picture.h"
#include "lab/base/vec.h"
#include "splat3d/reference.h"

static const double LENGTH_MIN = 0.1, LENGTH_MAX = 10; // of q
static const double LENGTH_LEAST = 1e-3;               // for smaller cases: far from a q that names no rotation

enum { Q = 4, R_COUNT = 9 };

static double length_of(const double q[4]) { return sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]); }

// Any direction, any length; the first cases are no turn, half a turn, and an angle above half a turn (w < 0).
static void draw_quaternion(Rng *rng, int k, double q[4]) {
    for (int i = 0; i < 4; i++) q[i] = rng_normal(rng);
    if (k == 0) q[1] = q[2] = q[3] = 0;
    if (k == 1) q[0] = 0;
    if (k == 2) q[0] = -fabs(q[0]);
    double length = length_of(q), wanted = exp(rng_range(rng, log(LENGTH_MIN), log(LENGTH_MAX)));
    for (int i = 0; i < 4 && length > 0; i++) q[i] *= wanted / length;
}

static bool allows(const double *q) { return length_of(q) >= LENGTH_LEAST; }

// ---- the rotation ----

// A case is the axis (0 x, 1 y, 2 z) and the two parts of q that are not 0. The length stays away from 1, where a q that is
// not normalised is nearly right and a message would not show why.
static void draw_about_axis(Rng *rng, int k, double *in) {
    double half_rad = rng_range(rng, -3, 3), away = rng_range(rng, log(1.5), log(LENGTH_MAX));
    double wanted = exp(k % 2 ? -away : away);
    in[0] = k % 3;
    in[1] = wanted * cos(half_rad);
    in[2] = wanted * sin(half_rad);
}

static bool allows_about_axis(const double *in) {
    double length = hypot(in[1], in[2]);
    return (in[0] == 0 || in[0] == 1 || in[0] == 2) && length >= LENGTH_LEAST && fabs(length - 1) > 0.2;
}

static void quaternion_about_axis(const double *in, double q[4]) {
    q[0] = in[1];
    for (int i = 0; i < 3; i++) q[1 + i] = i == in[0] ? in[2] : 0;
}

static Mat3 matrix_about_axis(int axis, double angle_rad) {
    int next = (axis + 1) % 3, last = (axis + 2) % 3;
    Mat3 R = {{0}};
    R.m[4 * axis] = 1;
    R.m[4 * next] = R.m[4 * last] = cos(angle_rad);
    R.m[3 * next + last] = -sin(angle_rad);
    R.m[3 * last + next] = sin(angle_rad);
    return R;
}

static void about_axis(Trial *trial, const double *in) {
    double q[4], R[9];
    quaternion_about_axis(in, q);
    CALL(trial_call, trial, "quat_to_R", IN_ARRAY(q, 4), OUT_ARRAY(R, 9));
    Mat3 want = matrix_about_axis((int)in[0], 2 * atan2(in[2], in[1]));
    trial_near(trial, "R of a turn about one coordinate axis, row by row", R, want.m, 9, 1);
}

static void orthonormal(Trial *trial, const double *q) {
    Mat3 R;
    CALL(trial_call, trial, "quat_to_R", IN_ARRAY(q, 4), ARG_OUT("R", R.m, 9));
    Mat3 T = mat3_transpose(&R), product = mat3_multiply(&T, &R);
    Vec3 x = vec3(R.m[0], R.m[1], R.m[2]), y = vec3(R.m[3], R.m[4], R.m[5]), z = vec3(R.m[6], R.m[7], R.m[8]);
    trial_near(trial, "R^T R, row by row: the identity", product.m, (double[]){1, 0, 0, 0, 1, 0, 0, 0, 1}, 9, 1);
    trial_near1(trial, "det R: 1, no mirror image", vec3_dot(vec3_cross(x, y), z), 1, 1);
}

// Rodrigues' formula, which knows no quaternion: v cos a + (n x v) sin a + n (n . v) (1 - cos a).
static Vec3 turned(Vec3 n, double angle_rad, Vec3 v) {
    Vec3 out = vec3_add(vec3_scale(v, cos(angle_rad)), vec3_scale(vec3_cross(n, v), sin(angle_rad)));
    return vec3_add(out, vec3_scale(n, vec3_dot(n, v) * (1 - cos(angle_rad))));
}

static void about_any(Trial *trial, const double *q) {
    double R[9], want[9];
    CALL(trial_call, trial, "quat_to_R", IN_ARRAY(q, 4), OUT_ARRAY(R, 9));
    Vec3 part = vec3(q[1], q[2], q[3]), n = vec3_normalize(part);
    double angle = 2 * atan2(vec3_length(part), q[0]);
    for (int k = 0; k < 3; k++) {
        Vec3 column = turned(n, angle, vec3(k == 0, k == 1, k == 2));
        want[k] = column.x, want[3 + k] = column.y, want[6 + k] = column.z;
    }
    trial_near(trial, "R of the turn by 2 atan2(|xyz|, w) about (x, y, z), row by row", R, want, 9, 1);
}

// A case is q and the exponent of a factor; powers of two multiply without rounding.
static void draw_length(Rng *rng, int k, double *in) {
    draw_quaternion(rng, k, in);
    in[Q] = (double)rng_below(rng, 7) - 3;
    in[Q + 1] = k % 2 ? 1 : -1;
}

static bool allows_length(const double *in) {
    return allows(in) && fabs(in[Q]) <= 8 && in[Q] == floor(in[Q]) && fabs(in[Q + 1]) == 1;
}

static void length(Trial *trial, const double *in) {
    double q[4], R_before[9], R[9], factor = in[Q + 1] * ldexp(1, (int)in[Q]);
    for (int i = 0; i < 4; i++) q[i] = in[i];
    CALL(trial_call, trial, "quat_to_R", IN_ARRAY(q, 4), ARG_OUT("R", R_before, 9));
    for (int i = 0; i < 4; i++) q[i] = factor * in[i];
    CALL(trial_call, trial, "quat_to_R", IN_ARRAY(q, 4), OUT_ARRAY(R, 9));
    trial_near(trial, "R of a multiple of q (also of -q): your R of q itself", R, R_before, 9, 1);
}

static void draw_pair(Rng *rng, int k, double *in) {
    draw_quaternion(rng, k, in);
    draw_quaternion(rng, 3, in + Q);
}

static bool allows_pair(const double *in) { return allows(in) && allows(in + Q); }

// Hamilton's product: first turn by b, then by a.
static void multiply(const double a[4], const double b[4], double ab[4]) {
    ab[0] = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
    ab[1] = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2];
    ab[2] = a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1];
    ab[3] = a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0];
}

static void product(Trial *trial, const double *in) {
    const double *a = in, *b = in + Q;
    double q[4];
    Mat3 R_a, R_b, R;
    multiply(a, b, q);
    CALL(trial_call, trial, "quat_to_R", ARG_IN("q", (double *)a, 4), ARG_OUT("R", R_a.m, 9));
    CALL(trial_call, trial, "quat_to_R", ARG_IN("q", (double *)b, 4), ARG_OUT("R", R_b.m, 9));
    CALL(trial_call, trial, "quat_to_R", IN_ARRAY(q, 4), ARG_OUT("R", R.m, 9));
    Mat3 want = mat3_multiply(&R_a, &R_b);
    trial_near(trial, "R of Hamilton's product a b: your R(a) times your R(b)", R.m, want.m, 9, 1);
}

// ---- the gradient ----

// A case is q and dR: first one entry of R at a time, then all together.
static void draw_gradient(Rng *rng, int k, double *in) {
    draw_quaternion(rng, k + 3, in);
    for (int i = 0; i < R_COUNT; i++) in[Q + i] = k < R_COUNT ? i == k : rng_normal(rng);
}

static double norm_of(const double *v, int count) {
    double sum = 0;
    for (int i = 0; i < count; i++) sum += v[i] * v[i];
    return sum > 0 ? sqrt(sum) : 1;
}

static void call_vjp(Trial *trial, const double *q, const double *dR, double dq[4]) {
    CALL(trial_call, trial, "quat_to_R_vjp", IN_ARRAY(q, 4), IN_ARRAY(dR, 9), ARG_OUT("dq", dq, 4));
}

static void tangent(Trial *trial, const double *in) {
    double dq[4];
    call_vjp(trial, in, in + Q, dq);
    double along = in[0] * dq[0] + in[1] * dq[1] + in[2] * dq[2] + in[3] * dq[3];
    trial_near1(trial, "q . dq: 0, a longer q is the same rotation", along, 0, norm_of(in + Q, R_COUNT));
}

static void gradient(Trial *trial, const double *in) {
    double dq[4], want[4] = {0};
    call_vjp(trial, in, in + Q, dq);
    Mat3 d_rotation;
    for (int i = 0; i < R_COUNT; i++) d_rotation.m[i] = in[Q + i];
    reference_rotation_backward(in, &d_rotation, want);
    trial_near(trial, "dq = w, x, y, z", dq, want, 4, norm_of(in + Q, R_COUNT) / length_of(in));
}

static void draw_adjoint(Rng *rng, int k, double *in) {
    draw_gradient(rng, k + R_COUNT, in);
    for (int i = 0; i < Q; i++) in[Q + R_COUNT + i] = rng_normal(rng);
}

// dR . (R(q + h v) - R(q - h v)) / 2h against dq . v: yours against yours, no reference in it.
static void adjoint(Trial *trial, const double *in) {
    static const double WEIGHT[4] = {1.0 / 12, -8.0 / 12, 8.0 / 12, -1.0 / 12}; // at -2h, -h, h, 2h: of fourth order
    const double *dR = in + Q, *v = dR + R_COUNT;
    double dq[4], q[4], R[9], slope = 0, along = 0, h = 1e-3 * length_of(in) / norm_of(v, Q);
    for (int step = 0; step < 4; step++) {
        int at = step < 2 ? step - 2 : step - 1;
        for (int i = 0; i < Q; i++) q[i] = in[i] + at * h * v[i];
        CALL(trial_call, trial, "quat_to_R", IN_ARRAY(q, 4), OUT_ARRAY(R, 9));
        for (int i = 0; i < R_COUNT; i++) slope += WEIGHT[step] / h * R[i] * dR[i];
    }
    call_vjp(trial, in, dR, dq);
    for (int i = 0; i < Q; i++) along += dq[i] * v[i];
    trial_near1(trial, "dq . v for a step v of q: the change of dR . R along v, by central differences of your own R",
                along, slope, norm_of(dR, R_COUNT) * norm_of(v, Q) / length_of(in));
}

// ---- pictures ----

// The axes x, y, z after the turn, seen a little from the right and above.
static ImageF draw_axes(const double R[9]) {
    enum { SIDE = 200, ARM = 70 };
    static const float *const RGB[3] = {LINE_RED, LINE_GREEN, LINE_BLUE};
    ImageF image = line_picture_create(SIDE, SIDE);
    const double middle[2] = {SIDE / 2, SIDE / 2};
    for (int k = 0; k < 3; k++) {
        double x = R[k], y = R[3 + k], z = R[6 + k];
        double tip[2] = {middle[0] + ARM * (x + 0.45 * z), middle[1] + ARM * (y - 0.3 * z)};
        line_picture_arrow(&image, middle, tip, RGB[k]);
    }
    return image;
}

static bool picture_of(Subject *subject, const double *q, ImageF *yours, ImageF *reference) {
    double R[9];
    if (!CALL(subject_call, subject, "quat_to_R", IN_ARRAY(q, 4), OUT_ARRAY(R, 9))) return false;
    Mat3 want = reference_rotation_forward(q);
    *yours = draw_axes(R);
    *reference = draw_axes(want.m);
    return true;
}

static bool picture_about_axis(Subject *subject, const double *in, ImageF *yours, ImageF *reference) {
    double q[4];
    quaternion_about_axis(in, q);
    return picture_of(subject, q, yours, reference);
}

static const Rung RUNGS[] = {
    {.name = "axes",
     .claim = "(cos a/2, 0, 0, sin a/2), of any length, turns x towards y by the angle a; likewise about x and y",
     .count = 3,
     .draw = draw_about_axis,
     .allows = allows_about_axis,
     .check = about_axis,
     .picture = picture_about_axis},
    {.name = "orthonormal",
     .claim = "R is a rotation: R^T R = I, and its determinant is +1",
     .count = Q,
     .draw = draw_quaternion,
     .allows = allows,
     .check = orthonormal,
     .picture = picture_of},
    {.name = "any_axis",
     .claim = "R turns about (x, y, z) by 2 atan2(|xyz|, w), as Rodrigues' formula does",
     .count = Q,
     .draw = draw_quaternion,
     .allows = allows,
     .check = about_any,
     .picture = picture_of},
    {.name = "length",
     .claim = "the length and the sign of q do not matter: R(k q) = R(q)",
     .count = Q + 2,
     .draw = draw_length,
     .allows = allows_length,
     .check = length},
    {.name = "product",
     .claim = "turning by b and then by a is turning by the product: R(a b) = R(a) R(b)",
     .count = 2 * Q,
     .draw = draw_pair,
     .allows = allows_pair,
     .check = product},
    {.name = "tangent",
     .claim = "the gradient by q has no part along q",
     .count = Q + R_COUNT,
     .double_only = true,
     .draw = draw_gradient,
     .allows = allows,
     .check = tangent},
    {.name = "gradient",
     .claim = "dq is the derivative by each stored number of a q of any length",
     .count = Q + R_COUNT,
     .double_only = true,
     .draw = draw_gradient,
     .allows = allows,
     .check = gradient},
    {.name = "adjoint",
     .claim = "the gradient belongs to your own quat_to_R(): small steps of q change R as dq says",
     .count = Q + R_COUNT + Q,
     .double_only = true,
     .draw = draw_adjoint,
     .allows = allows,
     .check = adjoint},
};

const Exercise EXERCISE_QUAT = {
    .number = 7,
    .name = "quat",
    .title = "a rotation from four free numbers, and its gradient",
    .minutes = 60,
    .unlocks = "E08, where a blob in space takes its directions from it",
    .rungs = RUNGS,
    .rung_count = sizeof RUNGS / sizeof *RUNGS,
};
