// blob_picture.h - a covariance as the picture that it makes: for rungs whose answer is a shape.
#ifndef SPLATLAB_EXERCISES_HARNESS_BLOB_PICTURE_H
#define SPLATLAB_EXERCISES_HARNESS_BLOB_PICTURE_H

#include "lab/base/image.h"
#include "splat2d/covariance.h"

// g = exp(-m^2 / 2) of a blob in the middle, black to white, with the ring m = 1 in colour; three channels, owned by the caller.
// half_width: what is seen to each side, in the covariance's unit. What is no covariance is drawn in plain red.
ImageF blob_picture(Sym2 covariance, double half_width);

// A half_width at which this one fills half of the picture.
double blob_picture_fit(Sym2 covariance);

#endif
