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
// With -D ADAM_STEP (and LANES 16) the kernel is project_backward_step: the gradients of a group go through Adam (adam.cl) at once: the
// same numbers as project_backward and adam one after the other, but 236 bytes a splat are neither written nor read. With only_in_view,
// groups of which the frame shows nothing are left alone, and in others the splats out of view.
//     m_*, v_*: Adam's moments, shapes as the fields; not_finite (1): as in adam.cl
//
// One work-item: LANES Gaussians (splat_lanes.h): one on a GPU, sixteen on a CPU. Local memory: none.
// Reference: reference_project_backward(). Tests: tests/splat3d/test_opencl_gradients.c, test_opencl_step.c.
#include "shared.h"

#include "in_view.h"
#include "projection.h"
#include "sh_basis.h"
#include "sh_field.h"

#ifdef ADAM_STEP
#include "adam_lanes.h"
#endif

// The sums of a PairGradient.
typedef struct {
    Real w, wu, wv, wuu, wuv, wvv, r, g, b;
} Sums;

#if LANES == 1

static Int is_in_view(int i, int end, __global const TileBox *box) { return box[i].x0 < box[i].x1; }

static Sums sum_records(int i, int end, __global const TileBox *box, __global const uint *offset,
                        __global const ushort *mask, __global const PairGradient *records) {
    Sums sum = {0, 0, 0, 0, 0, 0, 0, 0, 0};
    const TileBox tiles = box[i];
    const int count = (tiles.x1 - tiles.x0) * (tiles.y1 - tiles.y0);
    uint slot = offset[i];
    for (int k = 0; k < count; k++, slot++) {
        if (!mask[slot]) continue; // the ellipse misses this tile of its box, or is hidden there: no record
        const PairGradient record = records[slot];
        sum.w += record.w;
        sum.wu += record.wu, sum.wv += record.wv;
        sum.wuu += record.wuu, sum.wuv += record.wuv, sum.wvv += record.wvv;
        sum.r += record.r, sum.g += record.g, sum.b += record.b;
    }
    return sum;
}

static void add_statistics(int i, int end, Int visible, Real d_mean_ndc, __global float *gradient_ndc,
                           __global int *seen) {
    if (!visible) return;
    gradient_ndc[i] += d_mean_ndc;
    seen[i] += 1;
}

#else

static Int is_in_view(int first, int end, __global const TileBox *box) { return splats_in_view(first, end, box); }

// One splat's records, added up as vectors of their first eight numbers and the ninth.
static float16 sum_splat(TileBox tiles, uint slot, __global const ushort *mask, __global const PairGradient *records) {
    float8 sum = (float8)(0.0f);
    float last = 0;
    const int count = (tiles.x1 - tiles.x0) * (tiles.y1 - tiles.y0);
    for (int k = 0; k < count; k++, slot++) {
        if (!mask[slot]) continue; // the ellipse misses this tile of its box, or is hidden there: no record
        sum += vload8(0, (__global const float *)(records + slot));
        last += records[slot].b;
    }
    return (float16)(sum, last, 0, 0, 0, 0, 0, 0, 0);
}

static Sums sum_records(int first, int end, __global const TileBox *box, __global const uint *offset,
                        __global const ushort *mask, __global const PairGradient *records) {
    float16 rows[LANES];
    for (int lane = 0; lane < LANES; lane++) {
        const int i = first + lane;
        rows[lane] = i < end ? sum_splat(box[i], offset[i], mask, records) : (float16)(0.0f);
    }
    transpose16(rows);
    const Sums sums = {rows[0], rows[1], rows[2], rows[3], rows[4], rows[5], rows[6], rows[7], rows[8]};
    return sums;
}

static void add_statistics(int first, int end, Int visible, Real d_mean_ndc, __global float *gradient_ndc,
                           __global int *seen) {
    float norm[LANES];
    int is_visible[LANES];
    vstore16(d_mean_ndc, 0, norm);
    vstore16(visible, 0, is_visible);
    for (int lane = 0; lane < LANES; lane++) {
        if (!is_visible[lane]) continue;
        gradient_ndc[first + lane] += norm[lane];
        seen[first + lane] += 1;
    }
}

#endif

// Gradient of the unit quaternion (w x y z) from that of the rotation's rows.
static void rotation_backward(const Real *quat, Vec3 d0, Vec3 d1, Vec3 d2, Real *d_quat) {
    const Real w = quat[0], x = quat[1], y = quat[2], z = quat[3];
    d_quat[0] = 2 * (x * (d2.y - d1.z) + y * (d0.z - d2.x) + z * (d1.x - d0.y));
    d_quat[1] = 2 * (w * (d2.y - d1.z) + y * (d0.y + d1.x) + z * (d0.z + d2.x) - 2 * x * (d1.y + d2.z));
    d_quat[2] = 2 * (w * (d0.z - d2.x) + x * (d0.y + d1.x) + z * (d1.z + d2.y) - 2 * y * (d0.x + d2.z));
    d_quat[3] = 2 * (w * (d1.x - d0.y) + x * (d0.z + d2.x) + y * (d1.z + d2.y) - 2 * z * (d0.x + d1.y));
}

// What the splats' sums say about their parameters.
typedef struct {
    Vec3 d_mean; // without the part through the colour
    Vec3 d_log_scale;
    Real d_quat[4];
    Real d_logit;
    Vec3 d_colour;   // where the colour was not clamped at 0
    Real d_mean_ndc; // |d mean2d|, x in units of half the width, y of half the height
} Gradient;

// From d of the unit quaternion to that of the parameter.
static void normalisation_backward(const Projection *p, const Real *d_unit, Real *d_quat) {
    Real along = (Real)(0.0f);
    for (int k = 0; k < 4; k++) along += p->quat[k] * d_unit[k];
    const Real inverse = 1.0f / p->quat_length;
    for (int k = 0; k < 4; k++) d_quat[k] = (d_unit[k] - p->quat[k] * along) * inverse;
}

// Gradients of log-scale and quaternion, and of the mean in camera axes, from that of the mean on the screen and the sums of
// W (P u)^2, W P u Q v and W (Q v)^2.
static Vec3 covariance_backward(const FrameRecord *frame, const Projection *p, Real d_x_px, Real d_y_px, Real uu,
                                Real uv, Real vv, Gradient *gradient) {
    const Vec3 n = vec3_scale(
        vec3_add(vec3_scale(p->m0, (Real)(frame->low_pass_px2)), vec3_cross(p->m1, vec3_cross(p->m0, p->m1))),
        p->inv_var_v);
    const Vec3 d_m0 = vec3_mix(n, uu, p->m1, uv), d_v = vec3_mix(n, uv, p->m1, vv);
    const Vec3 d_m1 = vec3_add(vec3_scale(d_m0, p->shear), d_v);
    gradient->d_log_scale = vec3_add(vec3_mul(d_m0, n), vec3_mul(d_v, p->m1));

    // d R_row = sum over T's rows of T[.][row] d M S
    const Vec3 e0 = vec3_mul(d_m0, p->scale), e1 = vec3_mul(d_m1, p->scale);
    Real d_unit[4];
    rotation_backward(p->quat, vec3_mix(e0, p->t0.x, e1, p->t1.x), vec3_mix(e0, p->t0.y, e1, p->t1.y),
                      vec3_mix(e0, p->t0.z, e1, p->t1.z), d_unit);
    normalisation_backward(p, d_unit, gradient->d_quat);

    // T0 = fx / z (W0 - ratio_x W2), T1 alike. M is proportional to 1 / z as it is to the scales, hence the sum of their gradients.
    const Vec3 d_t0 = rows_apply(p->r0, p->r1, p->r2, e0), d_t1 = rows_apply(p->r0, p->r1, p->r2, e1);
    const Real inv_z = 1.0f / p->point.z, ratio_x = p->point.x * inv_z, ratio_y = p->point.y * inv_z;
    const Real x_scale = frame->focal[0] * inv_z, y_scale = frame->focal[1] * inv_z, zero = (Real)(0.0f);
    const Vec3 w2 = frame_rotation_row(frame, 2);
    const Real of_j_x = select(zero, -inv_z * vec3_dot(d_t0, w2), ratio_x == p->ratio_x);
    const Real of_j_y = select(zero, -inv_z * vec3_dot(d_t1, w2), ratio_y == p->ratio_y);
    const Real d_x = x_scale * (d_x_px + of_j_x), d_y = y_scale * (d_y_px + of_j_y);
    const Vec3 d_scale = gradient->d_log_scale;
    return vec3(d_x, d_y, -(d_x * ratio_x + d_y * ratio_y) - inv_z * (d_scale.x + d_scale.y + d_scale.z));
}

static Gradient splat_backward(const FrameRecord *frame, const Sums *sum, Vec3 colour, Real logit,
                               const Projection *p) {
    const Real a = p->inv_var_u, b = p->inv_var_v, zero = (Real)(0.0f); // P, Q
    const Real d_x_px = a * sum->wu, d_y_px = p->shear * a * sum->wu + b * sum->wv;
    Gradient gradient;
    Vec3 d_point =
        covariance_backward(frame, p, d_x_px, d_y_px, a * a * sum->wuu, a * b * sum->wuv, b * b * sum->wvv, &gradient);
    gradient.d_colour = vec3(zero, zero, zero);
    if (frame->is_depth)
        d_point.z += sum->r;
    else
        gradient.d_colour = vec3(select(zero, sum->r, colour.x > 0), select(zero, sum->g, colour.y > 0),
                                 select(zero, sum->b, colour.z > 0));
    gradient.d_mean = rows_apply_transposed(frame_rotation_row(frame, 0), frame_rotation_row(frame, 1),
                                            frame_rotation_row(frame, 2), d_point);
    gradient.d_logit = sum->w / (1.0f + exp(logit));
    const Real ndc_x = d_x_px * (0.5f * frame->width), ndc_y = d_y_px * (0.5f * frame->height);
    gradient.d_mean_ndc = sqrt(ndc_x * ndc_x + ndc_y * ndc_y);
    return gradient;
}

static Vec3 vec3_where(Int condition, Vec3 v) {
    const Real zero = (Real)(0.0f);
    return vec3(select(zero, v.x, condition), select(zero, v.y, condition), select(zero, v.z, condition));
}

// Zero for the splats that are not visible, whatever came out for them.
static void keep_visible(Int visible, Gradient *gradient) {
    gradient->d_mean = vec3_where(visible, gradient->d_mean);
    gradient->d_log_scale = vec3_where(visible, gradient->d_log_scale);
    for (int k = 0; k < 4; k++) gradient->d_quat[k] = select((Real)(0.0f), gradient->d_quat[k], visible);
    gradient->d_logit = select((Real)(0.0f), gradient->d_logit, visible);
    gradient->d_colour = vec3_where(visible, gradient->d_colour);
}

// Colours of splats on the screen.
static Vec3 load_colours(int first, __global const ScreenSplat *screen) {
#if LANES == 1
    return vec3(screen[first].r, screen[first].g, screen[first].b);
#else
    float r[LANES], g[LANES], b[LANES];
    for (int lane = 0; lane < LANES; lane++) {
        r[lane] = screen[first + lane].r;
        g[lane] = screen[first + lane].g;
        b[lane] = screen[first + lane].b;
    }
    return vec3(vload16(0, r), vload16(0, g), vload16(0, b));
#endif
}

typedef struct {
    __global const float *mean, *log_scale, *quat, *opacity_logit, *sh1, *sh2, *sh3;
} Model;

// What the forward pass and the blend left of the splats.
typedef struct {
    __global const ScreenSplat *screen;
    __global const TileBox *box;
    __global const uint *offset;
    __global const ushort *mask;
    __global const PairGradient *records;
} Drawn;

typedef struct {
    int is_kept;
    __global float *gradient_ndc;
    __global int *seen;
} Statistics;

// Of all parameters of the splats at hand.
typedef struct {
    Real mean[3], log_scale[3], quat[4], opacity_logit, sh0[3], sh1[9], sh2[15], sh3[21];
} ModelGradient;

// Gradients of the coefficients of the colours, and of the means through the directions from which they are seen.
static Vec3 colour_backward(const FrameRecord *frame, int first, Model model, Vec3 direction, Real inv_distance,
                            Vec3 d_colour, ModelGradient *out) {
    const int degree = frame->sh_degree;
    const bool is_dark = !ANY(d_colour.x != 0 || d_colour.y != 0 || d_colour.z != 0);
    Real basis[SH_BASIS], weight[SH_BASIS];
    out->sh0[0] = SH_C0 * d_colour.x, out->sh0[1] = SH_C0 * d_colour.y, out->sh0[2] = SH_C0 * d_colour.z;
    sh_basis(degree, direction, basis);
    if (degree >= 1) sh_backward(3, basis, d_colour, is_dark, model.sh1 + lanes_at(first, 9), out->sh1, weight);
    if (degree >= 2)
        sh_backward(5, basis + 3, d_colour, is_dark, model.sh2 + lanes_at(first, 15), out->sh2, weight + 3);
    if (degree >= 3)
        sh_backward(7, basis + 8, d_colour, is_dark, model.sh3 + lanes_at(first, 21), out->sh3, weight + 8);
    const Vec3 d_direction = sh_slope(degree, direction, weight);
    const Vec3 across = vec3_sub(d_direction, vec3_scale(direction, vec3_dot(direction, d_direction)));
    return vec3_scale(across, inv_distance);
}

// All gradients of the splats from `first` on.
static void splats_backward(const FrameRecord *frame, int first, Model model, Drawn drawn, Statistics statistics,
                            ModelGradient *out) {
    const int end = frame->splat_count;
    const Real zero = (Real)(0.0f);
    const Vec3 mean_world = lanes_load3(model.mean + lanes_at(first, 3), 0), nothing = vec3(zero, zero, zero);
    Projection p;
    Gradient gradient = {nothing, nothing, {zero, zero, zero, zero}, zero, nothing, zero};
    Vec3 direction = nothing;
    Real inv_distance = zero;
    Int visible = is_in_view(first, end, drawn.box);
    if (ANY(visible)) {
        const Int can_be_drawn = projection_compute(frame, mean_world, model.log_scale + lanes_at(first, 3),
                                                    model.quat + lanes_at(first, 4), &p);
        visible = visible && can_be_drawn; // the same again as in the forward pass
        const Sums sums = sum_records(first, end, drawn.box, drawn.offset, drawn.mask, drawn.records);
        gradient = splat_backward(frame, &sums, load_colours(first, drawn.screen),
                                  lanes_load(model.opacity_logit + first, 0), &p);
        keep_visible(visible, &gradient);
        if (statistics.is_kept)
            add_statistics(first, end, visible, gradient.d_mean_ndc, statistics.gradient_ndc, statistics.seen);
        const Vec3 offset_world = vec3_sub(mean_world, vec3_all(frame->position));
        inv_distance = select(zero, 1.0f / sqrt(vec3_dot(offset_world, offset_world)), visible);
        direction = vec3_where(visible, vec3_scale(offset_world, inv_distance));
    }
    const Vec3 through_colour = colour_backward(frame, first, model, direction, inv_distance, gradient.d_colour, out);
    out->mean[0] = gradient.d_mean.x + through_colour.x;
    out->mean[1] = gradient.d_mean.y + through_colour.y;
    out->mean[2] = gradient.d_mean.z + through_colour.z;
    out->log_scale[0] = gradient.d_log_scale.x;
    out->log_scale[1] = gradient.d_log_scale.y;
    out->log_scale[2] = gradient.d_log_scale.z;
    for (int k = 0; k < 4; k++) out->quat[k] = gradient.d_quat[k];
    out->opacity_logit = gradient.d_logit;
}

#ifndef ADAM_STEP

static inline void store_gradient(int width, const Real *d, int first, __global float *field) {
#pragma unroll
    for (int k = 0; k < width; k++) lanes_store(d[k], field + lanes_at(first, width), k);
}

__kernel void project_backward(const FrameRecord frame, __global const float *mean, __global const float *log_scale,
                               __global const float *quat, __global const float *opacity_logit,
                               __global const float *sh1, __global const float *sh2, __global const float *sh3,
                               __global const ScreenSplat *screen, __global const TileBox *box,
                               __global const uint *offset, __global const ushort *mask,
                               __global const PairGradient *records, const int has_statistics,
                               __global float *gradient_ndc, __global int *seen, __global float *d_mean,
                               __global float *d_log_scale, __global float *d_quat, __global float *d_opacity_logit,
                               __global float *d_sh0, __global float *d_sh1, __global float *d_sh2,
                               __global float *d_sh3) {
    const int first = (int)get_global_id(0) * LANES;
    if (first >= frame.splat_count) return;
    const Model model = {mean, log_scale, quat, opacity_logit, sh1, sh2, sh3};
    const Drawn drawn = {screen, box, offset, mask, records};
    const Statistics statistics = {has_statistics, gradient_ndc, seen};
    ModelGradient d;
    splats_backward(&frame, first, model, drawn, statistics, &d);
    store_gradient(3, d.mean, first, d_mean);
    store_gradient(3, d.log_scale, first, d_log_scale);
    store_gradient(4, d.quat, first, d_quat);
    store_gradient(1, &d.opacity_logit, first, d_opacity_logit);
    store_gradient(3, d.sh0, first, d_sh0);
    if (frame.sh_degree >= 1) store_gradient(9, d.sh1, first, d_sh1);
    if (frame.sh_degree >= 2) store_gradient(15, d.sh2, first, d_sh2);
    if (frame.sh_degree >= 3) store_gradient(21, d.sh3, first, d_sh3);
}

#else

__kernel void project_backward_step(
    const FrameRecord frame, __global float *mean, __global float *log_scale, __global float *quat,
    __global float *opacity_logit, __global float *sh1, __global float *sh2, __global float *sh3,
    __global const ScreenSplat *screen, __global const TileBox *box, __global const uint *offset,
    __global const ushort *mask, __global const PairGradient *records, const int has_statistics,
    __global float *gradient_ndc, __global int *seen, const AdamStepRecord adam, __global float *sh0,
    __global float *m_mean, __global float *m_log_scale, __global float *m_quat, __global float *m_opacity_logit,
    __global float *m_sh0, __global float *m_sh1, __global float *m_sh2, __global float *m_sh3, __global float *v_mean,
    __global float *v_log_scale, __global float *v_quat, __global float *v_opacity_logit, __global float *v_sh0,
    __global float *v_sh1, __global float *v_sh2, __global float *v_sh3, __global volatile uint *not_finite) {
    const int first = (int)get_global_id(0) * LANES;
    if (first >= frame.splat_count) return;
    const Int stepped = stepped_splats(adam.rule.only_in_view, first, frame.splat_count, box);
    if (!any_of(stepped)) return;
    const Model model = {mean, log_scale, quat, opacity_logit, sh1, sh2, sh3};
    const Drawn drawn = {screen, box, offset, mask, records};
    const Statistics statistics = {has_statistics, gradient_ndc, seen};
    ModelGradient d;
    splats_backward(&frame, first, model, drawn, statistics, &d);

    const AdamGroup group = {&adam, first, frame.splat_count, stepped, not_finite};
    adam_group_step(group, ADAM_MEAN, 3, d.mean, mean, m_mean, v_mean);
    adam_group_step(group, ADAM_LOG_SCALE, 3, d.log_scale, log_scale, m_log_scale, v_log_scale);
    adam_group_step(group, ADAM_QUAT, 4, d.quat, quat, m_quat, v_quat);
    normalize_group(quat + 4 * first, stepped);
    adam_group_step(group, ADAM_OPACITY_LOGIT, 1, &d.opacity_logit, opacity_logit, m_opacity_logit, v_opacity_logit);
    adam_group_step(group, ADAM_SH0, 3, d.sh0, sh0, m_sh0, v_sh0);
    if (frame.sh_degree >= 1) adam_group_step(group, ADAM_SH1, 9, d.sh1, sh1, m_sh1, v_sh1);
    if (frame.sh_degree >= 2) adam_group_step(group, ADAM_SH2, 15, d.sh2, sh2, m_sh2, v_sh2);
    if (frame.sh_degree >= 3) adam_group_step(group, ADAM_SH3, 21, d.sh3, sh3, m_sh3, v_sh3);
}

#endif
