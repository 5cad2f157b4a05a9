// fit_film.c - frames on a quadratic time line.
#include "lab/app/fit_film.h"

#include "lab/app/fit_photo.h"
#include "lab/io/image_io.h"

#include <assert.h>
#include <math.h>
#include <string.h>

enum { FRAME_MS = 80, LAST_FRAME_MS = 2000, REPEATS = LAST_FRAME_MS / FRAME_MS };

FitFilm fit_film_begin(int total) { return (FitFilm){.total = total}; }

void fit_film_destroy(FitFilm *film) {
    for (int i = 0; i < film->count; i++) image8_destroy(&film->frames[i]);
    *film = (FitFilm){0};
}

// Frame k shows step total (k / frames)^2.
static int frame_step(const FitFilm *film, int k) {
    double share = (double)k / FIT_FILM_FRAMES;
    return (int)(film->total * share * share);
}

bool fit_film_wants(const FitFilm *film, int step) {
    for (int k = 0; k <= FIT_FILM_FRAMES; k++)
        if (frame_step(film, k) == step) return film->count <= k;
    return false;
}

void fit_film_add(FitFilm *film, const ImageF *picture) {
    assert(film->count <= FIT_FILM_FRAMES);
    double factor = fmin(1, FIT_FILM_SIDE / fmax(picture->width, picture->height));
    ImageF frame = fit_photo_shrink(picture, (int)fmax(1, round(picture->width * factor)),
                                    (int)fmax(1, round(picture->height * factor)));
    film->frames[film->count++] = image8_from_float(&frame);
    imagef_destroy(&frame);
}

bool fit_film_save(const FitFilm *film, const char *path) {
    Image8 shown[FIT_FILM_FRAMES + 1 + REPEATS]; // borrowed frames
    memcpy(shown, film->frames, (size_t)film->count * sizeof *shown);
    int count = film->count;
    while (film->count > 0 && count < film->count + REPEATS) shown[count++] = film->frames[film->count - 1];
    return image_save_gif(path, shown, count, FRAME_MS);
}
