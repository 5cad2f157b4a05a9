// conic.c - E02: from a covariance to its conic, a distance and a box. The task: README.md beside this file.
#include "exercises/exercise.h"

// K = S^-1, both stored as { xx, xy, yy }. Returns 1; or 0, with K left alone, unless det S > 0 (a NaN is not).
int conic_from_cov2(const REAL S[3], REAL K[3]) {
    NOT_STARTED; // delete this line, and write K[0], K[1], K[2]
    (void)S, (void)K;
    return 0;
}

// The squared Mahalanobis distance of the offset d = (dx, dy) from the mean: d^T K d.
REAL mahal2(const REAL K[3], REAL dx, REAL dy) {
    NOT_STARTED; // delete this line, and return the distance
    (void)K, (void)dx, (void)dy;
    return 0;
}

// Half width and half height of the smallest upright box around the ellipse d^T S^-1 d = k^2.
void aabb_ksigma(const REAL S[3], REAL k, REAL half[2]) {
    NOT_STARTED; // delete this line, and write half[0], half[1]
    (void)S, (void)k, (void)half;
}
