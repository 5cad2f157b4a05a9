// conic.c - E02, our solution.
#include "exercises/exercise.h"

// The inverse of a 2x2 matrix: exchange the diagonal, negate the rest, divide by the determinant. `!(det > 0)` is true for NaN.
int conic_from_cov2(const REAL S[3], REAL K[3]) {
    REAL det = S[0] * S[2] - S[1] * S[1];
    if (!(det > 0)) return 0;
    K[0] = S[2] / det;
    K[1] = -S[1] / det;
    K[2] = S[0] / det;
    return 1;
}

REAL mahal2(const REAL K[3], REAL dx, REAL dy) { return K[0] * dx * dx + 2 * K[1] * dx * dy + K[2] * dy * dy; }

// The ellipse is the unit circle under k S^(1/2): along the unit vector e it reaches k |S^(1/2) e| = k sqrt(e^T S e).
void aabb_ksigma(const REAL S[3], REAL k, REAL half[2]) {
    half[0] = k * sqrt(S[0]);
    half[1] = k * sqrt(S[2]);
}
