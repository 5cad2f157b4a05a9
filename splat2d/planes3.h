// planes3.h - a picture as three planes with a margin of zeros on all sides: blurs and loops in steps of LANES need no
// special case at the border.
#ifndef SPLATLAB_SPLAT2D_PLANES3_H
#define SPLATLAB_SPLAT2D_PLANES3_H

#include "lab/base/image.h"

#include <stddef.h>

enum { PLANES3_CHANNELS = 3, PLANES3_MARGIN = 8 /* px; at least SSIM's radius */ };

typedef struct {
    int width, height; // px
    ptrdiff_t stride;  // floats from row to row
    float *floats;     // owned
} Planes3;

Planes3 planes3_create(int width, int height); // zeroed
void planes3_destroy(Planes3 *planes);         // accepts a zeroed one

// Pixel 0 of a row; x and row may reach into the margin.
float *planes3_row(const Planes3 *planes, int channel, int row);

// The width rounded up to whole lanes; less than that and the margin to the next row.
int planes3_lanes_width(const Planes3 *planes);

// Zeroes what lies between the width and that: to be called when a row was written in whole lanes.
void planes3_clear_margin(const Planes3 *planes, int channel, int row);

// From and to 3 interleaved channels of the same size.
void planes3_from_image(const Planes3 *planes, const ImageF *image);
void planes3_to_image(const Planes3 *planes, ImageF *image);

#endif
