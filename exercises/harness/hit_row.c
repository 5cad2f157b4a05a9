// hit_row.c - lists of one length for all pixels of a row, so that one request takes many of them.
#include "exercises/harness/hit_row.h"

#include "lab/base/mem.h"

#include <string.h>

enum { NUMBERS = 4 };

static void make_room(HitRow *row, int capacity) {
    double *hits = mem_alloc((size_t)row->pixels * (size_t)capacity * NUMBERS, sizeof *hits);
    for (int x = 0; x < row->pixels && row->hits; x++)
        memcpy(hits + (size_t)x * (size_t)capacity * NUMBERS, row->hits + (size_t)x * (size_t)row->capacity * NUMBERS,
               (size_t)row->count[x] * NUMBERS * sizeof *hits);
    mem_free(row->hits);
    row->hits = hits;
    row->capacity = capacity;
}

void hit_row_begin(HitRow *row, int pixels) {
    if (row->pixels != pixels) {
        hit_row_end(row);
        row->pixels = pixels;
        row->count = mem_alloc((size_t)pixels, sizeof *row->count);
        make_room(row, 8);
    }
    memset(row->count, 0, (size_t)pixels * sizeof *row->count);
}

void hit_row_end(HitRow *row) {
    mem_free(row->count);
    mem_free(row->hits);
    *row = (HitRow){0};
}

void hit_row_add(HitRow *row, int x, double alpha, const double rgb[3]) {
    if (row->count[x] == row->capacity) make_room(row, 2 * row->capacity);
    double *hit = row->hits + ((size_t)x * (size_t)row->capacity + (size_t)row->count[x]++) * NUMBERS;
    hit[0] = alpha;
    memcpy(hit + 1, rgb, 3 * sizeof *rgb);
}

static void composite_reference(const HitRow *row, int x, const CompositeRule *rule, const double background[3],
                                double *rgb, double *transmittance) {
    const double *hit = row->hits + (size_t)x * (size_t)row->capacity * NUMBERS;
    Composite pixel = composite_begin();
    for (int i = 0; i < row->count[x]; i++, hit += NUMBERS) composite_blend(&pixel, rule, hit[0], hit + 1);
    composite_end(&pixel, background);
    memcpy(rgb, pixel.rgb, sizeof pixel.rgb);
    *transmittance = pixel.transmittance;
}

// Pixels x..x+sets-1 by E04.
static bool composite_mine(const HitRow *row, Mine *mine, int x, int sets, const CompositeRule *rule,
                           const double background[3], double *rgb, double *transmittance) {
    double *n = mem_alloc((size_t)sets * 6, sizeof *n), *Tmin = n + sets, *bg = n + 2 * sets, *returned = n + 5 * sets;
    for (int i = 0; i < sets; i++) {
        n[i] = row->count[x + i];
        Tmin[i] = rule->stop;
        memcpy(bg + 3 * i, background, 3 * sizeof *bg);
    }
    double *h = row->hits + (size_t)x * (size_t)row->capacity * NUMBERS;
    const Arg args[] = {ARG_IN("h", h, row->capacity * NUMBERS),
                        ARG_IN("n", n, 1),
                        ARG_IN("Tmin", Tmin, 1),
                        ARG_IN("bg", bg, 3),
                        ARG_OUT("out", rgb, 3),
                        ARG_OUT("Tend", transmittance, 1),
                        ARG_OUT("returned", returned, 1)};
    bool good = mine_call(mine, MINE_COMPOSITE, "composite", args, sizeof args / sizeof *args, sets);
    mem_free(n);
    return good;
}

void hit_row_composite(const HitRow *row, Mine *mine, const CompositeRule *rule, const double background[3],
                       double *rgb, double *transmittance) {
    int at_once = mine_sets(row->capacity * NUMBERS);
    for (int x = 0; x < row->pixels; x += at_once) {
        int sets = row->pixels - x < at_once ? row->pixels - x : at_once;
        if (composite_mine(row, mine, x, sets, rule, background, rgb + 3 * x, transmittance + x)) continue;
        for (int i = x; i < x + sets; i++)
            composite_reference(row, i, rule, background, rgb + 3 * i, transmittance + i);
    }
}
