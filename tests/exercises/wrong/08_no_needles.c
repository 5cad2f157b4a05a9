// 08_no_needles.c - no scale may be less than a thousandth of the largest.
#include "exercises/exercise.h"

#define cov3 solution_cov3
#include "exercises/solutions/cov3.c"
#undef cov3

void cov3(const REAL q[4], const REAL logs[3], REAL S[6]) {
    REAL least = fmax(logs[0], fmax(logs[1], logs[2])) - log((REAL)1000);
    const REAL held[3] = {fmax(logs[0], least), fmax(logs[1], least), fmax(logs[2], least)};
    solution_cov3(q, held, S);
}
