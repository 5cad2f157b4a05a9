// diagonal_first.c - S is stored as xx yy zz xy xz yz; here the order is that of the rows of the upper triangle, xx xy xz yy yz zz.
#include "exercises/exercise.h"

#define cov3 solution_cov3
#include "exercises/solutions/cov3.c"
#undef cov3

void cov3(const REAL q[4], const REAL logs[3], REAL S[6]) {
    REAL s[6];
    solution_cov3(q, logs, s);
    S[0] = s[0], S[1] = s[3], S[2] = s[5], S[3] = s[1], S[4] = s[2], S[5] = s[4];
}
