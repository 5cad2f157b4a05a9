// pictures.h - a wrong answer as pictures: yours, the reference, and their difference, as PNG files beside the answer.
#ifndef SPLATLAB_EXERCISES_HARNESS_PICTURES_H
#define SPLATLAB_EXERCISES_HARNESS_PICTURES_H

#include "exercises/harness/catalogue.h"

typedef enum { PICTURE_YOURS, PICTURE_REFERENCE, PICTURE_DIFFERENCE, PICTURE_COUNT } PictureKind;

// "yours.png" and so on in the exercise's folder; owned by the caller.
char *pictures_path(const char *root, const Exercise *exercise, PictureKind kind);

// Draws the rung's failed case. False (nothing written) when the answer does not come back, or with a message when a file cannot be
// written.
bool pictures_write(const char *root, const Exercise *exercise, const Rung *rung, const RungResult *result,
                    Subject *subject);

#endif
