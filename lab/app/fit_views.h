// fit_views.h - two pictures that explain a fit: where it is wrong, and where its blobs lie.
#ifndef SPLATLAB_LAB_APP_FIT_VIEWS_H
#define SPLATLAB_LAB_APP_FIT_VIEWS_H

#include "lab/base/image.h"
#include "splat2d/scene2d.h"

enum { FIT_ERROR_GAIN = 4 };

// |photo - picture|, FIT_ERROR_GAIN times as large; owned by the caller, as the other.
ImageF fit_view_error(const ImageF *photo, const ImageF *picture);

// Each blob as its ellipse of one standard deviation, on black.
ImageF fit_view_discs(const Scene2d *scene);

#endif
