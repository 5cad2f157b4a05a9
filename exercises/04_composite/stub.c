// composite.c - E04: what a pixel sees of a sorted list of splats. The task: README.md beside this file.
#include "exercises/exercise.h"

// C = sum_i T_i alpha_i c_i + T_end bg, with T_i the product of (1 - alpha_j) over all j < i.
// h: n hits, front to back. An alpha above 0.99 counts as 0.99; one below 1/255 is skipped. A hit is blended as long as
// T >= Tmin before it. out: the colour; *Tend: the transmittance that is left. Returns how many hits were looked at.
int composite(const Hit *h, int n, REAL Tmin, const REAL bg[3], REAL out[3], REAL *Tend) {
    NOT_STARTED; // delete this line, and write out[0], out[1], out[2] and *Tend
    (void)h, (void)n, (void)Tmin, (void)bg, (void)out, (void)Tend;
    return 0;
}
