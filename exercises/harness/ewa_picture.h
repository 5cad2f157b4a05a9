// ewa_picture.h - a mean and covariance on the screen, over the ellipse that EWA makes of the same splat.
#ifndef SPLATLAB_EXERCISES_HARNESS_EWA_PICTURE_H
#define SPLATLAB_EXERCISES_HARNESS_EWA_PICTURE_H

#include "lab/base/image.h"
#include "splat2d/covariance.h"

// A window of half_width px to each side of EWA's centre: g = exp(-m^2 / 2) of a Gaussian whose mean lies (dx, dy) px from it, with
// its ring m = 1 in orange, and that of `ewa` (px^2, without the low-pass) in blue. Three channels, owned by the caller.
ImageF ewa_picture(Sym2 ewa, double dx, double dy, Sym2 covariance, double half_width);

#endif
