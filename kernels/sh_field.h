// sh_field.h - the SH coefficients of degrees 1 to 3 of LANES splats: their sum in a direction, and its gradients (OpenCL C).
//
// Fields sh1 (N,3,3), sh2 (N,5,3), sh3 (N,7,3) hold r g b of one function after the other; pointers below are to the numbers of
// the splats at hand (lanes_at() in splat_lanes.h).
#ifndef SPLATLAB_KERNELS_SH_FIELD_H
#define SPLATLAB_KERNELS_SH_FIELD_H

#include "splat_lanes.h"

#define SH_BASIS (SH_COEFFICIENTS_MAX - 1) // functions of degrees 1 to 3

static inline void sh_add(int count, const Real *basis, __global const float *sh, Vec3 *sum) {
#pragma unroll
    for (int k = 0; k < count; k++) *sum = vec3_add(*sum, vec3_scale(lanes_load3(sh, 3 * k), basis[k]));
}

// sum over k of basis[k] sh[k].
static inline Vec3 sh_colour(int degree, const Real *basis, __global const float *sh1, __global const float *sh2,
                             __global const float *sh3) {
    Vec3 sum = vec3((Real)(0.0f), (Real)(0.0f), (Real)(0.0f));
    if (degree >= 1) sh_add(3, basis, sh1, &sum);
    if (degree >= 2) sh_add(5, basis + 3, sh2, &sum);
    if (degree >= 3) sh_add(7, basis + 8, sh3, &sum);
    return sum;
}

// d_sh[k] = basis[k] d_colour, and weight[k] = sh[k] . d_colour, which the gradient of the direction wants. is_dark: d_colour is 0.
static inline void sh_backward(int count, const Real *basis, Vec3 d_colour, bool is_dark, __global const float *sh,
                               Real *d_sh, Real *weight) {
#pragma unroll
    for (int k = 0; k < count; k++) {
        d_sh[3 * k] = basis[k] * d_colour.x;
        d_sh[3 * k + 1] = basis[k] * d_colour.y;
        d_sh[3 * k + 2] = basis[k] * d_colour.z;
        weight[k] =
            is_dark ? (Real)(0.0f) : vec3_dot(lanes_load3(sh, 3 * k), d_colour); // else they need not be fetched
    }
}

#endif
