// image.h - pixels in memory: 8-bit for photographs that wait to be used, float for everything computed.
//
// Both are row-major, top row first, channels interleaved: value (x, y, c) stands at (y * width + x) * channels + c.
// Alpha, where there is a fourth channel, is straight (not premultiplied).
#ifndef SPLATLAB_LAB_BASE_IMAGE_H
#define SPLATLAB_LAB_BASE_IMAGE_H

#include <stdbool.h>
#include <stdint.h>

typedef struct {
    int width, height; // pixels
    int channels;      // 1 grey, 3 RGB, 4 RGBA
    uint8_t *bytes;    // (height, width, channels), owned
} Image8;

typedef struct {
    int width, height; // pixels
    int channels;      // 1, 3 or 4
    float *values;     // (height, width, channels), owned
} ImageF;

Image8 image8_create(int width, int height, int channels); // zeroed
ImageF imagef_create(int width, int height, int channels); // zeroed
void image8_destroy(Image8 *image);                        // accepts a zeroed or destroyed one
void imagef_destroy(ImageF *image);

// Rounds to the nearest of 0..255 after clipping to [0, 1]; NaN becomes 0.
Image8 image8_from_float(const ImageF *image);
ImageF imagef_from_8(const Image8 *image);

// RGBA over a background colour -> RGB; RGB comes back as a copy. background: r g b in [0, 1].
ImageF imagef_over(const Image8 *image, const float background[3]);

// The mean over blocks of k x k source pixels, in premultiplied alpha, so that transparent pixels do not bleed their
// colour; width / k and height / k rounded down, remainders cut off right and below. k >= 1.
Image8 image8_downscale(const Image8 *image, int k);

// Copies source into target with its top left corner at (x, y); what falls outside is left out. Same channel count.
void imagef_paste(ImageF *target, const ImageF *source, int x, int y);

#endif
