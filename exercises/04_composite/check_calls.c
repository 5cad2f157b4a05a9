// check_calls.c - how the function of E04 is called: a Hit is four numbers, alpha r g b.
#include "exercises/calls.h"

_Static_assert(sizeof(Hit) == 4 * sizeof(REAL), "hits come as an array of numbers");

int composite(const Hit *h, int n, REAL Tmin, const REAL bg[3], REAL out[3], REAL *Tend);

static void call_composite(REAL **a) {
    a[6][0] = (REAL)composite((const Hit *)a[0], (int)a[1][0], a[2][0], a[3], a[4], a[5]);
}

const Call CALLS[] = {{"composite", call_composite}, {0}};
