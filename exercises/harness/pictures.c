// pictures.c - three files; the difference is |yours - reference|, eight times as bright.
#include "exercises/harness/pictures.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/image_io.h"

#include <math.h>
#include <stddef.h>

static const float DIFFERENCE_GAIN = 8;

char *pictures_path(const char *root, const Exercise *exercise, PictureKind kind) {
    static const char *const NAMES[PICTURE_COUNT] = {"yours.png", "reference.png", "difference.png"};
    return exercise_path(root, exercise, NAMES[kind]);
}

static ImageF difference_of(const ImageF *yours, const ImageF *reference) {
    ImageF d = imagef_create(yours->width, yours->height, yours->channels);
    size_t count = (size_t)yours->width * (size_t)yours->height * (size_t)yours->channels;
    for (size_t i = 0; i < count; i++) {
        float off = fabsf(yours->values[i] - reference->values[i]) * DIFFERENCE_GAIN;
        d.values[i] = isnan(off) ? 1 : off;
    }
    return d;
}

bool pictures_write(const char *root, const Exercise *exercise, const Rung *rung, const RungResult *result,
                    Subject *subject) {
    ImageF images[PICTURE_COUNT] = {{0}};
    bool good = rung->picture(subject, result->in, &images[PICTURE_YOURS], &images[PICTURE_REFERENCE]);
    if (good) images[PICTURE_DIFFERENCE] = difference_of(&images[PICTURE_YOURS], &images[PICTURE_REFERENCE]);
    for (int k = 0; k < PICTURE_COUNT; k++) {
        char *path = pictures_path(root, exercise, (PictureKind)k);
        good = good && image_savef(path, &images[k]);
        mem_free(path);
        imagef_destroy(&images[k]);
    }
    return good;
}
