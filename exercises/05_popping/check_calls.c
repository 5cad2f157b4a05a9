// check_calls.c - how the functions of E05 are called. A Cam is 18 numbers in a row, a mean three; indices come back as numbers.
#include "exercises/calls.h"

#include <stdlib.h>

_Static_assert(sizeof(Cam) == 18 * sizeof(REAL), "a camera comes as an array of numbers");

REAL pop_delta(REAL a1, REAL a2, const REAL c1[3], const REAL c2[3], REAL T);
int order_by_depth(const Cam *c, const REAL (*mu)[3], int n, unsigned *idx);

static void call_pop_delta(REAL **a) { a[5][0] = pop_delta(a[0][0], a[1][0], a[2], a[3], a[4][0]); }

// The indices are handed over in a buffer with room on both sides. What was written to it is copied, also beside the n that are
// allowed: there the harness has its guard words, and sees it.
enum { ROOM = 16 };
static const unsigned UNWRITTEN = 0xdeadbeefU;

static void call_order_by_depth(REAL **a) {
    int n = (int)a[2][0];
    unsigned *buffer = malloc(((size_t)n + 2 * ROOM) * sizeof *buffer);
    if (!buffer) abort();
    for (int i = 0; i < n + 2 * ROOM; i++) buffer[i] = UNWRITTEN;
    a[4][0] = (REAL)order_by_depth((const Cam *)a[0], (const REAL(*)[3])a[1], n, buffer + ROOM);
    for (int i = -ROOM; i < n + ROOM; i++)
        if (buffer[ROOM + i] != UNWRITTEN) a[3][i] = (REAL)buffer[ROOM + i];
    free(buffer);
}

const Call CALLS[] = {{"pop_delta", call_pop_delta}, {"order_by_depth", call_order_by_depth}, {0}};
