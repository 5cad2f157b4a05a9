// check_calls.c - how the functions of E10 are called. The record Cam goes as its 18 numbers.
#include "exercises/calls.h"

void cov2_project(const Cam *c, const REAL t[3], const REAL S3[6], REAL S2[3]);
void cov2_project_vjp(const Cam *c, const REAL t[3], const REAL S3[6], const REAL dS2[3], REAL dt[3]);

_Static_assert(sizeof(Cam) == 18 * sizeof(REAL), "a Cam is its 18 numbers");

static void call_cov2_project(REAL **a) { cov2_project((const Cam *)a[0], a[1], a[2], a[3]); }

static void call_cov2_project_vjp(REAL **a) { cov2_project_vjp((const Cam *)a[0], a[1], a[2], a[3], a[4]); }

const Call CALLS[] = {{"cov2_project", call_cov2_project}, {"cov2_project_vjp", call_cov2_project_vjp}, {0}};
