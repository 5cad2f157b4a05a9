// fit_photo.c - loading and shrinking.
#include "lab/app/fit_photo.h"

#include "lab/base/fail.h"
#include "lab/io/image_io.h"
#include "splat2d/scene2d.h"

#include <assert.h>
#include <math.h>
#include <stddef.h>

// Target pixel i of `count` covers the source from i * source / count to (i + 1) * source / count; how much of pixel k of it?
static double overlap(int k, double from, double to) { return fmin(k + 1, to) - fmax(k, from); }

static void average(const ImageF *source, double left, double right, double top, double bottom, float rgb[3]) {
    double sum[3] = {0};
    for (int y = (int)top; y < bottom && y < source->height; y++)
        for (int x = (int)left; x < right && x < source->width; x++) {
            double area = overlap(x, left, right) * overlap(y, top, bottom);
            const float *value = source->values + ((ptrdiff_t)y * source->width + x) * 3;
            for (int c = 0; c < 3; c++) sum[c] += area * (double)value[c];
        }
    for (int c = 0; c < 3; c++) rgb[c] = (float)(sum[c] / ((right - left) * (bottom - top)));
}

ImageF fit_photo_shrink(const ImageF *source, int width, int height) {
    assert(source->channels == 3 && width <= source->width && height <= source->height);
    ImageF target = imagef_create(width, height, 3);
    double step_x = (double)source->width / width, step_y = (double)source->height / height;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            average(source, x * step_x, (x + 1) * step_x, y * step_y, (y + 1) * step_y,
                    target.values + ((ptrdiff_t)y * width + x) * 3);
    return target;
}

static void shrink_into(ImageF *photo, int width, int height) {
    double factor = fmin((double)width / photo->width, (double)height / photo->height);
    if (factor >= 1) return;
    ImageF smaller = fit_photo_shrink(photo, (int)fmax(1, round(photo->width * factor)),
                                      (int)fmax(1, round(photo->height * factor)));
    imagef_destroy(photo);
    *photo = smaller;
}

bool fit_photo_load(const char *path, int downscale, int width, int height, ImageF *photo) {
    const float white[3] = {1, 1, 1};
    Image8 file;
    *photo = (ImageF){0};
    if (!image_load8(path, &file)) return false;
    if (file.width < downscale || file.height < downscale) {
        fail("%s: at 1/%d of %d x %d px nothing is left", path, downscale, file.width, file.height);
        image8_destroy(&file);
        return false;
    }
    Image8 small = image8_downscale(&file, downscale);
    *photo = imagef_over(&small, white);
    image8_destroy(&small);
    image8_destroy(&file);
    if (width > 0) shrink_into(photo, width, height);
    if (photo->width <= SCENE2D_SIDE_MAX && photo->height <= SCENE2D_SIDE_MAX) return true;
    fail("%s: %d x %d px are too many for a fit, at most %d each; add --size 1000x1000", path, photo->width,
         photo->height, SCENE2D_SIDE_MAX);
    imagef_destroy(photo);
    return false;
}
