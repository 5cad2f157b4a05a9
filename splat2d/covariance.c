// covariance.c - the 2x2 algebra of one blob.
#include "splat2d/covariance.h"

#include <math.h>

Sym2 covariance_from_angle(double angle_rad, double sigma_x, double sigma_y) {
    double c = cos(angle_rad), s = sin(angle_rad);
    double x2 = sigma_x * sigma_x, y2 = sigma_y * sigma_y;
    return (Sym2){.xx = c * c * x2 + s * s * y2, .xy = c * s * (x2 - y2), .yy = s * s * x2 + c * c * y2};
}

double sym2_determinant(Sym2 a) { return a.xx * a.yy - a.xy * a.xy; }
double sym2_length(Sym2 a) { return sqrt(a.xx * a.xx + 2 * a.xy * a.xy + a.yy * a.yy); }

Sym2 sym2_add_diagonal(Sym2 a, double d) { return (Sym2){a.xx + d, a.xy, a.yy + d}; }

bool covariance_conic(Sym2 covariance, Sym2 *conic) {
    double determinant = sym2_determinant(covariance);
    if (!(determinant > 0)) return false; // NaN, too, is no covariance
    conic->xx = covariance.yy / determinant;
    conic->xy = -covariance.xy / determinant;
    conic->yy = covariance.xx / determinant;
    return true;
}

// From Sigma C = I follows dC = -C dSigma C, and with a full symmetric gradient G (G_xy = G_yx) of the loss by C
//     dL = tr(G dC) = tr(-C G C dSigma), so the full gradient by Sigma is H = -C G C.
// A stored xy stands for two entries: G_xy = d_conic.xy / 2, and d_Sigma.xy = 2 H_xy.
Sym2 covariance_conic_backward(Sym2 conic, Sym2 d_conic) {
    Sym2 c = conic;
    Sym2 g = {d_conic.xx, d_conic.xy / 2, d_conic.yy};
    // P = G C, not symmetric
    double p_xx = g.xx * c.xx + g.xy * c.xy, p_xy = g.xx * c.xy + g.xy * c.yy;
    double p_yx = g.xy * c.xx + g.yy * c.xy, p_yy = g.xy * c.xy + g.yy * c.yy;
    return (Sym2){
        .xx = -(c.xx * p_xx + c.xy * p_yx),
        .xy = -2 * (c.xx * p_xy + c.xy * p_yy),
        .yy = -(c.xy * p_xy + c.yy * p_yy),
    };
}

double conic_mahalanobis2(Sym2 conic, double dx, double dy) {
    return conic.xx * dx * dx + 2 * conic.xy * dx * dy + conic.yy * dy * dy;
}

// The matrix is mean * I plus a part with eigenvalues +-radius: Mohr's circle. Its axis stands at half the angle of
// the point (xx - yy, 2 xy) on that circle.
Eigen2 sym2_eigen(Sym2 a) {
    double mean = (a.xx + a.yy) / 2;
    double radius = hypot((a.xx - a.yy) / 2, a.xy);
    double angle = radius > 0 ? atan2(2 * a.xy, a.xx - a.yy) / 2 : 0;
    if (angle < 0) angle += M_PI;
    if (angle >= M_PI) angle = 0; // a tiny negative angle plus pi rounds to pi
    return (Eigen2){.major = mean + radius, .minor = mean - radius, .angle_rad = angle};
}

// The ellipse v^T Sigma^-1 v = k^2 is the unit circle under k Sigma^(1/2), so its reach along a unit vector e is
// k |Sigma^(1/2) e| = k sqrt(e^T Sigma e).
void covariance_box(Sym2 covariance, double k, double *half_x, double *half_y) {
    *half_x = k * sqrt(covariance.xx);
    *half_y = k * sqrt(covariance.yy);
}
