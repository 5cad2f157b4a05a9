// turned_backwards.c - R^T diag R in place of R diag R^T: the blob's axes then are the rows of R, and it turns the other way.
#include "exercises/exercise.h"

#define cov3 solution_cov3
#include "exercises/solutions/cov3.c"
#undef cov3

void cov3(const REAL q[4], const REAL logs[3], REAL S[6]) {
    const REAL backwards[4] = {q[0], -q[1], -q[2], -q[3]};
    solution_cov3(backwards, logs, S);
}
