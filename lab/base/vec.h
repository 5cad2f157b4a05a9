// vec.h - three-vectors and 3x3 matrices in double precision, by value; matrices row-major, m[3 * row + column].
#ifndef SPLATLAB_LAB_BASE_VEC_H
#define SPLATLAB_LAB_BASE_VEC_H

#include <math.h>

typedef struct {
    double x, y, z;
} Vec3;
typedef struct {
    double m[9];
} Mat3;

static inline Vec3 vec3(double x, double y, double z) { return (Vec3){x, y, z}; }
static inline Vec3 vec3_add(Vec3 a, Vec3 b) { return vec3(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline Vec3 vec3_sub(Vec3 a, Vec3 b) { return vec3(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline Vec3 vec3_mul(Vec3 a, Vec3 b) { return vec3(a.x * b.x, a.y * b.y, a.z * b.z); }
static inline Vec3 vec3_scale(Vec3 a, double s) { return vec3(a.x * s, a.y * s, a.z * s); }
static inline double vec3_dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline Vec3 vec3_cross(Vec3 a, Vec3 b) {
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
static inline double vec3_length(Vec3 a) { return sqrt(vec3_dot(a, a)); }
// The zero vector has no direction: it comes back as it is.
static inline Vec3 vec3_normalize(Vec3 a) {
    double length = vec3_length(a);
    return length > 0 ? vec3_scale(a, 1 / length) : a;
}
static inline Vec3 vec3_lerp(Vec3 a, Vec3 b, double t) { return vec3_add(vec3_scale(a, 1 - t), vec3_scale(b, t)); }

static inline Vec3 mat3_apply(const Mat3 *a, Vec3 v) {
    const double *m = a->m;
    return vec3(m[0] * v.x + m[1] * v.y + m[2] * v.z, m[3] * v.x + m[4] * v.y + m[5] * v.z,
                m[6] * v.x + m[7] * v.y + m[8] * v.z);
}
static inline Mat3 mat3_transpose(const Mat3 *a) {
    const double *m = a->m;
    return (Mat3){{m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]}};
}
static inline Mat3 mat3_multiply(const Mat3 *a, const Mat3 *b) {
    Mat3 c;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            c.m[3 * i + j] = a->m[3 * i] * b->m[j] + a->m[3 * i + 1] * b->m[3 + j] + a->m[3 * i + 2] * b->m[6 + j];
    return c;
}

#endif
