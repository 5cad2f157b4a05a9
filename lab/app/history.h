// history.h - undo and redo of a scene: a list of whole scenes, of which one is the present.
//
// Scenes are small, so a step is a copy; nothing can be forgotten in it, and undo gives back the same bytes.
#ifndef SPLATLAB_LAB_APP_HISTORY_H
#define SPLATLAB_LAB_APP_HISTORY_H

#include "splat2d/scene2d.h"

enum { HISTORY_STEPS_MAX = 256 }; // older ones are dropped

typedef struct {
    Scene2d scene;
    int active; // the chosen blob, -1: none
} HistoryStep;

typedef struct {
    HistoryStep steps[HISTORY_STEPS_MAX];
    int count, present;
} History;

void history_begin(History *history, const Scene2d *scene, int active);
void history_end(History *history); // accepts a zeroed one

// The scene as it is now becomes a step, and what was undone is forgotten. Does nothing when it is the present already.
void history_record(History *history, const Scene2d *scene, int active);

// One step back or forth: *scene (owned by the caller, replaced) and *active; false when there is none.
bool history_undo(History *history, Scene2d *scene, int *active);
bool history_redo(History *history, Scene2d *scene, int *active);

// Do both hold the same numbers?
bool scene_equals(const Scene2d *a, const Scene2d *b);

#endif
