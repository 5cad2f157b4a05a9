// line_picture.h - pictures of lines: axes, arrows, crosses and frames, for rungs whose answer is a direction or a place.
#ifndef SPLATLAB_EXERCISES_HARNESS_LINE_PICTURE_H
#define SPLATLAB_EXERCISES_HARNESS_LINE_PICTURE_H

#include "lab/base/image.h"

extern const float LINE_RED[3], LINE_GREEN[3], LINE_BLUE[3], LINE_GREY[3], LINE_YELLOW[3];

// Dark, three channels, owned by the caller.
ImageF line_picture_create(int width, int height);

// Both ends in px, y down; what falls outside is cut off, and what is not finite is not drawn.
void line_picture_line(ImageF *image, const double from[2], const double to[2], const float rgb[3]);
void line_picture_arrow(ImageF *image, const double from[2], const double to[2], const float rgb[3]);
void line_picture_cross(ImageF *image, const double at[2], double half_size, const float rgb[3]);
void line_picture_box(ImageF *image, const double low[2], const double high[2], const float rgb[3]);

#endif
