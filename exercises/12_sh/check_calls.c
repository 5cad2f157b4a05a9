// check_calls.c - how the functions of E12 are called. Whole numbers go as REAL; three numbers are one coefficient.
#include "exercises/calls.h"

void sh_color(int deg, const REAL d[3], const REAL (*k)[3], REAL rgb[3], int clamped[3]);
void sh_color_vjp(int deg, const REAL d[3], const REAL (*k)[3], const int clamped[3], const REAL drgb[3], REAL (*dk)[3],
                  REAL dd[3]);

// A flag that was not written stays NaN: -2147483647 is nobody's answer.
static void call_sh_color(REAL **a) {
    enum { UNWRITTEN = -2147483647 };
    int flags[3] = {UNWRITTEN, UNWRITTEN, UNWRITTEN};
    sh_color((int)a[0][0], a[1], (const REAL(*)[3])a[2], a[3], flags);
    for (int c = 0; c < 3; c++)
        if (flags[c] != UNWRITTEN) a[4][c] = (REAL)flags[c];
}

static void call_sh_color_vjp(REAL **a) {
    int flags[3] = {a[3][0] != 0, a[3][1] != 0, a[3][2] != 0};
    sh_color_vjp((int)a[0][0], a[1], (const REAL(*)[3])a[2], flags, a[4], (REAL(*)[3])a[5], a[6]);
}

const Call CALLS[] = {{"sh_color", call_sh_color}, {"sh_color_vjp", call_sh_color_vjp}, {0}};
