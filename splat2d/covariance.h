// covariance.h - the shape of a 2-D Gaussian: Sigma = R(theta) diag(sx^2, sy^2) R(theta)^T, its inverse and its axes.
//
// A symmetric 2x2 matrix is stored as three numbers xx, xy, yy; a gradient with respect to it is the derivative by
// those *stored* numbers (xy stands for both off-diagonal entries and is varied once).
#ifndef SPLATLAB_SPLAT2D_COVARIANCE_H
#define SPLATLAB_SPLAT2D_COVARIANCE_H

#include <stdbool.h>

typedef struct {
    double xx, xy, yy;
} Sym2; // [[xx, xy], [xy, yy]]

// Sigma from an angle (rad, counter-clockwise from +x towards +y) and two standard deviations. PSD for any input,
// because v^T Sigma v = |S R^T v|^2.
Sym2 covariance_from_angle(double angle_rad, double sigma_x, double sigma_y);

double sym2_determinant(Sym2 a);
double sym2_length(Sym2 a);               // Frobenius: xy counts twice, as it stands twice
Sym2 sym2_add_diagonal(Sym2 a, double d); // a + d I: the low-pass filter

// The conic: Sigma^-1. False (and *conic untouched) when det <= 0: such a matrix is no covariance, or has no extent.
bool covariance_conic(Sym2 covariance, Sym2 *conic);

// The gradient by Sigma of a loss whose gradient by the conic is d_conic: d_Sigma = -C d_C C with full symmetric
// matrices, written for stored numbers.
Sym2 covariance_conic_backward(Sym2 conic, Sym2 d_conic);

// Squared Mahalanobis distance of the offset (dx, dy): dx^2 xx + 2 dx dy xy + dy^2 yy of the conic.
double conic_mahalanobis2(Sym2 conic, double dx, double dy);

// Eigenvalues, larger first, and the direction of the larger in [0, pi). A round one has angle 0.
typedef struct {
    double major, minor, angle_rad;
} Eigen2;
Eigen2 sym2_eigen(Sym2 a);

// Half width and half height of the smallest axis-aligned box around the ellipse m^2 = k^2: k sqrt(xx), k sqrt(yy).
void covariance_box(Sym2 covariance, double k, double *half_x, double *half_y);

#endif
