// perspective.h - the picture of a Gaussian ball of points, exactly: mean and covariance of what a pinhole makes of it.
//
// The Gaussian is cut at EWA_CUT standard deviations: uncut it would reach through the plane of the camera, where x / z has no
// mean. Its covariance is divided by ewa_cut_factor(), so that a camera far away sees the uncut one's.
//
// Only depth makes perspective more than a linear map. With zeta the standardised coordinate along which depth changes,
// z = c_z + s zeta (s^2 = Sigma_zz), and at a given zeta the other coordinates are a Gaussian cut to a disc,
// whose moments are known, seen by a linear map. So one integral over zeta is left, done by Gauss and Legendre.
#ifndef SPLATLAB_EXERCISES_HARNESS_PERSPECTIVE_H
#define SPLATLAB_EXERCISES_HARNESS_PERSPECTIVE_H

#include "lab/base/vec.h"
#include "splat2d/covariance.h"
#include "splat3d/camera.h"
#include "splat3d/ewa_error.h"

typedef struct {
    double mean[2];  // px
    Sym2 covariance; // px^2, divided by the factor
    // Standard errors of the same from one sample; from n samples they are smaller by sqrt(n). xy: an upper bound.
    double mean_error[2];
    Sym2 covariance_error;
} Perspective;

// mean_cam, covariance_cam: in camera axes; all of the cut Gaussian must lie in front: mean_cam.z > 3 sqrt(covariance_cam.zz).
Perspective perspective_of(const Camera *camera, Vec3 mean_cam, Sym3 covariance_cam);

#endif
