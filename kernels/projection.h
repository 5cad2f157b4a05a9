// projection.h - one splat's way from the world to the screen, computed by project_forward.cl and again by project_backward.cl.
//
// EWA splatting (Zwicker et al. 2001, eq. 27-31; Kerbl et al. 2023, eq. 5-6):
//     Sigma' = J W Sigma W^T J^T + low_pass I = M M^T + low_pass I,   M = J W R S  (2 x 3)
// with W the camera's rotation, R the splat's own axes, S its standard deviations, and J the derivative of the perspective
// projection at the mean. J is taken at most a margin outside the picture, where the linear approximation would explode.
//
// Sigma' is kept as the one-dimensional pair that a row-wise picture likes: x given y, then y. With u = dx + shear dy:
//     (dx dy) Sigma'^-1 (dx dy)^T = u^2 / var_u + dy^2 / var_v,   var_v = Sigma'_yy,  var_u = det / Sigma'_yy
// It costs as much as the three-number conic, cannot become negative by rounding, and keeps splats exact that are thousands of pixels
// long and one wide. det is a sum of squares for the same reason (Cauchy-Binet), not a difference of large products:
//     det = |M0 x M1|^2 + low_pass (|M0|^2 + |M1|^2) + low_pass^2
#ifndef SPLATLAB_KERNELS_PROJECTION_H
#define SPLATLAB_KERNELS_PROJECTION_H

#include "splat_lanes.h"

#define LOG2_E          1.44269504f
#define QUAT_LENGTH_MIN 1e-18f // a shorter quaternion has no direction: such a splat is not drawn

// Of LANES splats.
typedef struct {
    Vec3 point;            // mean in camera axes
    Real ratio_x, ratio_y; // x/z, y/z, clamped for J
    Real quat[4];          // unit, w x y z
    Real quat_length;      // before it was normalised
    Vec3 scale;            // standard deviations, world units
    Vec3 r0, r1, r2;       // rows of R
    Vec3 t0, t1;           // rows of T = J W, px per world unit
    Vec3 m0, m1;           // rows of M = T R S, px
    Real xx, xy, yy;       // Sigma', px^2
    Real det;              // of Sigma', px^4
    Real inv_var_u, inv_var_v, shear;
} Projection;

static inline Vec3 frame_rotation_row(const FrameRecord *frame, int row) {
    return vec3((Real)(frame->rotation[3 * row]), (Real)(frame->rotation[3 * row + 1]),
                (Real)(frame->rotation[3 * row + 2]));
}

// a (3,3) given by rows, times the vector v
static inline Vec3 rows_apply(Vec3 r0, Vec3 r1, Vec3 r2, Vec3 v) {
    return vec3(vec3_dot(r0, v), vec3_dot(r1, v), vec3_dot(r2, v));
}

// v^T a: the transposed matrix times v
static inline Vec3 rows_apply_transposed(Vec3 r0, Vec3 r1, Vec3 r2, Vec3 v) {
    return vec3_add(vec3_mix(r0, v.x, r1, v.y), vec3_scale(r2, v.z));
}

static inline void projection_rotation(Projection *p) {
    const Real w = p->quat[0], x = p->quat[1], y = p->quat[2], z = p->quat[3];
    p->r0 = vec3(1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y));
    p->r1 = vec3(2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x));
    p->r2 = vec3(2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y));
}

// Sigma' and its factors from T, R and S.
static inline void projection_covariance(Projection *p, float low_pass_px2) {
    p->m0 = vec3_mul(rows_apply_transposed(p->r0, p->r1, p->r2, p->t0), p->scale);
    p->m1 = vec3_mul(rows_apply_transposed(p->r0, p->r1, p->r2, p->t1), p->scale);
    const Real square0 = vec3_dot(p->m0, p->m0), square1 = vec3_dot(p->m1, p->m1);
    const Vec3 minors = vec3_cross(p->m0, p->m1);
    p->xx = square0 + low_pass_px2;
    p->xy = vec3_dot(p->m0, p->m1);
    p->yy = square1 + low_pass_px2;
    p->det = vec3_dot(minors, minors) + low_pass_px2 * (square0 + square1 + low_pass_px2);
    p->inv_var_u = p->yy / p->det;
    p->inv_var_v = 1.0f / p->yy;
    p->shear = -p->xy * p->inv_var_v;
}

// Their quaternions (w x y z), normalised; false where they have no direction.
static inline Int projection_quaternion(__global const float *quat, Projection *p) {
    Real *q = p->quat;
    for (int k = 0; k < 4; k++) q[k] = lanes_load(quat, k);
    p->quat_length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const Real inverse = 1.0f / p->quat_length;
    for (int k = 0; k < 4; k++) q[k] *= inverse;
    return p->quat_length > QUAT_LENGTH_MIN && isfinite(p->quat_length);
}

// mean: of the splats, world; log_scale, quat: where their numbers begin (lanes_at()). False for those that cannot be drawn: nearer
// than the near plane, a quaternion of length 0, a covariance that has no inverse or does not fit a float.
static inline Int projection_compute(const FrameRecord *frame, Vec3 mean, __global const float *log_scale,
                                     __global const float *quat, Projection *p) {
    const Vec3 w0 = frame_rotation_row(frame, 0), w1 = frame_rotation_row(frame, 1), w2 = frame_rotation_row(frame, 2);
    p->point = vec3_add(rows_apply(w0, w1, w2, mean), vec3_all(frame->translation));
    const Int in_front = p->point.z >= frame->near_depth;
    if (!ANY(in_front)) return in_front;
    const Int has_direction = projection_quaternion(quat, p);
    projection_rotation(p);
    const Vec3 log_of_scale = lanes_load3(log_scale, 0);
    p->scale = vec3(exp(log_of_scale.x), exp(log_of_scale.y), exp(log_of_scale.z));

    const Real inv_z = 1.0f / p->point.z;
    p->ratio_x = clamp(p->point.x * inv_z, (Real)(frame->ratio_low[0]), (Real)(frame->ratio_high[0]));
    p->ratio_y = clamp(p->point.y * inv_z, (Real)(frame->ratio_low[1]), (Real)(frame->ratio_high[1]));
    p->t0 = vec3_scale(vec3_sub(w0, vec3_scale(w2, p->ratio_x)), frame->focal[0] * inv_z);
    p->t1 = vec3_scale(vec3_sub(w1, vec3_scale(w2, p->ratio_y)), frame->focal[1] * inv_z);
    projection_covariance(p, frame->low_pass_px2);
    return in_front && has_direction && p->det > 0 && isfinite(p->det) && isfinite(p->inv_var_u) &&
           isfinite(p->inv_var_v) && isfinite(p->xx * p->yy);
}

#endif
