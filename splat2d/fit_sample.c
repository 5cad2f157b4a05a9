// fit_sample.c - weights of pixels, and drawing by them.
#include "splat2d/fit_sample.h"

#include "lab/base/mem.h"

#include <math.h>
#include <stddef.h>

static const double UNIFORM_SHARE = 0.4; // of the mean weight, given to each pixel, so that flat areas get blobs too

static double brightness(const ImageF *image, int x, int y) {
    x = x < 0 ? 0 : x >= image->width ? image->width - 1 : x;
    y = y < 0 ? 0 : y >= image->height ? image->height - 1 : y;
    const float *rgb = image->values + ((ptrdiff_t)y * image->width + x) * 3;
    return ((double)rgb[0] + (double)rgb[1] + (double)rgb[2]) / 3;
}

static void share_with_all(double *weights, ptrdiff_t pixels) {
    double sum = 0;
    for (ptrdiff_t i = 0; i < pixels; i++) sum += weights[i];
    double share = sum > 0 ? UNIFORM_SHARE * sum / (double)pixels : 1;
    for (ptrdiff_t i = 0; i < pixels; i++) weights[i] += share;
}

double *fit_weights_of_edges(const ImageF *photo) {
    ptrdiff_t pixels = (ptrdiff_t)photo->width * photo->height;
    double *weights = mem_alloc((size_t)pixels, sizeof *weights);
    for (int y = 0; y < photo->height; y++)
        for (int x = 0; x < photo->width; x++) {
            double along_x = brightness(photo, x + 1, y) - brightness(photo, x - 1, y);
            double along_y = brightness(photo, x, y + 1) - brightness(photo, x, y - 1);
            weights[(ptrdiff_t)y * photo->width + x] = hypot(along_x, along_y);
        }
    share_with_all(weights, pixels);
    return weights;
}

double *fit_weights_of_error(const ImageF *picture, const ImageF *photo) {
    ptrdiff_t pixels = (ptrdiff_t)photo->width * photo->height;
    double *weights = mem_alloc((size_t)pixels, sizeof *weights);
    for (ptrdiff_t i = 0; i < 3 * pixels; i++) {
        double difference = (double)picture->values[i] - (double)photo->values[i];
        weights[i / 3] += difference * difference;
    }
    share_with_all(weights, pixels);
    return weights;
}

// The first pixel whose running sum exceeds the target.
static ptrdiff_t find(const double *running, ptrdiff_t count, double target) {
    ptrdiff_t low = 0, high = count - 1;
    while (low < high) {
        ptrdiff_t middle = (low + high) / 2;
        if (running[middle] > target)
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

void fit_sample(const double *weights, int width, int height, uint64_t seed, RngPurpose purpose, uint32_t a, int count,
                FitPlace *places) {
    ptrdiff_t pixels = (ptrdiff_t)width * height;
    double *running = mem_alloc((size_t)pixels, sizeof *running), sum = 0;
    for (ptrdiff_t i = 0; i < pixels; i++) running[i] = sum += weights[i];
    for (int k = 0; k < count; k++) {
        Rng rng = rng_at(seed, purpose, a, (uint32_t)k);
        // Without any weight all pixels are alike.
        ptrdiff_t at =
            sum > 0 ? find(running, pixels, rng_uniform(&rng) * sum) : (ptrdiff_t)(rng_uniform(&rng) * (double)pixels);
        double density = sum > 0 ? weights[at] / sum : 1 / (double)pixels; // of one place, per pixel
        double x = rng_uniform(&rng), y = rng_uniform(&rng);
        places[k] = (FitPlace){.x = (double)(at % width) + x,
                               .y = (double)(at / width) + y,
                               .spacing_px = sqrt(1 / (fmax(density, 1e-12) * count))};
    }
    mem_free(running);
}
