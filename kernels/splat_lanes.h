// splat_lanes.h - numbers of LANES splats at once: what lets one source be a CPU's kernel and a GPU's (OpenCL C).
//
// A GPU runs one splat in one work-item (LANES 1, the default): Real is float. A CPU's compiler does not vectorise such kernels
// over work-items, so there a work-item takes sixteen splats (-D LANES=16): Real is float16, one splat a lane, and branches become masks.
// The fields of a model lie so that either way whole vectors, or neighbouring work-items' numbers, are next to each other:
//
//     mean of splats 0..15      x0 x1 ... x15   y0 y1 ... y15   z0 z1 ... z15      then those of splats 16..31, ...
//
// Whole groups are read and written: buffers have room for the last one (splat3d/device_gaussians.h).
#ifndef SPLATLAB_KERNELS_SPLAT_LANES_H
#define SPLATLAB_KERNELS_SPLAT_LANES_H

#include "shared.h"

#ifndef LANES
#define LANES 1
#endif

#if LANES == 1

typedef float Real;
typedef int Int; // also a condition: 0 is false
#define ANY(condition)   (condition)
#define INT_OF(real)     ((int)(real))
#define REAL_OF(integer) ((float)(integer))
#define LANE_NUMBERS     0

#else

#include "conditions.h"

typedef float16 Real;
typedef int16 Int; // also a condition: 0 is false, -1 true
#define ANY(condition)   any_of(condition)
#define INT_OF(real)     convert_int16(real)
#define REAL_OF(integer) convert_float16(integer)
#define LANE_NUMBERS     ((int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15))

// Rows become columns: four times, the upper half's rows are shuffled into the lower half's like a pack of cards. Seen as one number,
// row and lane, each time rotates its eight bits by one.
static inline void transpose16(float16 *m) {
    for (int round = 0; round < 4; round++) {
        float16 shuffled[16];
#pragma unroll
        for (int i = 0; i < 8; i++) {
            const float16 a = m[i], b = m[i + 8];
            shuffled[2 * i] = (float16)(a.s0, b.s0, a.s1, b.s1, a.s2, b.s2, a.s3, b.s3, a.s4, b.s4, a.s5, b.s5, a.s6,
                                        b.s6, a.s7, b.s7);
            shuffled[2 * i + 1] = (float16)(a.s8, b.s8, a.s9, b.s9, a.sa, b.sa, a.sb, b.sb, a.sc, b.sc, a.sd, b.sd,
                                            a.se, b.se, a.sf, b.sf);
        }
#pragma unroll
        for (int i = 0; i < 16; i++) m[i] = shuffled[i];
    }
}

#endif

// ---- three numbers a splat ----

typedef struct {
    Real x, y, z;
} Vec3;

static inline Vec3 vec3(Real x, Real y, Real z) {
    const Vec3 v = {x, y, z};
    return v;
}

static inline Vec3 vec3_add(Vec3 a, Vec3 b) { return vec3(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline Vec3 vec3_sub(Vec3 a, Vec3 b) { return vec3(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline Vec3 vec3_mul(Vec3 a, Vec3 b) { return vec3(a.x * b.x, a.y * b.y, a.z * b.z); }
static inline Vec3 vec3_scale(Vec3 a, Real s) { return vec3(a.x * s, a.y * s, a.z * s); }
static inline Real vec3_dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// a s + b t
static inline Vec3 vec3_mix(Vec3 a, Real s, Vec3 b, Real t) {
    return vec3(a.x * s + b.x * t, a.y * s + b.y * t, a.z * s + b.z * t);
}

static inline Vec3 vec3_cross(Vec3 a, Vec3 b) {
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

// Three numbers that are the same for all splats.
static inline Vec3 vec3_all(const float *v) { return vec3((Real)(v[0]), (Real)(v[1]), (Real)(v[2])); }

// ---- memory ----

// Where the numbers of splat `first` (LANES 16: of the group that begins with it) begin in a field of so many numbers a splat. A
// field of one number lies like any array.
static inline size_t lanes_at(int first, int width) {
    return (size_t)(first / SPLAT_GROUP * SPLAT_GROUP) * width + first % SPLAT_GROUP;
}

// Number k of the splats at that place.
static inline Real lanes_load(__global const float *at, int k) {
#if LANES == 1
    return at[SPLAT_GROUP * k];
#else
    return vload16(k, at);
#endif
}

static inline void lanes_store(Real value, __global float *at, int k) {
#if LANES == 1
    at[SPLAT_GROUP * k] = value;
#else
    vstore16(value, k, at);
#endif
}

static inline Vec3 lanes_load3(__global const float *at, int k) {
    return vec3(lanes_load(at, k), lanes_load(at, k + 1), lanes_load(at, k + 2));
}

#endif
