// mine.h - a person's own functions in the lab: those of the exercises that pass, in place of the reference's.
//
//     Mine *mine = mine_open();
//     if (!mine_call(mine, MINE_COV2, "cov2_from_rs", args, count, sets)) { ... the reference computes it ... }
//
// The functions run in worker processes (subject.h): one that crashes or loops is put aside with mine_state() telling why, until its
// file changes.
#ifndef SPLATLAB_EXERCISES_HARNESS_MINE_H
#define SPLATLAB_EXERCISES_HARNESS_MINE_H

#include "exercises/harness/subject.h"

typedef struct Mine Mine;

// The exercises whose functions the lab can use, in the order of a picture's making.
typedef enum {
    MINE_COV2,
    MINE_CONIC,
    MINE_POPPING,
    MINE_COMPOSITE,
    MINE_PLANE_COUNT, // those above are all that a picture in the plane needs
    MINE_COV3 = MINE_PLANE_COUNT,
    MINE_CAMERA,
    MINE_EWA,
    MINE_SH,
    MINE_COUNT
} MinePart;

enum { MINE_STATE_BYTES = 480 };

// Judges the exercises whose functions the lab can use. NULL with a message when the exercises or the worker are not there.
Mine *mine_open(void);
void mine_close(Mine *mine); // accepts NULL

// Judges anew what was saved since; true when anything was.
bool mine_refresh(Mine *mine);

// Calls a function of that exercise for all sets. False: it does not pass (yet), or just broke, and the reference has to do it.
bool mine_call(Mine *mine, MinePart part, const char *function, const Arg *args, int count, int sets);

bool mine_is_used(const Mine *mine, MinePart part);

// What it contributes: "E01 cov2: yours" or "E04 composite: the reference (rung 3 of 8 fails)".
void mine_state(const Mine *mine, MinePart part, char text[MINE_STATE_BYTES]);

// Sets in a call that take some 10 ms, when each has so many numbers.
int mine_sets(int numbers);

#endif
