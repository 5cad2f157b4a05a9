// check_calls.c - how the functions of E02 are called.
#include "exercises/calls.h"

int conic_from_cov2(const REAL S[3], REAL K[3]);
REAL mahal2(const REAL K[3], REAL dx, REAL dy);
void aabb_ksigma(const REAL S[3], REAL k, REAL half[2]);

static void call_conic_from_cov2(REAL **a) { a[2][0] = (REAL)conic_from_cov2(a[0], a[1]); }
static void call_mahal2(REAL **a) { a[3][0] = mahal2(a[0], a[1][0], a[2][0]); }
static void call_aabb_ksigma(REAL **a) { aabb_ksigma(a[0], a[1][0], a[2]); }

const Call CALLS[] = {
    {"conic_from_cov2", call_conic_from_cov2}, {"mahal2", call_mahal2}, {"aabb_ksigma", call_aabb_ksigma}, {0}};
