// ray_texture.h - painted pictures on surfaces, filtered so that they never alias: a pyramid of halved copies (mip map),
// read in several places along the longer axis of what a pixel covers.
#ifndef SPLATLAB_SPLAT3D_RAY_TEXTURE_H
#define SPLATLAB_SPLAT3D_RAY_TEXTURE_H

#include "lab/base/vec.h"

#include <stdint.h>

// One texel as its painter gives it.
typedef struct {
    Vec3 colour;   // albedo, linear, each in [0, 1]
    double height; // relief in [0, 1]; 0 where it is flat
} RayTexel;

// Paints the point (u, v) in [0, 1)^2; should fit together at the borders, because textures repeat. Runs on several threads.
typedef RayTexel RayPainter(const void *context, double u, double v);

enum { RAY_TEXTURE_LEVELS = 12 };

typedef struct {
    int size;                           // texels a side, a power of two
    int levels;                         // size, size / 2, ... 1
    uint8_t *texel[RAY_TEXTURE_LEVELS]; // each (side, side, 4): square roots of r g b, height; times 255
} RayTexture;

// size: a power of two, <= 2048. Painters should be smooth at the scale of a texel.
RayTexture ray_texture_paint(int size, RayPainter *painter, const void *context);
void ray_texture_destroy(RayTexture *texture); // accepts a zeroed one

// What a pixel covers of the texture: an ellipse with the axes (du, dv), long and short, in texture coordinates.
typedef struct {
    double long_u, long_v, short_u, short_v;
} RayFootprint;

RayTexel ray_texture_read(const RayTexture *texture, double u, double v, RayFootprint footprint);

// Only the height, over a round spot of this width in texture coordinates; much quicker.
double ray_texture_height(const RayTexture *texture, double u, double v, double width);

// The mean of the whole.
Vec3 ray_texture_mean(const RayTexture *texture);

#endif
