// log_taken_for_scale.c - logs are used as scales, without exp(): a scale of 0 or below then names no blob, which is why the logarithm is
// stored.
#include "exercises/exercise.h"

#define cov3 solution_cov3
#include "exercises/solutions/cov3.c"
#undef cov3

void cov3(const REAL q[4], const REAL logs[3], REAL S[6]) {
    const REAL wrong[3] = {log(fabs(logs[0])), log(fabs(logs[1])), log(fabs(logs[2]))};
    solution_cov3(q, wrong, S);
}
