// lifted_diagonal.c - something small is added to the diagonal so that S stays positive: M M^T is so by construction, and a
// small blob is drawn too large.
#include "exercises/exercise.h"

#define cov3 solution_cov3
#include "exercises/solutions/cov3.c"
#undef cov3

void cov3(const REAL q[4], const REAL logs[3], REAL S[6]) {
    solution_cov3(q, logs, S);
    S[0] += (REAL)1e-6, S[3] += (REAL)1e-6, S[5] += (REAL)1e-6;
}
