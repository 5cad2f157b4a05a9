// psd.c - E03: which numbers of a covariance to learn. The task: README.md beside this file.
#include "exercises/exercise.h"

// A blob g = exp(-m^2 / 2) stands in the middle of a picture, (width / 2, height / 2); e holds dL/dg of each pixel.
// g[0], g[1], g[2]: dL/dS[0], dL/dS[1], dL/dS[2], by the stored numbers { xx, xy, yy }. det S != 0.
void grad_raw(const REAL S[3], const Img *e, REAL g[3]) {
    NOT_STARTED; // delete this line, and write g[0], g[1], g[2]
    (void)S, (void)e, (void)g;
}

// The same blob by other numbers: S = R(th) diag(exp(2 logs[0]), exp(2 logs[1])) R(th)^T.
// g[0], g[1], g[2]: dL/dth, dL/dlogs[0], dL/dlogs[1].
void grad_factored(REAL th, const REAL logs[2], const Img *e, REAL g[3]) {
    NOT_STARTED; // delete this line, and write g[0], g[1], g[2]
    (void)th, (void)logs, (void)e, (void)g;
}

// In 3-D: S = R diag(exp(2 logs[0]), exp(2 logs[1]), exp(2 logs[2])) R^T, stored as { xx, xy, xz, yy, yz, zz }.
// R: a rotation, row-major.
void cov3_from_factors(const REAL R[9], const REAL logs[3], REAL S[6]) {
    NOT_STARTED; // delete this line, and write S[0] .. S[5]
    (void)R, (void)logs, (void)S;
}
