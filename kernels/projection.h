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

#define LOG2_E          1.44269504f
#define QUAT_LENGTH_MIN 1e-18f // a shorter quaternion has no direction: such a splat is not drawn

typedef struct {
    float3 point;      // mean in camera axes
    float2 ratio;      // x/z, y/z, clamped for J
    float4 quat;       // unit, x y z w = the quaternion's w x y z
    float quat_length; // before it was normalised
    float3 scale;      // standard deviations, world units
    float3 r0, r1, r2; // rows of R
    float3 t0, t1;     // rows of T = J W, px per world unit
    float3 m0, m1;     // rows of M = T R S, px
    float xx, xy, yy;  // Sigma', px^2
    float det;         // of Sigma', px^4
    float inv_var_u, inv_var_v, shear;
} Projection;

static inline float3 frame_rotation_row(__private const FrameRecord *frame, int row) {
    return (float3)(frame->rotation[3 * row], frame->rotation[3 * row + 1], frame->rotation[3 * row + 2]);
}

// a (3,3) given by rows, times the vector v
static inline float3 rows_apply(float3 r0, float3 r1, float3 r2, float3 v) {
    return (float3)(dot(r0, v), dot(r1, v), dot(r2, v));
}

// v^T a: the transposed matrix times v
static inline float3 rows_apply_transposed(float3 r0, float3 r1, float3 r2, float3 v) {
    return r0 * v.x + r1 * v.y + r2 * v.z;
}

static inline void projection_rotation(Projection *p) {
    const float w = p->quat.x, x = p->quat.y, y = p->quat.z, z = p->quat.w;
    p->r0 = (float3)(1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y));
    p->r1 = (float3)(2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x));
    p->r2 = (float3)(2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y));
}

// Sigma' and its factors from T, R and S.
static inline void projection_covariance(Projection *p, float low_pass_px2) {
    p->m0 = rows_apply_transposed(p->r0, p->r1, p->r2, p->t0) * p->scale;
    p->m1 = rows_apply_transposed(p->r0, p->r1, p->r2, p->t1) * p->scale;
    const float square0 = dot(p->m0, p->m0), square1 = dot(p->m1, p->m1);
    const float3 minors = cross(p->m0, p->m1);
    p->xx = square0 + low_pass_px2;
    p->xy = dot(p->m0, p->m1);
    p->yy = square1 + low_pass_px2;
    p->det = dot(minors, minors) + low_pass_px2 * (square0 + square1 + low_pass_px2);
    p->inv_var_u = p->yy / p->det;
    p->inv_var_v = 1.0f / p->yy;
    p->shear = -p->xy * p->inv_var_v;
}

// mean, log_scale (3 floats each) and quat (4 floats: w x y z) of the splat. False when it cannot be drawn: nearer than the near plane,
// a quaternion of length 0, a covariance that has no inverse or does not fit a float.
static inline bool projection_compute(__private const FrameRecord *frame, float3 mean, float3 log_scale, float4 quat,
                                      Projection *p) {
    const float3 w0 = frame_rotation_row(frame, 0), w1 = frame_rotation_row(frame, 1),
                 w2 = frame_rotation_row(frame, 2);
    const float3 translation = (float3)(frame->translation[0], frame->translation[1], frame->translation[2]);
    p->point = rows_apply(w0, w1, w2, mean) + translation;
    p->quat_length = sqrt(dot(quat, quat));
    if (!(p->point.z >= frame->near_depth)) return false;
    if (!(p->quat_length > QUAT_LENGTH_MIN && isfinite(p->quat_length))) return false;

    p->quat = quat / p->quat_length;
    projection_rotation(p);
    p->scale = exp(log_scale);

    const float inv_z = 1.0f / p->point.z;
    p->ratio = clamp(p->point.xy * inv_z, (float2)(frame->ratio_low[0], frame->ratio_low[1]),
                     (float2)(frame->ratio_high[0], frame->ratio_high[1]));
    p->t0 = (w0 - w2 * p->ratio.x) * (frame->focal[0] * inv_z);
    p->t1 = (w1 - w2 * p->ratio.y) * (frame->focal[1] * inv_z);
    projection_covariance(p, frame->low_pass_px2);
    return p->det > 0 && isfinite(p->det) && isfinite(p->inv_var_u) && isfinite(p->inv_var_v) &&
           isfinite(p->xx * p->yy);
}

#endif
