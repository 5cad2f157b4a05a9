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

// C, to about 1e-12. Returns T(far).
double volume_ray_integral(const VolumeRay *ray, double rgb[3]);

// How a segment's alpha is made of sigma delta. EXPONENTIAL is exact where sigma and c are constant in each segment, else the
// error of the sum falls with 1 / n^2. LINEAR is the first term of its series: it exceeds 1 in thick fog (and is cut there),
// and its error falls with 1 / n only.
typedef enum { VOLUME_EXPONENTIAL, VOLUME_LINEAR, VOLUME_RULE_COUNT } VolumeRule;

// C by n >= 1 equal segments, each with the density and colour of its middle, blended as in compositing.h.
// weights: (n) of T_i alpha_i, or NULL. Returns T behind the last segment.
double volume_ray_quadrature(const VolumeRay *ray, VolumeRule rule, int n, double rgb[3], double *weights);

#endif
