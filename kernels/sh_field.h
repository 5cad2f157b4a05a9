// sh_field.h - the SH coefficients of degrees 1 to 3 of LANES splats: their sum in a direction, and its gradients (OpenCL C).
//
// Fields sh1 (N,3,3), sh2 (N,5,3), sh3 (N,7,3) hold r g b of one function after the other. Where a work-item has sixteen splats,
// turning 45 numbers of each into lanes would cost more than the sum itself. So the basis (15 numbers) is turned into one vector a
// splat instead, and spread over vectors that lie as the memory does:
//
//     basis of a splat           b0 b1 b2 ...
//     spread                     b0 b0 b0 b1 b1 b1 b2 b2 b2 ...
//     sh1 in memory              r  g  b  r  g  b  r  g  b  ...       products: colour of lane % 3
// Vectors begin at a multiple of three numbers, so this holds for all of them: 9, 15, and 15 + 6 numbers.
#ifndef SPLATLAB_KERNELS_SH_FIELD_H
#define SPLATLAB_KERNELS_SH_FIELD_H

#include "splat_lanes.h"

#define SH_BASIS (SH_COEFFICIENTS_MAX - 1) // functions of degrees 1 to 3

#if LANES == 1

static void sh_add(int count, const float *basis, __global const float *sh, Vec3 *sum) {
    for (int k = 0; k < count; k++) {
        const float3 c = vload3(k, sh);
        *sum = vec3_add(*sum, vec3_scale(vec3(c.x, c.y, c.z), basis[k]));
    }
}

// sum over k of basis[k] sh[k], for a splat that is shown.
static Vec3 sh_colour(int degree, const float *basis, int shown, int i, __global const float *sh1,
                      __global const float *sh2, __global const float *sh3) {
    Vec3 sum = vec3(0, 0, 0);
    if (degree >= 1) sh_add(3, basis, sh1 + 9 * i, &sum);
    if (degree >= 2) sh_add(5, basis + 3, sh2 + 15 * i, &sum);
    if (degree >= 3) sh_add(7, basis + 8, sh3 + 21 * i, &sum);
    return sum;
}

static void sh_backward(int count, const float *basis, Vec3 d_colour, bool is_dark, __global const float *sh,
                        OUT float *d_sh, float *weight) {
    for (int k = 0; k < count; k++) {
        weight[k] = 0;
        if (!is_dark) { // else the coefficients need not be fetched
            const float3 c = vload3(k, sh);
            weight[k] = vec3_dot(vec3(c.x, c.y, c.z), d_colour);
        }
        const Vec3 d = vec3_scale(d_colour, basis[k]);
        vstore3((float3)(d.x, d.y, d.z), k, d_sh);
    }
}

// d_sh[k] = basis[k] d_colour, and weight[k] = sh[k] . d_colour, which the gradient of the direction wants; weight[SH_BASIS].
// sh1 to d_sh3: of this splat.
static void sh_colour_backward(int degree, const float *basis, Vec3 d_colour, __global const float *sh1,
                               __global const float *sh2, __global const float *sh3, OUT float *d_sh1, OUT float *d_sh2,
                               OUT float *d_sh3, float *weight) {
    const bool is_dark = d_colour.x == 0 && d_colour.y == 0 && d_colour.z == 0;
    if (degree >= 1) sh_backward(3, basis, d_colour, is_dark, sh1, d_sh1, weight);
    if (degree >= 2) sh_backward(5, basis + 3, d_colour, is_dark, sh2, d_sh2, weight + 3);
    if (degree >= 3) sh_backward(7, basis + 8, d_colour, is_dark, sh3, d_sh3, weight + 8);
}

#else

// Functions of one vector of coefficients, each three times.
#define SPREAD_SH1(b)  ((float16)(b.s000, b.s111, b.s222, b.s333, b.s444, b.s5)) // 9 lanes of it are used
#define SPREAD_SH2(b)  ((float16)(b.s333, b.s444, b.s555, b.s666, b.s777, b.s8)) // 15
#define SPREAD_SH3A(b) ((float16)(b.s888, b.s999, b.saaa, b.sbbb, b.sccc, b.sd)) // 15
#define SPREAD_SH3B(b) ((float16)(b.sddd, b.seee, b.sfff, b.sfff, b.sfff, b.sf)) // 6

// The first `count` numbers of 16 that are read, the others 0.
static inline float16 sh_vector(__global const float *sh, int count) {
    return select((float16)(0.0f), vload16(0, sh), LANE_NUMBERS < (int16)(count));
}

static inline float16 sh_products(int degree, float16 b, size_t i, __global const float *sh1, __global const float *sh2,
                                  __global const float *sh3) {
    float16 sum = SPREAD_SH1(b) * sh_vector(sh1 + 9 * i, 9);
    if (degree >= 2) sum = fma(SPREAD_SH2(b), sh_vector(sh2 + 15 * i, 15), sum);
    if (degree >= 3) {
        sum = fma(SPREAD_SH3A(b), sh_vector(sh3 + 21 * i, 15), sum);
        sum = fma(SPREAD_SH3B(b), sh_vector(sh3 + 21 * i + 15, 6), sum);
    }
    return sum;
}

// sum over k of basis[k] sh[k], for the splats that are shown.
static Vec3 sh_colour(int degree, const float16 *basis, int16 shown, int first, __global const float *sh1,
                      __global const float *sh2, __global const float *sh3) {
    if (degree == 0) return vec3((float16)(0.0f), (float16)(0.0f), (float16)(0.0f));
    float16 rows[LANES];
    int is_shown[LANES];
    vstore16(shown, 0, is_shown);
    for (int k = 0; k < SH_BASIS; k++) rows[k] = basis[k];
    rows[SH_BASIS] = (float16)(0.0f);
    transpose16(rows);
    for (int lane = 0; lane < LANES; lane++)
        rows[lane] =
            is_shown[lane] ? sh_products(degree, rows[lane], (size_t)(first + lane), sh1, sh2, sh3) : (float16)(0.0f);
    transpose16(rows);
    return vec3(rows[0] + rows[3] + rows[6] + rows[9] + rows[12], rows[1] + rows[4] + rows[7] + rows[10] + rows[13],
                rows[2] + rows[5] + rows[8] + rows[11] + rows[14]);
}

// Sums of three neighbours each, in lanes 0 3 6 9 12.
static inline float16 triplet_sums(float16 v) {
    return v + (float16)(v.s1234, v.s5678, v.s9abc, v.sdef, v.sf) + (float16)(v.s2345, v.s6789, v.sabcd, v.sef, v.sff);
}

static inline void store_9(float16 v, OUT float *at) {
    vstore8(v.lo, 0, at);
    at[8] = v.s8;
}

static inline void store_15(float16 v, OUT float *at) {
    vstore8(v.lo, 0, at);
    vstore4(v.s89ab, 0, at + 8);
    vstore3(v.scde, 0, at + 12);
}

static inline void store_6(float16 v, OUT float *at) {
    vstore4(v.s0123, 0, at);
    vstore2(v.s45, 0, at + 4);
}

// One splat of the group: stores its gradients and returns the weights. b: its basis; d: its d_colour r g b r g b ...
static inline float16 sh_splat_backward(int degree, float16 b, float16 d, bool is_dark, int lane,
                                        __global const float *sh1, __global const float *sh2, __global const float *sh3,
                                        OUT float *d_sh1, OUT float *d_sh2, OUT float *d_sh3) {
    store_9(SPREAD_SH1(b) * d, d_sh1 + 9 * lane);
    if (degree >= 2) store_15(SPREAD_SH2(b) * d, d_sh2 + 15 * lane);
    if (degree >= 3) {
        store_15(SPREAD_SH3A(b) * d, d_sh3 + 21 * lane);
        store_6(SPREAD_SH3B(b) * d, d_sh3 + 21 * lane + 15);
    }
    if (is_dark) return (float16)(0.0f); // the coefficients need not be fetched
    const float16 zero = (float16)(0.0f);
    const float16 of1 = triplet_sums(d * sh_vector(sh1 + 9 * lane, 9));
    const float16 of2 = degree >= 2 ? triplet_sums(d * sh_vector(sh2 + 15 * lane, 15)) : zero;
    const float16 of3a = degree >= 3 ? triplet_sums(d * sh_vector(sh3 + 21 * lane, 15)) : zero;
    const float16 of3b = degree >= 3 ? triplet_sums(d * sh_vector(sh3 + 21 * lane + 15, 6)) : zero;
    return (float16)(of1.s036, of2.s0369, of2.sc, of3a.s0369, of3a.sc, of3b.s03, 0.0f);
}

// d_sh[k] = basis[k] d_colour, and weight[k] = sh[k] . d_colour, which the gradient of the direction wants; weight[SH_BASIS].
// sh1 to d_sh3: of the group's first splat.
static void sh_colour_backward(int degree, const float16 *basis, Vec3 d_colour, __global const float *sh1,
                               __global const float *sh2, __global const float *sh3, OUT float *d_sh1, OUT float *d_sh2,
                               OUT float *d_sh3, float16 *weight) {
    if (degree == 0) return;
    float16 rows[LANES];
    float red[LANES], green[LANES], blue[LANES];
    vstore16(d_colour.x, 0, red), vstore16(d_colour.y, 0, green), vstore16(d_colour.z, 0, blue);
    for (int k = 0; k < SH_BASIS; k++) rows[k] = basis[k];
    rows[SH_BASIS] = (float16)(0.0f);
    transpose16(rows);
    for (int lane = 0; lane < LANES; lane++) {
        const float r = red[lane], g = green[lane], b = blue[lane];
        rows[lane] = sh_splat_backward(degree, rows[lane], (float16)(r, g, b, r, g, b, r, g, b, r, g, b, r, g, b, r),
                                       r == 0 && g == 0 && b == 0, lane, sh1, sh2, sh3, d_sh1, d_sh2, d_sh3);
    }
    transpose16(rows);
    for (int k = 0; k < SH_BASIS; k++) weight[k] = rows[k];
}

#endif

#endif
