// psd.c - E03, our solution.
#include "exercises/exercise.h"

// With K = S^-1 and u = K d: dK = -K dS K, so d(m^2) = d^T dK d = -u^T dS u, and dg = -g / 2 d(m^2) = g / 2 u^T dS u. The stored
// xy stands for two entries, and so its derivative is twice that of one.
void grad_raw(const REAL S[3], const Img *e, REAL g[3]) {
    REAL det = S[0] * S[2] - S[1] * S[1], K[3] = {S[2] / det, -S[1] / det, S[0] / det};
    g[0] = g[1] = g[2] = 0;
    for (int j = 0; j < e->height; j++)
        for (int i = 0; i < e->width; i++) {
            REAL dx = i + (REAL)0.5 - (REAL)e->width / 2, dy = j + (REAL)0.5 - (REAL)e->height / 2;
            REAL ux = K[0] * dx + K[1] * dy, uy = K[1] * dx + K[2] * dy;
            REAL half = e->values[j * e->width + i] * exp(-(ux * dx + uy * dy) / 2) / 2;
            g[0] += half * ux * ux;
            g[1] += half * ux * uy * 2;
            g[2] += half * uy * uy;
        }
}

// The chain rule: what S does when a factor moves, times what L does when S moves.
void grad_factored(REAL th, const REAL logs[2], const Img *e, REAL g[3]) {
    REAL c = cos(th), s = sin(th), x2 = exp(2 * logs[0]), y2 = exp(2 * logs[1]);
    REAL S[3] = {c * c * x2 + s * s * y2, c * s * (x2 - y2), s * s * x2 + c * c * y2}, dS[3];
    grad_raw(S, e, dS);
    g[0] = (x2 - y2) * (2 * c * s * (dS[2] - dS[0]) + (c * c - s * s) * dS[1]);
    g[1] = 2 * x2 * (c * c * dS[0] + c * s * dS[1] + s * s * dS[2]);
    g[2] = 2 * y2 * (s * s * dS[0] - c * s * dS[1] + c * c * dS[2]);
}

// S = A A^T with A = R diag(s): v^T S v = |A^T v|^2 cannot be below zero.
void cov3_from_factors(const REAL R[9], const REAL logs[3], REAL S[6]) {
    REAL A[9];
    for (int i = 0; i < 9; i++) A[i] = R[i] * exp(logs[i % 3]);
    for (int i = 0, at = 0; i < 3; i++)
        for (int j = i; j < 3; j++)
            S[at++] = A[3 * i] * A[3 * j] + A[3 * i + 1] * A[3 * j + 1] + A[3 * i + 2] * A[3 * j + 2];
}
