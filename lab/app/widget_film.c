// widget_film.c - frames by the clock.
#include "lab/app/widget_film.h"

#include "lab/base/clock.h"
#include "lab/base/mem.h"
#include "lab/io/image_io.h"

#include <math.h>

enum { FRAME_MS = 80, WIDTH_MAX = 800 /* px of a frame */ };

void widget_film_begin(WidgetFilm *film) {
    film->is_on = true;
    film->next_s = clock_seconds();
}

void widget_film_destroy(WidgetFilm *film) {
    for (int i = 0; i < film->count; i++) image8_destroy(&film->frames[i]);
    mem_free(film->frames);
    *film = (WidgetFilm){0};
}

bool widget_film_keep(WidgetFilm *film, Screen *screen) {
    Image8 frame = {0};
    double now_s = clock_seconds();
    if (!film->is_on || now_s < film->next_s) return true;
    if (!screen_read(screen, &frame)) return true;
    film->next_s = fmax(film->next_s + 1e-3 * FRAME_MS, now_s); // what was missed is missed
    if (!film->frames) film->frames = mem_alloc(FILM_FRAMES_MAX, sizeof *film->frames);
    int k = (frame.width + WIDTH_MAX - 1) / WIDTH_MAX;
    bool same =
        film->count == 0 || (film->frames[0].width == frame.width / k && film->frames[0].height == frame.height / k);
    if (same) film->frames[film->count++] = image8_downscale(&frame, k);
    image8_destroy(&frame);
    return same && film->count < FILM_FRAMES_MAX;
}

bool widget_film_save(WidgetFilm *film, const char *path) {
    bool good = film->count == 0 || image_save_gif(path, film->frames, film->count, FRAME_MS);
    widget_film_destroy(film);
    return good;
}
