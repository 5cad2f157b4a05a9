// fit_photo.h - a photograph as a fit wants it: three channels, and not larger than asked for.
#ifndef SPLATLAB_LAB_APP_FIT_PHOTO_H
#define SPLATLAB_LAB_APP_FIT_PHOTO_H

#include "lab/base/image.h"

#include <stdbool.h>

// The file over white where it has alpha; averaged over blocks of downscale x downscale pixels; then made smaller, keeping
// its shape, until it fits into width x height px (0 x 0: any size). It is never enlarged.
bool fit_photo_load(const char *path, int downscale, int width, int height, ImageF *photo);

// The mean over the area that each target pixel covers; both sides at most those of the source.
ImageF fit_photo_shrink(const ImageF *source, int width, int height);

#endif
