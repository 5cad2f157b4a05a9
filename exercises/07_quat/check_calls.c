// check_calls.c - how the functions of E07 are called.
#include "exercises/calls.h"

void quat_to_R(const REAL q[4], REAL R[9]);
void quat_to_R_vjp(const REAL q[4], const REAL dR[9], REAL dq[4]);

static void call_quat_to_R(REAL **a) { quat_to_R(a[0], a[1]); }
static void call_quat_to_R_vjp(REAL **a) { quat_to_R_vjp(a[0], a[1], a[2]); }

const Call CALLS[] = {{"quat_to_R", call_quat_to_R}, {"quat_to_R_vjp", call_quat_to_R_vjp}, {0}};
