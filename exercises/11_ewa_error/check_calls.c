// check_calls.c - how the functions of E11 are called. The record Cam goes as its 18 numbers, whole numbers as REAL.
#include "exercises/calls.h"

void mc_project(const Cam *c, const REAL mu[3], const REAL S3[6], int n, unsigned long seed, REAL mean[2], REAL cov[3]);
void ewa_error(const REAL mean[2], const REAL cov[3], const REAL centre[2], const REAL S2[3], REAL *shift,
               REAL *relative);

_Static_assert(sizeof(Cam) == 18 * sizeof(REAL), "a Cam is its 18 numbers");

static void call_mc_project(REAL **a) {
    mc_project((const Cam *)a[0], a[1], a[2], (int)a[3][0], (unsigned long)a[4][0], a[5], a[6]);
}

static void call_ewa_error(REAL **a) { ewa_error(a[0], a[1], a[2], a[3], a[4], a[5]); }

const Call CALLS[] = {{"mc_project", call_mc_project}, {"ewa_error", call_ewa_error}, {0}};
