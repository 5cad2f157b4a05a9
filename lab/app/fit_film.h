// fit_film.h - a film of a fit: which steps to keep, small frames of them, and an animated GIF.
#ifndef SPLATLAB_LAB_APP_FIT_FILM_H
#define SPLATLAB_LAB_APP_FIT_FILM_H

#include "lab/base/image.h"

#include <stdbool.h>

enum { FIT_FILM_FRAMES = 60, FIT_FILM_SIDE = 400 /* px of a frame, at most */ };

typedef struct {
    int total; // steps that there will be
    int count; // frames so far
    Image8 frames[FIT_FILM_FRAMES + 1];
} FitFilm;

FitFilm fit_film_begin(int total);
void fit_film_destroy(FitFilm *film); // accepts a zeroed one

// Is the picture behind `step` steps (0 is the start) to be kept? The first steps more densely: there most happens.
bool fit_film_wants(const FitFilm *film, int step);
void fit_film_add(FitFilm *film, const ImageF *picture); // 3 channels, always of one size

// The GIF; its last frame stands for two seconds.
bool fit_film_save(const FitFilm *film, const char *path);

#endif
