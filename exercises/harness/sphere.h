// sphere.h - integrals over all directions, and a picture of a function of the direction.
#ifndef SPLATLAB_EXERCISES_HARNESS_SPHERE_H
#define SPLATLAB_EXERCISES_HARNESS_SPHERE_H

#include "lab/base/vec.h"

#include <stdbool.h>

enum { SPHERE_RINGS = 4, SPHERE_STEPS = 8, SPHERE_NODES = SPHERE_RINGS * SPHERE_STEPS };

typedef struct {
    Vec3 direction;
    double weight; // all together: 4 pi
} SphereNode;

// Four rings by Gauss and Legendre, eight equal steps round each: the sum of weight times f is the integral of f, exactly so
// for polynomials of degree 7 or less in x, y, z, hence for products of two harmonics of degree 3.
SphereNode sphere_node(int i);

// A globe on a square of side x side pixels: the direction of pixel (x, y) on the near half. False beside it.
bool sphere_globe(int side, int x, int y, Vec3 *direction);

#endif
