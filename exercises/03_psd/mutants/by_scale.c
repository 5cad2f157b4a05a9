// by_scale.c - the derivative is by the scale, not by its logarithm: d/d(ln s) = s d/ds.
#define grad_factored solution_grad_factored
#include "exercises/solutions/psd.c"
#undef grad_factored

void grad_factored(REAL th, const REAL logs[2], const Img *e, REAL g[3]) {
    REAL c = cos(th), s = sin(th), x2 = exp(2 * logs[0]), y2 = exp(2 * logs[1]);
    REAL S[3] = {c * c * x2 + s * s * y2, c * s * (x2 - y2), s * s * x2 + c * c * y2}, dS[3];
    grad_raw(S, e, dS);
    g[0] = (x2 - y2) * (2 * c * s * (dS[2] - dS[0]) + (c * c - s * s) * dS[1]);
    g[1] = 2 * sqrt(x2) * (c * c * dS[0] + c * s * dS[1] + s * s * dS[2]);
    g[2] = 2 * sqrt(y2) * (s * s * dS[0] - c * s * dS[1] + c * c * dS[2]);
}
