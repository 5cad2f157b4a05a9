// points.h - a cloud of coloured points, as structure from motion finds them: what training starts from.
#ifndef SPLATLAB_SPLAT3D_POINTS_H
#define SPLATLAB_SPLAT3D_POINTS_H

#include <stdint.h>

typedef struct {
    int count;
    double *xyz;  // (count, 3), world
    uint8_t *rgb; // (count, 3)
} Points;

Points points_create(int count);
void points_destroy(Points *points); // accepts a zeroed or destroyed one

#endif
