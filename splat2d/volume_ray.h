// volume_ray.h - a ray through a cloud: its colour as an integral, and as a sum over samples.
//
// Light of colour c is given off and swallowed with density sigma along the ray (Max 1995, eq. 5; Mildenhall et al. 2020,
// eq. 1):
//     C = integral of T(t) sigma(t) c(t) dt,   T(t) = exp(-integral of sigma from near to t).
// Here sigma is a sum of bumps, so T is known in closed form (erf) and C is a single integral of a smooth function: the truth
// that a sum over samples (Max 1995, eq. 12; Mildenhall et al. 2020, eq. 3) can be measured by.
#ifndef SPLATLAB_SPLAT2D_VOLUME_RAY_H
#define SPLATLAB_SPLAT2D_VOLUME_RAY_H

enum { VOLUME_BUMPS_MAX = 4 };

// density exp(-(t - centre)^2 / (2 width^2)) of that colour.
typedef struct {
    double centre, width; // units of length along the ray; width > 0
    double density;       // 1 / length, >= 0
    double rgb[3];
} VolumeBump;

typedef struct {
    double near, far; // of the ray, near < far
    int count;        // 0..VOLUME_BUMPS_MAX
    VolumeBump bumps[VOLUME_BUMPS_MAX];
} VolumeRay;

// Density and colour at t: the bumps' densities added, and the mean of their colours by density (black where there is none).
double volume_ray_at(const VolumeRay *ray, double t, double rgb[3]);

double volume_ray_transmittance(const VolumeRay *ray, double t); // from near to t

// C and T(far), to about 1e-12.
void volume_ray_integral(const VolumeRay *ray, double rgb[3], double *transmittance);

// C by n equal segments, each with the density and colour of its middle.
void volume_ray_quadrature(const VolumeRay *ray, int n, double rgb[3], double *transmittance);

#endif
