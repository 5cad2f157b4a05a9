// check_calls.c - how the functions of E08 are called.
#include "exercises/calls.h"

void cov3(const REAL q[4], const REAL logs[3], REAL S[6]);
void cov3_vjp(const REAL q[4], const REAL logs[3], const REAL dS[6], REAL dq[4], REAL dlogs[3]);

static void call_cov3(REAL **a) { cov3(a[0], a[1], a[2]); }
static void call_cov3_vjp(REAL **a) { cov3_vjp(a[0], a[1], a[2], a[3], a[4]); }

const Call CALLS[] = {{"cov3", call_cov3}, {"cov3_vjp", call_cov3_vjp}, {0}};
