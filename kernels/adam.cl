// adam.cl - one step of Adam on one field of all splats (Kingma & Ba 2015, algorithm 1), and unit quaternions.
//
//     m <- beta1 m + (1 - beta1) g          v <- beta2 v + (1 - beta2) g^2
//     x <- x - rate (m / (1 - beta1^t)) / (sqrt(v / (1 - beta2^t)) + epsilon)
// in this order of roundings, each line one operation or one fma:
//     m' = fma(beta1, m, one_minus_beta1 * g)
//     v' = fma(beta2, v, (one_minus_beta2 * g) * g)
//     x' = fma(-rate, m' / fma(sqrt(v'), over_root_v_part, epsilon), x)
// with the bias corrections of t inside rate and over_root_v_part. Gradients of splats are tiny: g = 1e-15 still has a v' of
// 1e-33, well inside float; below 1e-19 v' vanishes, but there epsilon, 1e-15, has long taken its place.
//
// A number whose gradient, or whose new value or moment, is not finite stays as it is, with its moments, and the lowest such
// (splat, field) is noted; an integer minimum comes out the same in any order.
//
//     gradient, value, m, v (N x width): one field        not_finite (1): ADAM_ALL_FINITE, or splat << ADAM_FIELD_BITS | field
// One work-item: ADAM_LANES numbers; a whole vector, so that the rare case costs one test for sixteen numbers and compilers have
// nothing to guess. It runs at the speed of memory: 28 bytes a number. Local memory: none.
// Reference: splat2d/adam.c. Test: tests/splat3d/test_opencl_adam.c.
#include "adam_lanes.h"

#pragma OPENCL FP_CONTRACT OFF

// Up to sixteen numbers at the end of a field, those beyond it 0.
static float16 load_part(__global const float *p, int count) {
    float lanes[ADAM_LANES];
    for (int i = 0; i < ADAM_LANES; i++) lanes[i] = i < count ? p[i] : 0.0f;
    return vload16(0, lanes);
}

static void store_part(float16 value, __global float *p, int count) {
    float lanes[ADAM_LANES];
    vstore16(value, 0, lanes);
    for (int i = 0; i < count; i++) p[i] = lanes[i];
}

__kernel void adam(const AdamRecord a, __global const float *gradient, __global float *value, __global float *m,
                   __global float *v, __global volatile uint *not_finite) {
    const int first = (int)get_global_id(0) * ADAM_LANES;
    if (first >= a.count) return;
    const int left = a.count - first;
    int16 finite;
    float16 new_value, new_m, new_v;
    if (left >= ADAM_LANES) {
        __global float16 *value_at = (__global float16 *)(value + first);
        __global float16 *m_at = (__global float16 *)(m + first), *v_at = (__global float16 *)(v + first);
        new_value = *value_at, new_m = *m_at, new_v = *v_at;
        finite = adam_step16(&a, *(__global const float16 *)(gradient + first), &new_value, &new_m, &new_v);
        *value_at = new_value, *m_at = new_m, *v_at = new_v;
    } else {
        new_value = load_part(value + first, left), new_m = load_part(m + first, left);
        new_v = load_part(v + first, left);
        finite = adam_step16(&a, load_part(gradient + first, left), &new_value, &new_m, &new_v);
        store_part(new_value, value + first, left), store_part(new_m, m + first, left);
        store_part(new_v, v + first, left);
    }
    if (!all_of(finite)) note_not_finite(&a, first, finite, not_finite);
}

// quat (N, 4): divided by its length; zero stays zero. One work-item: one splat.
__kernel void normalize_quaternions(const int count, __global float *quat) {
    const int i = (int)get_global_id(0);
    if (i >= count) return;
    const float4 q = vload4(i, quat);
    const float squared = fma(q.x, q.x, fma(q.y, q.y, fma(q.z, q.z, q.w * q.w)));
    if (squared > 0.0f && isfinite(squared)) vstore4(q / sqrt(squared), i, quat);
}
