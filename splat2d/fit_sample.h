// fit_sample.h - where new blobs go: pixels drawn at random, more often where there is more to explain.
#ifndef SPLATLAB_SPLAT2D_FIT_SAMPLE_H
#define SPLATLAB_SPLAT2D_FIT_SAMPLE_H

#include "lab/base/image.h"
#include "lab/base/rng.h"

// Weights of pixels, >= 0, (height, width), owned by the caller (mem_free).
double *fit_weights_of_edges(const ImageF *photo); // how fast brightness changes, plus a share for all
double *fit_weights_of_error(const ImageF *picture, const ImageF *photo); // squared difference

// A place in the picture, and how far its neighbours are when `count` places are drawn by these weights.
typedef struct {
    double x, y;       // px
    double spacing_px; // the side of a square that holds one place on average
} FitPlace;

// Draws `count` places. The random numbers are those of (seed, purpose, a, index).
void fit_sample(const double *weights, int width, int height, uint64_t seed, RngPurpose purpose, uint32_t a, int count,
                FitPlace *places);

#endif
