// splat_lanes.h - numbers of LANES splats at once: what lets one source be a CPU's kernel and a GPU's (OpenCL C).
//
// A GPU runs one splat in one work-item (LANES 1, the default): Real is float. A CPU's compiler does not vectorise such kernels
// over work-items, so there a work-item takes sixteen splats (-D LANES=16): Real is float16, one splat a lane, and branches become masks.
// The model lies splat by splat in memory; loads and stores below turn it into lanes and back by moves between registers:
//
//     memory  x0 y0 z0 x1 y1 z1 ... x15 y15 z15      <->      x: x0 x1 ... x15    y: y0 y1 ... y15    z: z0 z1 ... z15
//
// Whole groups of lanes are read and written: buffers have room for the last one (splat3d/device_gaussians.h).
#ifndef SPLATLAB_KERNELS_SPLAT_LANES_H
#define SPLATLAB_KERNELS_SPLAT_LANES_H

#ifndef LANES
#define LANES 1
#endif
#ifndef OUT
#define OUT __global // where the stores below go
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

// ---- memory; first: the group's first splat, of fields (N,1), (N,3) and (N,4) ----

#if LANES == 1

static inline Real lanes_load(__global const float *field, int first) { return field[first]; }
static inline void lanes_store(Real value, OUT float *field, int first) { field[first] = value; }

static inline Vec3 lanes_load3(__global const float *field, int first) {
    const float3 v = vload3(first, field);
    return vec3(v.x, v.y, v.z);
}

static inline void lanes_store3(Vec3 v, OUT float *field, int first) { vstore3((float3)(v.x, v.y, v.z), first, field); }

static inline void lanes_load4(__global const float *field, int first, Real *out) {
    vstore4(vload4(first, field), 0, out);
}

static inline void lanes_store4(const Real *v, OUT float *field, int first) { vstore4(vload4(0, v), first, field); }

#else

static inline Real lanes_load(__global const float *field, int first) { return vload16(0, field + first); }
static inline void lanes_store(Real value, OUT float *field, int first) { vstore16(value, 0, field + first); }

static inline Vec3 lanes_load3(__global const float *field, int first) {
    const float16 a = vload16(0, field + 3 * first), b = vload16(1, field + 3 * first),
                  c = vload16(2, field + 3 * first);
    return vec3(
        (float16)(a.s0, a.s3, a.s6, a.s9, a.sc, a.sf, b.s2, b.s5, b.s8, b.sb, b.se, c.s1, c.s4, c.s7, c.sa, c.sd),
        (float16)(a.s1, a.s4, a.s7, a.sa, a.sd, b.s0, b.s3, b.s6, b.s9, b.sc, b.sf, c.s2, c.s5, c.s8, c.sb, c.se),
        (float16)(a.s2, a.s5, a.s8, a.sb, a.se, b.s1, b.s4, b.s7, b.sa, b.sd, c.s0, c.s3, c.s6, c.s9, c.sc, c.sf));
}

static inline void lanes_store3(Vec3 v, OUT float *field, int first) {
    const float16 x = v.x, y = v.y, z = v.z;
    vstore16((float16)(x.s0, y.s0, z.s0, x.s1, y.s1, z.s1, x.s2, y.s2, z.s2, x.s3, y.s3, z.s3, x.s4, y.s4, z.s4, x.s5),
             0, field + 3 * first);
    vstore16((float16)(y.s5, z.s5, x.s6, y.s6, z.s6, x.s7, y.s7, z.s7, x.s8, y.s8, z.s8, x.s9, y.s9, z.s9, x.sa, y.sa),
             1, field + 3 * first);
    vstore16((float16)(z.sa, x.sb, y.sb, z.sb, x.sc, y.sc, z.sc, x.sd, y.sd, z.sd, x.se, y.se, z.se, x.sf, y.sf, z.sf),
             2, field + 3 * first);
}

static inline void lanes_load4(__global const float *field, int first, Real *out) {
    const float16 a = vload16(0, field + 4 * first), b = vload16(1, field + 4 * first),
                  c = vload16(2, field + 4 * first), d = vload16(3, field + 4 * first);
    out[0] = (float16)(a.s048c, b.s048c, c.s048c, d.s048c);
    out[1] = (float16)(a.s159d, b.s159d, c.s159d, d.s159d);
    out[2] = (float16)(a.s26ae, b.s26ae, c.s26ae, d.s26ae);
    out[3] = (float16)(a.s37bf, b.s37bf, c.s37bf, d.s37bf);
}

static inline void lanes_store4(const Real *v, OUT float *field, int first) {
    const float16 a = v[0], b = v[1], c = v[2], d = v[3];
    vstore16((float16)(a.s0, b.s0, c.s0, d.s0, a.s1, b.s1, c.s1, d.s1, a.s2, b.s2, c.s2, d.s2, a.s3, b.s3, c.s3, d.s3),
             0, field + 4 * first);
    vstore16((float16)(a.s4, b.s4, c.s4, d.s4, a.s5, b.s5, c.s5, d.s5, a.s6, b.s6, c.s6, d.s6, a.s7, b.s7, c.s7, d.s7),
             1, field + 4 * first);
    vstore16((float16)(a.s8, b.s8, c.s8, d.s8, a.s9, b.s9, c.s9, d.s9, a.sa, b.sa, c.sa, d.sa, a.sb, b.sb, c.sb, d.sb),
             2, field + 4 * first);
    vstore16((float16)(a.sc, b.sc, c.sc, d.sc, a.sd, b.sd, c.sd, d.sd, a.se, b.se, c.se, d.se, a.sf, b.sf, c.sf, d.sf),
             3, field + 4 * first);
}

#endif

#endif
