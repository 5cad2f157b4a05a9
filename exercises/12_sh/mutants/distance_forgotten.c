// distance_forgotten.c - the gradient by d is not divided by |d|: the same step turns a far splat's direction less than a near
// one's.
#define sh_color_vjp solution_sh_color_vjp
#include "exercises/solutions/sh.c"
#undef sh_color_vjp

void sh_color_vjp(int deg, const REAL d[3], const REAL (*k)[3], const int clamped[3], const REAL drgb[3], REAL (*dk)[3],
                  REAL dd[3]) {
    solution_sh_color_vjp(deg, d, k, clamped, drgb, dk, dd);
    REAL r = length_of(d);
    for (int axis = 0; axis < 3; axis++) dd[axis] *= r;
}
