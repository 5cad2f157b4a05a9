// hit_row.h - what each pixel of a row meets, front to back, and the colour that comes of it: by E04 or by the reference.
#ifndef SPLATLAB_EXERCISES_HARNESS_HIT_ROW_H
#define SPLATLAB_EXERCISES_HARNESS_HIT_ROW_H

#include "exercises/harness/mine.h"
#include "splat2d/compositing.h"

typedef struct {
    int pixels, capacity; // hits a pixel has room for
    int *count;           // (pixels), owned
    double *hits;         // (pixels, capacity, 4): alpha r g b; owned
} HitRow;

void hit_row_begin(HitRow *row, int pixels); // empties it; a zeroed one is new
void hit_row_end(HitRow *row);
void hit_row_add(HitRow *row, int x, double alpha, const double rgb[3]); // behind what pixel x has

// rgb: (pixels, 3); transmittance: (pixels), T behind the last. rule: the reference's; E04 has the same but for `stop`, which it is given.
void hit_row_composite(const HitRow *row, Mine *mine, const CompositeRule *rule, const double background[3],
                       double *rgb, double *transmittance);

#endif
