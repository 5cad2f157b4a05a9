// not_squared.c - the distance itself is returned, where its square is asked for: exp(-m^2 / 2) needs no root.
#define mahal2 solution_mahal2
#include "exercises/solutions/conic.c"
#undef mahal2

REAL mahal2(const REAL K[3], REAL dx, REAL dy) { return sqrt(K[0] * dx * dx + 2 * K[1] * dx * dy + K[2] * dy * dy); }
