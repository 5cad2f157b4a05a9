// check_calls.c - how the functions of E03 are called: an Img is put together from its numbers.
#include "exercises/calls.h"

void grad_raw(const REAL S[3], const Img *e, REAL g[3]);
void grad_factored(REAL th, const REAL logs[2], const Img *e, REAL g[3]);
void cov3_from_factors(const REAL R[9], const REAL logs[3], REAL S[6]);

static Img img_of(REAL **a) { return (Img){.width = (int)a[0][0], .height = (int)a[1][0], .values = a[2]}; }

static void call_grad_raw(REAL **a) {
    Img e = img_of(a + 1);
    grad_raw(a[0], &e, a[4]);
}

static void call_grad_factored(REAL **a) {
    Img e = img_of(a + 2);
    grad_factored(a[0][0], a[1], &e, a[5]);
}

static void call_cov3_from_factors(REAL **a) { cov3_from_factors(a[0], a[1], a[2]); }

const Call CALLS[] = {{"grad_raw", call_grad_raw},
                      {"grad_factored", call_grad_factored},
                      {"cov3_from_factors", call_cov3_from_factors},
                      {0}};
