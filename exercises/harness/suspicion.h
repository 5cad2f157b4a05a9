// suspicion.h - which known mistake an answer makes: its numbers are compared with those of the wrong variants.
#ifndef SPLATLAB_EXERCISES_HARNESS_SUSPICION_H
#define SPLATLAB_EXERCISES_HARNESS_SUSPICION_H

#include "exercises/harness/catalogue.h"

enum { SUSPICION_BYTES = 400, SUSPICION_NAME_BYTES = 64 };

typedef struct {
    bool found;
    char name[SUSPICION_NAME_BYTES]; // "scale_is_variance": the variant's file without its ending
    char text[SUSPICION_BYTES];      // its first comment
    int matched, cases; // of the cases in which the answer differs from ours, in so many it gives the variant's numbers
} Suspicion;

// subject: the answer, which failed that rung in that precision.
bool suspicion_find(const char *root, const Exercise *exercise, const Rung *rung, Precision precision, Subject *subject,
                    Suspicion *suspicion);

// What a variant's file says of itself: "// NAME.c - TEXT", up to the end of that comment.
bool suspicion_describe(const char *path, char name[SUSPICION_NAME_BYTES], char text[SUSPICION_BYTES]);

#endif
