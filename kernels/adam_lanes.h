// adam_lanes.h - Adam on sixteen numbers (OpenCL C): the formula of adam.cl, for the kernels that do a step.
#ifndef SPLATLAB_KERNELS_ADAM_LANES_H
#define SPLATLAB_KERNELS_ADAM_LANES_H

#include "adam_record.h"
#include "conditions.h"

// first: of the sixteen, in the field. What lies behind the field's end is nobody's.
static void note_not_finite(const AdamRecord *a, int first, int16 finite, __global volatile uint *not_finite) {
    int lanes[ADAM_LANES];
    vstore16(finite, 0, lanes);
    for (int i = 0; i < ADAM_LANES && first + i < a->count; i++)
        if (!lanes[i]) atomic_min(not_finite, (uint)((first + i) / a->width) << ADAM_FIELD_BITS | (uint)a->field);
}

// Returns which of the numbers are finite (-1) and were changed.
static int16 adam_step16(const AdamRecord *a, float16 g, float16 *x, float16 *m, float16 *v) {
#pragma OPENCL FP_CONTRACT OFF
    const float16 new_m = fma((float16)(a->beta1), *m, a->one_minus_beta1 * g);
    const float16 new_v = fma((float16)(a->beta2), *v, a->one_minus_beta2 * g * g);
    const float16 size = fma(sqrt(new_v), (float16)(a->over_root_v_part), (float16)(a->epsilon));
    const float16 new_x = fma((float16)(-a->rate), new_m / size, *x);
    const int16 finite = isfinite(new_x) && isfinite(new_v); // g and m' cannot be otherwise unless one of these is too
    *x = select(*x, new_x, finite);
    *m = select(*m, new_m, finite);
    *v = select(*v, new_v, finite);
    return finite;
}

// Sixteen splats, whose gradients a work-item has at hand.
typedef struct {
    const AdamStepRecord *step;
    int first, splat_count; // the group's first splat; N
    __global volatile uint *not_finite;
} AdamGroup;

// One field of the group. gradient: sixteen times width numbers; value, m, v (N x width): the field.
static void adam_group_step(AdamGroup group, int field, int width, const float *gradient, __global float *value,
                            __global float *m, __global float *v) {
    AdamRecord a = group.step->rule;
    a.rate = group.step->rate[field];
    a.field = field, a.width = width, a.count = group.splat_count * width;
    for (int k = 0; k < width; k++) {
        const int first = group.first * width + ADAM_LANES * k;
        __global float16 *value_at = (__global float16 *)(value + first);
        __global float16 *m_at = (__global float16 *)(m + first), *v_at = (__global float16 *)(v + first);
        float16 new_value = *value_at, new_m = *m_at, new_v = *v_at;
        const int16 finite = adam_step16(&a, vload16(k, gradient), &new_value, &new_m, &new_v);
        *value_at = new_value, *m_at = new_m, *v_at = new_v;
        if (!all_of(finite)) note_not_finite(&a, first, finite, group.not_finite);
    }
}

// The quaternions of sixteen splats, four a vector: normalize_quaternions() of adam.cl.
static void normalize_group(__global float *quat) {
    for (int k = 0; k < 4; k++) {
        const float16 q = vload16(k, quat);
        const float16 w = q.s000044448888cccc, x = q.s111155559999dddd, y = q.s22226666aaaaeeee,
                      z = q.s33337777bbbbffff;
        const float16 squared = fma(w, w, fma(x, x, fma(y, y, z * z)));
        vstore16(select(q, q / sqrt(squared), squared > 0.0f && isfinite(squared)), k, quat);
    }
}

#endif
