// sh_basis.h - the real spherical harmonics of degree 0..3 at a unit direction, and their derivatives by it.
//
// Functions are ordered by degree l, then m = -l..l, with the Condon-Shortley sign, as 3DGS models store them
// (Kerbl et al. 2023, section 4; the polynomials: Sloan, "Stupid spherical harmonics tricks", 2008, appendix A2).
// The derivative is that of the polynomial in free x, y, z; the caller takes out the part along the direction.
// Reference: reference_sh_basis() in splat3d/reference_sh.c.
#ifndef SPLATLAB_KERNELS_SH_BASIS_H
#define SPLATLAB_KERNELS_SH_BASIS_H

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
static inline void sh_basis1(float3 d, float *basis) {
    basis[0] = -SH_C1 * d.y;
    basis[1] = SH_C1 * d.z;
    basis[2] = -SH_C1 * d.x;
}

// Degree 2: basis[5].
static inline void sh_basis2(float3 d, float *basis) {
    basis[0] = SH_C2A * d.x * d.y;
    basis[1] = -SH_C2A * d.y * d.z;
    basis[2] = SH_C2B * (2 * d.z * d.z - d.x * d.x - d.y * d.y);
    basis[3] = -SH_C2A * d.x * d.z;
    basis[4] = SH_C2C * (d.x * d.x - d.y * d.y);
}

// Degree 3: basis[7].
static inline void sh_basis3(float3 d, float *basis) {
    const float xx = d.x * d.x, yy = d.y * d.y, zz = d.z * d.z;
    basis[0] = -SH_C3A * d.y * (3 * xx - yy);
    basis[1] = SH_C3B * d.x * d.y * d.z;
    basis[2] = -SH_C3C * d.y * (4 * zz - xx - yy);
    basis[3] = SH_C3D * d.z * (2 * zz - 3 * xx - 3 * yy);
    basis[4] = -SH_C3C * d.x * (4 * zz - xx - yy);
    basis[5] = SH_C3E * d.z * (xx - yy);
    basis[6] = -SH_C3A * d.x * (xx - 3 * yy);
}

// Gradients by d of the functions of one degree, each weighted with weight[k] and summed.
static inline float3 sh_slope1(const float *weight) { return SH_C1 * (float3)(-weight[2], -weight[0], weight[1]); }

static inline float3 sh_slope2(float3 d, const float *weight) {
    const float c0 = SH_C2A * weight[0], c1 = -SH_C2A * weight[1], c2 = 2 * SH_C2B * weight[2],
                c3 = -SH_C2A * weight[3], c4 = 2 * SH_C2C * weight[4];
    return (float3)(c0 * d.y - c2 * d.x + c3 * d.z + c4 * d.x, //
                    c0 * d.x + c1 * d.z - c2 * d.y - c4 * d.y, //
                    c1 * d.y + 2 * c2 * d.z + c3 * d.x);
}

static inline float3 sh_slope3(float3 d, const float *weight) {
    const float xx = d.x * d.x, yy = d.y * d.y, zz = d.z * d.z;
    const float xy = d.x * d.y, xz = d.x * d.z, yz = d.y * d.z;
    float3 slope = -SH_C3A * weight[0] * (float3)(6 * xy, 3 * (xx - yy), 0);
    slope += SH_C3B * weight[1] * (float3)(yz, xz, xy);
    slope -= SH_C3C * weight[2] * (float3)(-2 * xy, 4 * zz - xx - 3 * yy, 8 * yz);
    slope += SH_C3D * weight[3] * (float3)(-6 * xz, -6 * yz, 6 * zz - 3 * xx - 3 * yy);
    slope -= SH_C3C * weight[4] * (float3)(4 * zz - 3 * xx - yy, -2 * xy, 8 * xz);
    slope += SH_C3E * weight[5] * (float3)(2 * xz, -2 * yz, xx - yy);
    slope -= SH_C3A * weight[6] * (float3)(3 * (xx - yy), -6 * xy, 0);
    return slope;
}

#endif
