// image.c - the few operations on pixels that everything above shares.
#include "lab/base/image.h"

#include "lab/base/mem.h"

#include <assert.h>
#include <math.h>
#include <string.h>

Image8 image8_create(int width, int height, int channels) {
    assert(width >= 0 && height >= 0 && channels >= 1 && channels <= 4);
    return (Image8){width, height, channels, mem_alloc((size_t)width * (size_t)height, (size_t)channels)};
}

ImageF imagef_create(int width, int height, int channels) {
    assert(width >= 0 && height >= 0 && channels >= 1 && channels <= 4);
    size_t pixels = (size_t)width * (size_t)height;
    return (ImageF){width, height, channels, mem_alloc(pixels, (size_t)channels * sizeof(float))};
}

void image8_destroy(Image8 *image) {
    mem_free(image->bytes);
    *image = (Image8){0};
}

void imagef_destroy(ImageF *image) {
    mem_free(image->values);
    *image = (ImageF){0};
}

static uint8_t byte_of(float value) {
    if (!(value > 0)) return 0; // NaN too
    return value >= 1 ? 255 : (uint8_t)lroundf(255 * value);
}

Image8 image8_from_float(const ImageF *image) {
    Image8 out = image8_create(image->width, image->height, image->channels);
    size_t count = (size_t)image->width * (size_t)image->height * (size_t)image->channels;
    for (size_t i = 0; i < count; i++) out.bytes[i] = byte_of(image->values[i]);
    return out;
}

ImageF imagef_from_8(const Image8 *image) {
    ImageF out = imagef_create(image->width, image->height, image->channels);
    size_t count = (size_t)image->width * (size_t)image->height * (size_t)image->channels;
    for (size_t i = 0; i < count; i++) out.values[i] = (float)image->bytes[i] / 255.0f;
    return out;
}

ImageF imagef_over(const Image8 *image, const float background[3]) {
    assert(image->channels >= 3);
    ImageF out = imagef_create(image->width, image->height, 3);
    size_t pixels = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < pixels; i++) {
        const uint8_t *source = image->bytes + i * (size_t)image->channels;
        float alpha = image->channels == 4 ? (float)source[3] / 255.0f : 1.0f;
        for (int c = 0; c < 3; c++)
            out.values[3 * i + (size_t)c] = alpha * (float)source[c] / 255.0f + (1 - alpha) * background[c];
    }
    return out;
}

// The mean of one block of k x k pixels, written to target (channels). Sums are whole numbers, so the order does not matter.
static void average_block(const Image8 *image, int x0, int y0, int k, uint8_t *target) {
    uint64_t sum[4] = {0}; // colours times alpha, where there is alpha
    uint64_t alpha_sum = 0;
    uint64_t pixels = (uint64_t)k * (uint64_t)k;
    for (int y = y0; y < y0 + k; y++)
        for (int x = x0; x < x0 + k; x++) {
            const uint8_t *source =
                image->bytes + ((size_t)y * (size_t)image->width + (size_t)x) * (size_t)image->channels;
            uint64_t alpha = image->channels == 4 ? source[3] : 1;
            alpha_sum += alpha;
            for (int c = 0; c < image->channels && c < 3; c++) sum[c] += alpha * source[c];
        }
    for (int c = 0; c < image->channels && c < 3; c++)
        target[c] = alpha_sum == 0 ? 0 : (uint8_t)((sum[c] + alpha_sum / 2) / alpha_sum);
    if (image->channels == 4) target[3] = (uint8_t)((alpha_sum + pixels / 2) / pixels);
}

Image8 image8_downscale(const Image8 *image, int k) {
    assert(k >= 1);
    Image8 out = image8_create(image->width / k, image->height / k, image->channels);
    for (int y = 0; y < out.height; y++)
        for (int x = 0; x < out.width; x++) {
            size_t pixel = (size_t)y * (size_t)out.width + (size_t)x;
            average_block(image, x * k, y * k, k, out.bytes + pixel * (size_t)out.channels);
        }
    return out;
}

void imagef_paste(ImageF *target, const ImageF *source, int x, int y) {
    assert(target->channels == source->channels);
    long left = x, room = target->width - left; // long: x may be any int
    long first = left < 0 ? -left : 0;          // columns of source that fall on target: first .. end - 1
    long end = room < source->width ? room : source->width;
    if (first >= end) return;
    size_t channels = (size_t)source->channels;
    for (int row = 0; row < source->height; row++) {
        long line = (long)y + row;
        if (line < 0 || line >= target->height) continue;
        float *to = target->values + ((size_t)line * (size_t)target->width + (size_t)(left + first)) * channels;
        const float *from = source->values + ((size_t)row * (size_t)source->width + (size_t)first) * channels;
        memcpy(to, from, (size_t)(end - first) * channels * sizeof(float));
    }
}
