// turned_backwards.c - the gradient by theta has the wrong sign, as from R^T diag R: the blob turns away from the
// photograph.
#define grad_factored solution_grad_factored
#include "exercises/solutions/psd.c"
#undef grad_factored

void grad_factored(REAL th, const REAL logs[2], const Img *e, REAL g[3]) {
    REAL c = cos(th), s = sin(th), x2 = exp(2 * logs[0]), y2 = exp(2 * logs[1]);
    REAL S[3] = {c * c * x2 + s * s * y2, c * s * (x2 - y2), s * s * x2 + c * c * y2}, dS[3];
    grad_raw(S, e, dS);
    g[0] = (y2 - x2) * (2 * c * s * (dS[2] - dS[0]) + (c * c - s * s) * dS[1]);
    g[1] = 2 * x2 * (c * c * dS[0] + c * s * dS[1] + s * s * dS[2]);
    g[2] = 2 * y2 * (s * s * dS[0] - c * s * dS[1] + c * c * dS[2]);
}
