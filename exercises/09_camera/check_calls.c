// check_calls.c - how the functions of E09 are called; a camera comes as its 18 numbers in a row.
#include "exercises/calls.h"

int project(const Cam *c, const REAL p[3], REAL uv[2], REAL *z);
void project_jac(const Cam *c, const REAL t[3], REAL J[6]);

_Static_assert(sizeof(Cam) == 18 * sizeof(REAL), "a camera is 18 numbers without gaps");

static void call_project(REAL **a) { a[4][0] = (REAL)project((const Cam *)a[0], a[1], a[2], a[3]); }
static void call_project_jac(REAL **a) { project_jac((const Cam *)a[0], a[1], a[2]); }

const Call CALLS[] = {{"project", call_project}, {"project_jac", call_project_jac}, {0}};
