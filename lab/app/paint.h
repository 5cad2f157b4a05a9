// paint.h - textured triangles into an image, in plain C: what a graphics card does for a window, for screens without one.
#ifndef SPLATLAB_LAB_APP_PAINT_H
#define SPLATLAB_LAB_APP_PAINT_H

#include "lab/base/image.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    float x, y;      // px, y down
    float u, v;      // place in the texture, 0..1
    uint8_t rgba[4]; // straight alpha
} PaintVertex;

typedef struct {
    const Image8 *image; // 3 or 4 channels
    bool smooth;         // bilinear, else nearest
} PaintTexture;

// Blends count / 3 triangles over the image (3 channels), in order. A pixel is covered when its centre is inside; one on
// the edge of two triangles belongs to one of them. clip: left, top, right, bottom px, the last two excluded.
void paint_triangles(Image8 *to, const int clip[4], PaintTexture texture, const PaintVertex *vertices,
                     const uint16_t *indices, int count);

#ifdef __cplusplus
}
#endif
#endif
