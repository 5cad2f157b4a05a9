// history.c - the list of scenes.
#include "lab/app/history.h"

#include <assert.h>
#include <string.h>

bool scene_equals(const Scene2d *a, const Scene2d *b) {
    static_assert(sizeof(Blob) == 10 * sizeof(double), "a blob is numbers without gaps, so that bytes can be compared");
    return a->width == b->width && a->height == b->height && a->count == b->count &&
           memcmp(a->background, b->background, sizeof a->background) == 0 &&
           (a->count == 0 || memcmp(a->blobs, b->blobs, (size_t)a->count * sizeof *a->blobs) == 0);
}

static void forget_from(History *history, int first) {
    for (int i = first; i < history->count; i++) scene2d_destroy(&history->steps[i].scene);
    history->count = first;
}

static void append(History *history, const Scene2d *scene, int active) {
    history->steps[history->count] = (HistoryStep){scene2d_copy(scene), active};
    history->present = history->count++;
}

void history_begin(History *history, const Scene2d *scene, int active) {
    *history = (History){0};
    append(history, scene, active);
}

void history_end(History *history) { forget_from(history, 0); }

void history_record(History *history, const Scene2d *scene, int active) {
    if (scene_equals(scene, &history->steps[history->present].scene)) return;
    forget_from(history, history->present + 1);
    if (history->count == HISTORY_STEPS_MAX) {
        scene2d_destroy(&history->steps[0].scene);
        memmove(&history->steps[0], &history->steps[1], (HISTORY_STEPS_MAX - 1) * sizeof history->steps[0]);
        history->count--;
    }
    append(history, scene, active);
}

static bool go_to(History *history, int step, Scene2d *scene, int *active) {
    if (step < 0 || step >= history->count) return false;
    history->present = step;
    scene2d_destroy(scene);
    *scene = scene2d_copy(&history->steps[step].scene);
    *active = history->steps[step].active;
    return true;
}

bool history_undo(History *history, Scene2d *scene, int *active) {
    return go_to(history, history->present - 1, scene, active);
}

bool history_redo(History *history, Scene2d *scene, int *active) {
    return go_to(history, history->present + 1, scene, active);
}
