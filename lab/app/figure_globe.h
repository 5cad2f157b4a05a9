// figure_globe.h - shaded balls and ellipsoids, seen from afar, by a ray through each pixel.
#ifndef SPLATLAB_LAB_APP_FIGURE_GLOBE_H
#define SPLATLAB_LAB_APP_FIGURE_GLOBE_H

#include "lab/base/image.h"
#include "lab/base/vec.h"

// Colour of the surface at a point of the unit ball.
typedef void (*GlobePaint)(Vec3 unit, const void *context, double rgb[3]);

// Adds to a square of `side` px, its corner at (x, y) of the image (3 channels), the picture of { from_unit u : |u| = 1 }.
// The eye looks along +z, x right, y down; `scale`: px per unit. ambient: how bright the side is that the light does
// not reach, 0..1. Beside the surface the image stays as it is.
void figure_globe(ImageF *image, int x, int y, int side, const Mat3 *from_unit, double scale, double ambient,
                  GlobePaint paint, const void *context);

// Lines of longitude and latitude about the three axes, each axis in a colour of its own: shows how a ball was turned.
void globe_paint_axes(Vec3 unit, const void *context, double rgb[3]);

#endif
