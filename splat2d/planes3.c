// planes3.c - where a plane's rows stand.
#include "splat2d/planes3.h"

#include "lab/base/mem.h"
#include "splat2d/lanes.h"

#include <assert.h>

enum { CHANNELS = PLANES3_CHANNELS, MARGIN = PLANES3_MARGIN };

Planes3 planes3_create(int width, int height) {
    Planes3 planes = {.width = width, .height = height};
    planes.stride = 2 * MARGIN + (width + LANES - 1) / LANES * LANES;
    planes.floats = mem_alloc((size_t)(planes.stride * (height + 2 * MARGIN)) * CHANNELS, sizeof(float));
    return planes;
}

void planes3_destroy(Planes3 *planes) {
    mem_free(planes->floats);
    *planes = (Planes3){0};
}

float *planes3_row(const Planes3 *planes, int channel, int row) {
    ptrdiff_t rows = planes->height + 2 * MARGIN;
    return planes->floats + (channel * rows + MARGIN + row) * planes->stride + MARGIN;
}

int planes3_lanes_width(const Planes3 *planes) { return (int)planes->stride - 2 * MARGIN; }

void planes3_clear_margin(const Planes3 *planes, int channel, int row) {
    float *values = planes3_row(planes, channel, row);
    for (int x = planes->width; x < planes3_lanes_width(planes); x++) values[x] = 0;
}

void planes3_from_image(const Planes3 *planes, const ImageF *image) {
    assert(image->channels == CHANNELS && image->width == planes->width && image->height == planes->height);
    for (int c = 0; c < CHANNELS; c++)
        for (int y = 0; y < planes->height; y++) {
            const float *from = image->values + (ptrdiff_t)y * planes->width * CHANNELS + c;
            float *to = planes3_row(planes, c, y);
            for (int x = 0; x < planes->width; x++) to[x] = from[x * CHANNELS];
        }
}

void planes3_to_image(const Planes3 *planes, ImageF *image) {
    assert(image->channels == CHANNELS && image->width == planes->width && image->height == planes->height);
    for (int c = 0; c < CHANNELS; c++)
        for (int y = 0; y < planes->height; y++) {
            float *to = image->values + (ptrdiff_t)y * planes->width * CHANNELS + c;
            const float *from = planes3_row(planes, c, y);
            for (int x = 0; x < planes->width; x++) to[x * CHANNELS] = from[x];
        }
}
