// sh.c - E12: a splat's colour by the direction it is seen from (spherical harmonics). The task: README.md beside this file.
#include "exercises/exercise.h"

// rgb[c] = max(0, 0.5 + sum over i of Y_i(d / |d|) k[i][c]); clamped[c] is 1 where the sum lay below 0, and else 0.
// deg: 0..3, there are (deg + 1)^2 coefficients. d: from the camera to the splat, any length > 0.
void sh_color(int deg, const REAL d[3], const REAL (*k)[3], REAL rgb[3], int clamped[3]) {
    NOT_STARTED; // delete this line, and write rgb and clamped
    (void)deg, (void)d, (void)k, (void)rgb, (void)clamped;
}

// drgb: the gradient of a loss by rgb. dk, (deg + 1)^2 rows: by the coefficients; dd: by d as it came.
// clamped: as sh_color() wrote it.
void sh_color_vjp(int deg, const REAL d[3], const REAL (*k)[3], const int clamped[3], const REAL drgb[3], REAL (*dk)[3],
                  REAL dd[3]) {
    NOT_STARTED; // delete this line, and write dk and dd
    (void)deg, (void)d, (void)k, (void)clamped, (void)drgb, (void)dk, (void)dd;
}
