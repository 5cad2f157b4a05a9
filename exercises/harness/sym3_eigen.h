// sym3_eigen.h - the eigenvalues of a symmetric 3x3 matrix: is an answer a covariance, and of which blob?
#ifndef SPLATLAB_EXERCISES_HARNESS_SYM3_EIGEN_H
#define SPLATLAB_EXERCISES_HARNESS_SYM3_EIGEN_H

#include "splat3d/reference.h"

// Smallest first. The error is a few units in the last place of the largest. NaN for a matrix with a number that is not finite.
void sym3_eigenvalues(Sym3 a, double values[3]);

#endif
