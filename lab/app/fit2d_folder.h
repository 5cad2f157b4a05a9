// fit2d_folder.h - what `splatlab fit2d` leaves in its folder.
//
//     fit.png          the picture that the blobs make
//     fit.json         the blobs, as a scene for `splatlab widget`
//     comparison.png   photograph and picture; below, where the blobs lie and the error, 4 times as large
//     fit.gif          how it came about, with --gif
#ifndef SPLATLAB_LAB_APP_FIT2D_FOLDER_H
#define SPLATLAB_LAB_APP_FIT2D_FOLDER_H

#include "lab/base/image.h"
#include "splat2d/scene2d.h"

#include <stdbool.h>

typedef struct {
    char *folder;
    char *picture, *scene, *comparison, *film;
} Fit2dFolder;

// Names them and makes the folder; what is in it already is replaced when the new is complete.
bool fit2d_folder_begin(const char *folder, Fit2dFolder *names);
void fit2d_folder_forget(Fit2dFolder *names); // frees the names; accepts a zeroed one

// All but the film. picture: what the blobs of the scene make, of the photograph's size.
bool fit2d_folder_save(const Fit2dFolder *names, const ImageF *photo, const ImageF *picture, const Scene2d *scene);

#endif
