// project_backward.cl - from the records of a splat's tiles to the gradients of all its parameters: project_forward.cl backwards.
//
// First the records of the splat are summed, in the order in which they lie. They are sums of W = d loss / d ln alpha over pixels, in
// the coordinates u, v. With P = 1 / var_u, Q = 1 / var_v and q = Sigma'^-1 (dx, dy) = (P u, shear P u + Q v):
//     d loss / d mean2d = sum W q                  since d ln alpha / d mean2d = q
//     d loss / d M      = sum W q (q^T M)          since d ln alpha / d Sigma' = 1/2 q q^T and Sigma' = M M^T + low_pass I
//     d loss / d logit  = (1 - opacity) sum W
// q^T M = P u N + Q v M1 with N = M0 + shear M1. For a long, thin splat M0 and shear M1 nearly cancel, so N is computed without that
// difference: N = (low_pass M0 + M1 x (M0 x M1)) / Sigma'_yy. Then, with M = T V, T = J W, V = R S (projection.h):
//     d V = T^T d M,   d T = d M V^T,   d R = d V S, and R's quaternion through its normalisation
//     d log_scale_k = column k of d M . column k of M = sum W (q^T M)_k^2
//     d mean = W^T d p: through mean2d, through T (z, and x, y where the ratio is not clamped: the exact derivative of
//     the clamped expression), through the viewing direction of the colour, and through the depth when that is rendered.
// Derived from the forward formulas by the chain rule; Ye et al. 2024 (gsplat), appendix, gives the same steps.
//
//     model fields as in project_forward.cl; box, screen (N); offset (N), mask (P): where the records of splat i lie, and which exist
//     records (P): from blend_backward_*.cl
//     d_mean .. d_sh3: gradients, same shapes as the fields; every number is written (0 for splats out of view), but degrees
//         above frame.sh_degree are left alone
//     gradient_ndc, seen (N): density statistics, added to where has_statistics: |d mean2d| in units of half the picture, 1 when visible
//
// One work-item: one Gaussian. Local memory: none. Reference: reference_project_backward(). Test: tests/splat3d/test_opencl_gradients.c.
#include "shared.h"

#include "projection.h"
#include "sh_basis.h"

static PairGradient sum_records(TileBox tiles, uint slot, __global const ushort *mask,
                                __global const PairGradient *records) {
    PairGradient sum = {0, 0, 0, 0, 0, 0, 0, 0, 0};
    const int count = (tiles.x1 - tiles.x0) * (tiles.y1 - tiles.y0);
    for (int k = 0; k < count; k++, slot++) {
        if (!mask[slot]) continue; // the ellipse misses this tile of its box: there is no record
        const PairGradient record = records[slot];
        sum.w += record.w;
        sum.wu += record.wu, sum.wv += record.wv;
        sum.wuu += record.wuu, sum.wuv += record.wuv, sum.wvv += record.wvv;
        sum.r += record.r, sum.g += record.g, sum.b += record.b;
    }
    return sum;
}

// Gradient of one SH degree's coefficients, and what they add to the gradient of the direction: weight[k] = sh_k . d_colour.
static void sh_backward(int count, const float *basis, float3 d_colour, __global const float *sh, __global float *d_sh,
                        float *weight) {
    const bool is_dark = !any(d_colour != 0); // then the coefficients need not be fetched
    for (int k = 0; k < count; k++) {
        weight[k] = is_dark ? 0 : dot(vload3(k, sh), d_colour);
        vstore3(basis[k] * d_colour, k, d_sh);
    }
}

// Gradient of the unit quaternion (x y z w = w x y z) from that of the rotation's rows.
static float4 rotation_backward(float4 quat, float3 d0, float3 d1, float3 d2) {
    const float w = quat.x, x = quat.y, y = quat.z, z = quat.w;
    return 2 * (float4)(x * (d2.y - d1.z) + y * (d0.z - d2.x) + z * (d1.x - d0.y),
                        w * (d2.y - d1.z) + y * (d0.y + d1.x) + z * (d0.z + d2.x) - 2 * x * (d1.y + d2.z),
                        w * (d0.z - d2.x) + x * (d0.y + d1.x) + z * (d1.z + d2.y) - 2 * y * (d0.x + d2.z),
                        w * (d1.x - d0.y) + x * (d0.z + d2.x) + y * (d1.z + d2.y) - 2 * z * (d0.x + d1.y));
}

// Gradients of log-scale and quaternion, and of the mean in camera axes, from that of the mean on the screen and the sums of
// W (P u)^2, W P u Q v and W (Q v)^2.
static float3 covariance_backward(__private const FrameRecord *frame, const Projection *p, float2 d_mean_px, float uu,
                                  float uv, float vv, float3 *d_log_scale, float4 *d_quat) {
    const float3 n = (frame->low_pass_px2 * p->m0 + cross(p->m1, cross(p->m0, p->m1))) * p->inv_var_v;
    const float3 d_m0 = uu * n + uv * p->m1, d_v = uv * n + vv * p->m1;
    const float3 d_m1 = p->shear * d_m0 + d_v;
    *d_log_scale = d_m0 * n + d_v * p->m1;

    // d R_row = sum over T's rows of T[.][row] d M S
    const float3 e0 = d_m0 * p->scale, e1 = d_m1 * p->scale;
    const float4 d_unit = rotation_backward(p->quat, p->t0.x * e0 + p->t1.x * e1, p->t0.y * e0 + p->t1.y * e1,
                                            p->t0.z * e0 + p->t1.z * e1);
    *d_quat = (d_unit - p->quat * dot(p->quat, d_unit)) / p->quat_length;

    // T0 = fx / z (W0 - ratio_x W2), T1 alike. M is proportional to 1 / z as it is to the scales, hence the sum of their gradients.
    const float3 d_t0 = rows_apply(p->r0, p->r1, p->r2, e0), d_t1 = rows_apply(p->r0, p->r1, p->r2, e1);
    const float inv_z = 1.0f / p->point.z;
    const float2 focal = (float2)(frame->focal[0], frame->focal[1]);
    const float3 w2 = frame_rotation_row(frame, 2);
    const float2 ratio = p->point.xy * inv_z;
    const float2 d_ratio_of_j = -inv_z * focal * (float2)(dot(d_t0, w2), dot(d_t1, w2));
    const float2 d_xy = inv_z * (focal * d_mean_px + select((float2)(0), d_ratio_of_j, ratio == p->ratio));
    return (float3)(d_xy, -dot(d_xy, ratio) - inv_z * dot(*d_log_scale, (float3)(1)));
}

// What one splat's sums say about its parameters; all zero for a splat out of view.
typedef struct {
    float3 d_mean; // without the part through the colour
    float3 d_log_scale;
    float4 d_quat;
    float d_logit;
    float3 d_colour;  // where the colour was not clamped at 0
    float d_mean_ndc; // |d mean2d|, x in units of half the width, y of half the height
} Gradient;

static Gradient splat_backward(__private const FrameRecord *frame, PairGradient sum, ScreenSplat splat, float logit,
                               const Projection *p) {
    const float a = p->inv_var_u, b = p->inv_var_v; // P, Q
    const float2 d_mean_px = (float2)(a * sum.wu, p->shear * a * sum.wu + b * sum.wv);
    Gradient gradient;
    float3 d_point = covariance_backward(frame, p, d_mean_px, a * a * sum.wuu, a * b * sum.wuv, b * b * sum.wvv,
                                         &gradient.d_log_scale, &gradient.d_quat);
    gradient.d_colour = (float3)(0);
    if (frame->is_depth)
        d_point.z += sum.r;
    else
        gradient.d_colour = (float3)(splat.r > 0 ? sum.r : 0, splat.g > 0 ? sum.g : 0, splat.b > 0 ? sum.b : 0);
    gradient.d_mean = rows_apply_transposed(frame_rotation_row(frame, 0), frame_rotation_row(frame, 1),
                                            frame_rotation_row(frame, 2), d_point);
    gradient.d_logit = sum.w / (1.0f + exp(logit));
    const float2 d_ndc = d_mean_px * (float2)(0.5f * frame->width, 0.5f * frame->height);
    gradient.d_mean_ndc = sqrt(dot(d_ndc, d_ndc));
    return gradient;
}

__kernel void project_backward(const FrameRecord frame, __global const float *mean, __global const float *log_scale,
                               __global const float *quat, __global const float *opacity_logit,
                               __global const float *sh1, __global const float *sh2, __global const float *sh3,
                               __global const ScreenSplat *screen, __global const TileBox *box,
                               __global const uint *offset, __global const ushort *mask,
                               __global const PairGradient *records, __global float *d_mean,
                               __global float *d_log_scale, __global float *d_quat, __global float *d_opacity_logit,
                               __global float *d_sh0, __global float *d_sh1, __global float *d_sh2,
                               __global float *d_sh3, const int has_statistics, __global float *gradient_ndc,
                               __global int *seen) {
    const int i = (int)get_global_id(0);
    if (i >= frame.splat_count) return;
    const TileBox tiles = box[i];
    const float3 mean_world = vload3(i, mean);
    Projection p;
    Gradient gradient = {(float3)(0), (float3)(0), (float4)(0), 0, (float3)(0), 0};
    float3 direction = (float3)(0);
    float inv_distance = 0;
    if (tiles.x0 < tiles.x1 && projection_compute(&frame, mean_world, vload3(i, log_scale), vload4(i, quat), &p)) {
        const PairGradient sum = sum_records(tiles, offset[i], mask, records);
        gradient = splat_backward(&frame, sum, screen[i], opacity_logit[i], &p);
        if (has_statistics) {
            gradient_ndc[i] += gradient.d_mean_ndc;
            seen[i] += 1;
        }
        const float3 offset_world = mean_world - (float3)(frame.position[0], frame.position[1], frame.position[2]);
        inv_distance = rsqrt(dot(offset_world, offset_world));
        direction = offset_world * inv_distance;
    }

    float3 d_direction = (float3)(0);
    float basis[7], weight[7];
    vstore3(SH_C0 * gradient.d_colour, i, d_sh0);
    if (frame.sh_degree >= 1) {
        sh_basis1(direction, basis);
        sh_backward(3, basis, gradient.d_colour, sh1 + 9 * i, d_sh1 + 9 * i, weight);
        d_direction += sh_slope1(weight);
    }
    if (frame.sh_degree >= 2) {
        sh_basis2(direction, basis);
        sh_backward(5, basis, gradient.d_colour, sh2 + 15 * i, d_sh2 + 15 * i, weight);
        d_direction += sh_slope2(direction, weight);
    }
    if (frame.sh_degree >= 3) {
        sh_basis3(direction, basis);
        sh_backward(7, basis, gradient.d_colour, sh3 + 21 * i, d_sh3 + 21 * i, weight);
        d_direction += sh_slope3(direction, weight);
    }
    const float3 d_through_colour = (d_direction - direction * dot(direction, d_direction)) * inv_distance;
    vstore3(gradient.d_mean + d_through_colour, i, d_mean);
    vstore3(gradient.d_log_scale, i, d_log_scale);
    vstore4(gradient.d_quat, i, d_quat);
    d_opacity_logit[i] = gradient.d_logit;
}
