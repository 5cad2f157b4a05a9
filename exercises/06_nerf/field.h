// field.h - what E06 renders: a ray through a cloud, that can be asked at any depth for its density and colour.
//
// In NeRF the answer comes from a network; here from a sum of Gaussian bumps along the ray, so that the true integral is known
// (splat2d/volume_ray.h). Ask it through field_at() alone.
#ifndef SPLATLAB_EXERCISES_06_NERF_FIELD_H
#define SPLATLAB_EXERCISES_06_NERF_FIELD_H

#include "exercises/exercise.h"

// density exp(-(t - centre)^2 / (2 width^2)) of that colour.
typedef struct {
    REAL centre, width, density, rgb[3];
} FieldBump;

enum { FIELD_BUMPS = 3 };

typedef struct {
    REAL near, far; // where the ray begins and ends, near < far
    FieldBump bumps[FIELD_BUMPS];
} Field;

// At depth t: the density *sigma >= 0 (1 / length), and the colour there.
static inline void field_at(const Field *f, REAL t, REAL *sigma, REAL rgb[3]) {
    *sigma = 0;
    rgb[0] = rgb[1] = rgb[2] = 0;
    for (int i = 0; i < FIELD_BUMPS; i++) {
        const FieldBump *b = &f->bumps[i];
        REAL x = (t - b->centre) / b->width, density = b->density * exp(-x * x / 2);
        *sigma += density;
        for (int c = 0; c < 3; c++) rgb[c] += density * b->rgb[c];
    }
    for (int c = 0; c < 3; c++) rgb[c] = *sigma > 0 ? rgb[c] / *sigma : 0;
}

#endif
