// popping.c - E05: the order of splats, and how far a pixel jumps when two change places. The task: README.md beside this file.
#include "exercises/exercise.h"

// How far a pixel's colour jumps when two neighbours in its list change places: the length of the difference of r, g, b.
// a1, a2: their alphas; c1, c2: their colours; T: what is left of the light in front of both.
REAL pop_delta(REAL a1, REAL a2, const REAL c1[3], const REAL c2[3], REAL T) {
    NOT_STARTED; // delete this line, and return the jump
    (void)a1, (void)a2, (void)c1, (void)c2, (void)T;
    return 0;
}

// idx[0], idx[1], ...: the indices of the splats in front of the camera (z > 0 in its axes), nearest first by that z; equal ones
// by index. mu: n means in the world. Returns how many there are; the rest of idx stays as it is.
int order_by_depth(const Cam *c, const REAL (*mu)[3], int n, unsigned *idx) {
    NOT_STARTED; // delete this line, and write idx[0] ...
    (void)c, (void)mu, (void)n, (void)idx;
    return 0;
}
