// ewa_error.h - how wrong the EWA projection is: a splat's points thrown through the true camera, against J W Sigma W^T J^T.
//
// EWA takes the camera as the linear map it is at the splat's mean (reference_project.c). The true picture of the points of
// a 3-D Gaussian is neither centred there nor a Gaussian. Its moments are found by Monte Carlo, over points within CUT
// standard deviations: without the cut some of them lie in or behind the camera's plane, and the moments do not exist.
// The cut makes a Gaussian's own covariance smaller, by ewa_cut_factor(); what is measured is divided by that of the cloud.
//
// First order in r = sigma / z, for a ball of standard deviation sigma at depth z and angle theta off the axis: the centre
// moves outwards by r sin(theta), in units of the splat's radial standard deviation; the covariance errs as r^2.
#ifndef SPLATLAB_SPLAT3D_EWA_ERROR_H
#define SPLATLAB_SPLAT3D_EWA_ERROR_H

#include "splat3d/reference.h"

#include <stdint.h>

static const double EWA_CUT = 3; // standard deviations

// Points of the unit Gaussian within EWA_CUT. They come in groups of 24: all signs of the coordinates, and these in cyclic
// order. So their mean is 0 and their covariance a multiple of I, without any chance in it, and a linear camera would have no
// error at all. One cloud serves all splats: neighbouring cells of a map differ by the splats and not by chance.
typedef struct {
    int count; // a multiple of EWA_GROUP
    Vec3 *points;
    double variance; // of one coordinate; near ewa_cut_factor(EWA_CUT)
} EwaCloud;
enum { EWA_GROUP = 24 };

EwaCloud ewa_cloud_create(int count, uint64_t seed); // count is rounded up to whole groups
void ewa_cloud_destroy(EwaCloud *cloud);             // accepts a zeroed or destroyed one

// Variance of one coordinate of the unit Gaussian in three dimensions that is cut at radius k.
double ewa_cut_factor(double k);

typedef struct {
    double mean_px[2]; // where the points fall, on average
    Sym2 covariance;   // of their pixels, divided by the cloud's variance, px^2
    Splat2 splat;      // what EWA says, without the low pass

    double shift;            // of the mean, as a Mahalanobis distance in the EWA splat
    double covariance_error; // |measured - EWA| / |EWA|, Frobenius
    double skew;             // third standardised moment along the EWA splat's longer axis
} EwaError;

// Splat i of the model as that camera sees it. False, with a message, when the splat is not visible or a point of the cloud
// lies in or behind the camera's plane.
bool ewa_error_measure(const EwaCloud *cloud, const GaussiansD *g, int i, const Camera *camera, EwaError *error);

// The standard case: a ball at depth 1, angle_rad off the axis (to the right), of sigma = ratio; the camera is wide enough for
// the clamp of J not to act. angle_rad in [0, 75 degrees], ratio in (0, 1 / EWA_CUT).
bool ewa_error_of_ball(const EwaCloud *cloud, double angle_rad, double ratio, double focal_px, EwaError *error);

// That case as a model of one splat and its camera; the model is owned by the caller.
GaussiansD ewa_ball(double angle_rad, double ratio, double focal_px, Camera *camera);

#endif
