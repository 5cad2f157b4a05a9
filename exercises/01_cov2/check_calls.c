// check_calls.c - how the functions of E01 are called.
#include "exercises/calls.h"

void cov2_from_rs(REAL theta, REAL sx, REAL sy, REAL S[3]);

static void call_cov2_from_rs(REAL **a) { cov2_from_rs(a[0][0], a[1][0], a[2][0], a[3]); }

const Call CALLS[] = {{"cov2_from_rs", call_cov2_from_rs}, {0}};
