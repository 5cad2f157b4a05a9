// scale_not_squared.c - exp(logs) stands in S: that is a standard deviation, and a variance is its square, exp(2 logs).
#include "exercises/exercise.h"

#define cov3 solution_cov3
#include "exercises/solutions/cov3.c"
#undef cov3

void cov3(const REAL q[4], const REAL logs[3], REAL S[6]) {
    const REAL halves[3] = {logs[0] / 2, logs[1] / 2, logs[2] / 2};
    solution_cov3(q, halves, S);
}
