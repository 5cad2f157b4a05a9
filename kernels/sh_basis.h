// sh_basis.h - the real spherical harmonics of degree 0..3 at a unit direction, and their derivatives by it.
//
// Functions are ordered by degree l, then m = -l..l, with the Condon-Shortley sign, as 3DGS models store them
// (Kerbl et al. 2023, section 4; the polynomials: Sloan, "Stupid spherical harmonics tricks", 2008, appendix A2).
// The derivative is that of the polynomial in free x, y, z; the caller takes out the part along the direction.
// Reference: reference_sh_basis() in splat3d/reference_sh.c.
#ifndef SPLATLAB_KERNELS_SH_BASIS_H
#define SPLATLAB_KERNELS_SH_BASIS_H

#include "splat_lanes.h"

#define SH_C0  0.282094792f // 1/2 sqrt(1 / pi)
#define SH_C1  0.488602512f // 1/2 sqrt(3 / pi)
#define SH_C2A 1.092548431f // 1/2 sqrt(15 / pi)
#define SH_C2B 0.315391565f // 1/4 sqrt(5 / pi)
#define SH_C2C 0.546274215f // 1/4 sqrt(15 / pi)
#define SH_C3A 0.590043590f // 1/8 sqrt(70 / pi)
#define SH_C3B 2.890611443f // 1/2 sqrt(105 / pi)
#define SH_C3C 0.457045799f // 1/8 sqrt(42 / pi)
#define SH_C3D 0.373176333f // 1/4 sqrt(7 / pi)
#define SH_C3E 1.445305721f // 1/4 sqrt(105 / pi)

// Degree 1: basis[3].
static inline void sh_basis1(Vec3 d, Real *basis) {
    basis[0] = -SH_C1 * d.y;
    basis[1] = SH_C1 * d.z;
    basis[2] = -SH_C1 * d.x;
}

// Degree 2: basis[5].
static inline void sh_basis2(Vec3 d, Real *basis) {
    basis[0] = SH_C2A * d.x * d.y;
    basis[1] = -SH_C2A * d.y * d.z;
    basis[2] = SH_C2B * (2 * d.z * d.z - d.x * d.x - d.y * d.y);
    basis[3] = -SH_C2A * d.x * d.z;
    basis[4] = SH_C2C * (d.x * d.x - d.y * d.y);
}

// Degree 3: basis[7].
static inline void sh_basis3(Vec3 d, Real *basis) {
    const Real xx = d.x * d.x, yy = d.y * d.y, zz = d.z * d.z;
    basis[0] = -SH_C3A * d.y * (3 * xx - yy);
    basis[1] = SH_C3B * d.x * d.y * d.z;
    basis[2] = -SH_C3C * d.y * (4 * zz - xx - yy);
    basis[3] = SH_C3D * d.z * (2 * zz - 3 * xx - 3 * yy);
    basis[4] = -SH_C3C * d.x * (4 * zz - xx - yy);
    basis[5] = SH_C3E * d.z * (xx - yy);
    basis[6] = -SH_C3A * d.x * (xx - 3 * yy);
}

// The functions of degrees 1 to 3 one after the other, zero above `degree`: basis[15].
static inline void sh_basis(int degree, Vec3 d, Real *basis) {
    for (int k = 0; k < SH_COEFFICIENTS_MAX - 1; k++) basis[k] = (Real)(0.0f);
    if (degree >= 1) sh_basis1(d, basis);
    if (degree >= 2) sh_basis2(d, basis + 3);
    if (degree >= 3) sh_basis3(d, basis + 8);
}

// Gradients by d of the functions of one degree, each weighted with weight[k] and summed.
static inline Vec3 sh_slope1(const Real *weight) {
    return vec3(-SH_C1 * weight[2], -SH_C1 * weight[0], SH_C1 * weight[1]);
}

static inline Vec3 sh_slope2(Vec3 d, const Real *weight) {
    const Real c0 = SH_C2A * weight[0], c1 = -SH_C2A * weight[1], c2 = 2 * SH_C2B * weight[2], c3 = -SH_C2A * weight[3],
               c4 = 2 * SH_C2C * weight[4];
    return vec3(c0 * d.y - c2 * d.x + c3 * d.z + c4 * d.x, //
                c0 * d.x + c1 * d.z - c2 * d.y - c4 * d.y, //
                c1 * d.y + 2 * c2 * d.z + c3 * d.x);
}

static inline Vec3 sh_slope3(Vec3 d, const Real *weight) {
    const Real xx = d.x * d.x, yy = d.y * d.y, zz = d.z * d.z;
    const Real xy = d.x * d.y, xz = d.x * d.z, yz = d.y * d.z;
    const Real c0 = -SH_C3A * weight[0], c1 = SH_C3B * weight[1], c2 = -SH_C3C * weight[2], c3 = SH_C3D * weight[3],
               c4 = -SH_C3C * weight[4], c5 = SH_C3E * weight[5], c6 = -SH_C3A * weight[6];
    return vec3(6 * c0 * xy + c1 * yz - 2 * c2 * xy - 6 * c3 * xz + c4 * (4 * zz - 3 * xx - yy) + 2 * c5 * xz +
                    3 * c6 * (xx - yy),
                3 * c0 * (xx - yy) + c1 * xz + c2 * (4 * zz - xx - 3 * yy) - 6 * c3 * yz - 2 * c4 * xy - 2 * c5 * yz -
                    6 * c6 * xy,
                c1 * xy + 8 * c2 * yz + c3 * (6 * zz - 3 * xx - 3 * yy) + 8 * c4 * xz + c5 * (xx - yy));
}

// Of all degrees up to `degree`: weight[15] as basis[15].
static inline Vec3 sh_slope(int degree, Vec3 d, const Real *weight) {
    Vec3 slope = vec3((Real)(0.0f), (Real)(0.0f), (Real)(0.0f));
    if (degree >= 1) slope = sh_slope1(weight);
    if (degree >= 2) slope = vec3_add(slope, sh_slope2(d, weight + 3));
    if (degree >= 3) slope = vec3_add(slope, sh_slope3(d, weight + 8));
    return slope;
}

#endif
