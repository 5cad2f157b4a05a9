// ray_noise.h - smooth random functions for painted textures, clouds and uneven surfaces.
//
// Gradient noise (Perlin, "Improving noise", SIGGRAPH 2002) on a lattice whose gradients come from an integer hash of
// (lattice point, seed); no tables, so it is the same on every machine and in every thread.
#ifndef SPLATLAB_SPLAT3D_RAY_NOISE_H
#define SPLATLAB_SPLAT3D_RAY_NOISE_H

#include "lab/base/vec.h"

#include <stdint.h>

// 32 well mixed bits of three integers and a seed.
uint32_t noise_hash(int x, int y, int z, uint32_t seed);

// noise_hash() as a number in [0, 1).
double noise_cell(int x, int y, int z, uint32_t seed);

// Smooth, about [-0.8, 0.8], mean 0, features of size 1. x and y repeat after `period` units; 0: they never do. A whole z takes half the
// time: patterns in the plane are slices at whole z, a different one for each use.
double noise_gradient(Vec3 p, int period, uint32_t seed);

// Sum of `octaves` noises, each twice as fine and half as strong (fractal Brownian motion); about [-1, 1].
double noise_fbm(Vec3 p, int period, int octaves, uint32_t seed);

// Cells round scattered points, one point per unit square (Worley, "A cellular texture basis function", SIGGRAPH 1996).
// Returns the distance to the nearest point; *gap (may be NULL) is how much farther the second nearest is (0 on a border of two
// cells), *id (may be NULL) tells the cells apart. Repeats after `period` units.
double noise_cells(double x, double y, int period, uint32_t seed, double *gap, uint32_t *id);

// 0 below low, 1 above high, smooth between.
double noise_step(double low, double high, double x);

#endif
