// widget_film.h - an animated GIF of the window, at a fixed time from frame to frame.
#ifndef SPLATLAB_LAB_APP_WIDGET_FILM_H
#define SPLATLAB_LAB_APP_WIDGET_FILM_H

#include "lab/app/screen.h"
#include "lab/base/image.h"

#include <stdbool.h>

enum { FILM_FRAMES_MAX = 240 };

typedef struct {
    bool is_on;
    int count;
    Image8 *frames; // (count), owned
    double next_s;  // when the next frame is due
} WidgetFilm;

void widget_film_begin(WidgetFilm *film);
void widget_film_destroy(WidgetFilm *film); // accepts a zeroed one

// Keeps what the screen has just drawn, when it is time. False when the film must end: it is full, or the window has another
// size than before.
bool widget_film_keep(WidgetFilm *film, Screen *screen);

// Writes it and ends it; nothing is written when nothing was kept.
bool widget_film_save(WidgetFilm *film, const char *path);

#endif
