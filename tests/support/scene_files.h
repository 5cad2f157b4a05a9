// scene_files.h - the files of small scenes, good and broken, for the tests of the readers.
#ifndef SPLATLAB_TESTS_SUPPORT_SCENE_FILES_H
#define SPLATLAB_TESTS_SUPPORT_SCENE_FILES_H

#include "splat3d/dataset.h"

#include <stddef.h>

// A fresh folder of that name in the scratch folder; valid for the program's life.
const char *scene_folder(const char *name);

// Writes folder/name, without the sync to the disk that takes most of the time of a test with a thousand files.
void scene_write(const char *folder, const char *name, const void *data, size_t size);
void scene_write_text(const char *folder, const char *name, const char *text);

// A grey picture of that size; the folder within the name is made.
void scene_write_image(const char *folder, const char *name, int width, int height, int channels);

// A scene in memory of views "v00.png" ... on a circle, with their pictures in folder/images, and three points.
Dataset scene_make(const char *folder, int view_count, int width, int height);

// Opens, or fails the test with the message.
Dataset scene_open(const char *folder, int downscale);

// Fails the test unless opening fails with one line that holds both texts; `what` names the case.
void scene_refuses(const char *folder, const char *what, const char *first, const char *second);

#endif
