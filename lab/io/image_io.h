// image_io.h - pictures on disk, read and written by OpenImageIO; image_io.cpp is the only file that knows it.
//
// Reads what OpenImageIO reads (PNG, JPEG, EXR, TIFF, ...): 8- and 16-bit and float, grey to RGBA; EXIF orientation
// is applied, so that the picture stands upright. Writes by the ending of the path, atomically; the same
// pixels give the same bytes.
#ifndef SPLATLAB_LAB_IO_IMAGE_IO_H
#define SPLATLAB_LAB_IO_IMAGE_IO_H

#include "lab/base/image.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// Width, height (after orientation) and channels (3 or 4, as image_load8 gives them), without decoding the pixels.
bool image_probe(const char *path, int *width, int *height, int *channels);

// As 8-bit. Channels: 3, or 4 where the file has alpha (straight); grey becomes RGB.
bool image_load8(const char *path, Image8 *image);

// The same two without regard to EXIF orientation, for those who measured the pixels as they stand in the file.
bool image_probe_stored(const char *path, int *width, int *height, int *channels);
bool image_load8_stored(const char *path, Image8 *image);

// As float: 8- and 16-bit integers become 0..1, float files keep their values. Channels as in the file (1, 3 or 4).
bool image_loadf(const char *path, ImageF *image);

// By the ending: .png .jpg (8-bit), .exr .tif (float).
bool image_save8(const char *path, const Image8 *image);
bool image_savef(const char *path, const ImageF *image); // to .exr/.tif as float, to .png/.jpg rounded to 8 bit

// A film: `count` frames of one size, 3 channels, each shown for delay_ms (in steps of 10 ms), over and over. 256 colours a
// frame, dithered. path ends in .gif.
bool image_save_gif(const char *path, const Image8 *frames, int count, int delay_ms);

#ifdef __cplusplus
}
#endif

#endif
