// adam_lanes.h - Adam on sixteen numbers (OpenCL C): the formula of adam.cl, for the kernels that do a step.
#ifndef SPLATLAB_KERNELS_ADAM_LANES_H
#define SPLATLAB_KERNELS_ADAM_LANES_H

#include "adam_record.h"
#include "conditions.h"
#include "in_view.h"

// first: place in the field of the sixteen numbers, each of another splat (SPLAT_GROUP in shared.h). Behind the last splat they are
// nobody's.
static void note_not_finite(const AdamRecord *a, int first, int16 finite, __global volatile uint *not_finite) {
    int lanes[ADAM_LANES];
    vstore16(finite, 0, lanes);
    const int splat = first / (ADAM_LANES * a->width) * ADAM_LANES;
    for (int i = 0; i < ADAM_LANES && splat + i < a->splats; i++)
        if (!lanes[i]) atomic_min(not_finite, (uint)(splat + i) << ADAM_FIELD_BITS | (uint)a->field);
}

// Which of sixteen splats are stepped (-1); places behind the last splat may be too.
static int16 stepped_splats(int only_in_view, int first, int splats, __global const TileBox *box) {
    return only_in_view ? splats_in_view(first, splats, box) : (int16)(-1);
}

// Returns which of the numbers are finite (-1); those of them that are to be stepped were changed.
static int16 adam_step16(const AdamRecord *a, float16 g, int16 stepped, float16 *x, float16 *m, float16 *v) {
#pragma OPENCL FP_CONTRACT OFF
    const float16 new_m = fma((float16)(a->beta1), *m, a->one_minus_beta1 * g);
    const float16 new_v = fma((float16)(a->beta2), *v, a->one_minus_beta2 * g * g);
    const float16 size = fma(sqrt(new_v), (float16)(a->over_root_v_part), (float16)(a->epsilon));
    const float16 new_x = fma((float16)(-a->rate), new_m / size, *x);
    const int16 finite = isfinite(new_x) && isfinite(new_v); // g and m' cannot be otherwise unless one of these is too
    const int16 changed = finite && stepped;
    *x = select(*x, new_x, changed);
    *m = select(*m, new_m, changed);
    *v = select(*v, new_v, changed);
    return finite;
}

// One vector of a field, where it lies; first: its place in the field.
static void adam_vector(const AdamRecord *a, float16 g, int first, int16 stepped, __global float *value,
                        __global float *m, __global float *v, __global volatile uint *not_finite) {
    __global float16 *value_at = (__global float16 *)(value + first);
    __global float16 *m_at = (__global float16 *)(m + first), *v_at = (__global float16 *)(v + first);
    float16 new_value = *value_at, new_m = *m_at, new_v = *v_at;
    const int16 finite = adam_step16(a, g, stepped, &new_value, &new_m, &new_v);
    *value_at = new_value, *m_at = new_m, *v_at = new_v;
    if (!all_of(finite)) note_not_finite(a, first, finite, not_finite);
}

// Sixteen splats, whose gradients a work-item has at hand.
typedef struct {
    const AdamStepRecord *step;
    int first, splats; // the group's first splat; N
    int16 stepped;     // which of them are to be stepped
    __global volatile uint *not_finite;
} AdamGroup;

// One field of the group. gradient: one vector for each of a splat's numbers; value, m, v (N x width): the field.
static void adam_group_step(AdamGroup group, int field, int width, const float16 *gradient, __global float *value,
                            __global float *m, __global float *v) {
    AdamRecord a = group.step->rule;
    a.rate = group.step->rate[field];
    a.field = field, a.width = width, a.splats = group.splats;
    for (int k = 0; k < width; k++)
        adam_vector(&a, gradient[k], group.first * width + ADAM_LANES * k, group.stepped, value, m, v,
                    group.not_finite);
}

// The quaternions of a group that were stepped: divided by their length; zero stays zero.
static void normalize_group(__global float *quat, int16 stepped) {
    float16 q[4];
    for (int k = 0; k < 4; k++) q[k] = vload16(k, quat);
    const float16 squared = fma(q[0], q[0], fma(q[1], q[1], fma(q[2], q[2], q[3] * q[3])));
    const float16 length = sqrt(squared);
    const int16 has_length = squared > 0.0f && isfinite(squared) && stepped;
    for (int k = 0; k < 4; k++) vstore16(select(q[k], q[k] / length, has_length), k, quat);
}

#endif
