// blob_picture.c - one Gaussian, pixel by pixel.
#include "exercises/harness/blob_picture.h"

#include <math.h>

enum { SIDE = 160 };
static const double RING = 0.06, FLAT = 1e-6;

double blob_picture_fit(Sym2 covariance) {
    double major = sym2_eigen(covariance).major;
    return major > 0 && isfinite(major) ? 4 * sqrt(major) : 1;
}

ImageF blob_picture(Sym2 covariance, double half_width) {
    ImageF image = imagef_create(SIDE, SIDE, 3);
    Sym2 conic;
    Eigen2 eigen = sym2_eigen(covariance);
    if (eigen.minor >= -FLAT * eigen.major) { // a blob without width is a line: as thin as a pixel, so that it is seen
        double pixel = half_width / SIDE;
        covariance.xx += pixel * pixel;
        covariance.yy += pixel * pixel;
    }
    bool is_valid = covariance_conic(covariance, &conic) && covariance.xx > 0;
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            float *rgb = &image.values[(y * SIDE + x) * 3];
            double dx = ((x + 0.5) / SIDE * 2 - 1) * half_width, dy = ((y + 0.5) / SIDE * 2 - 1) * half_width;
            double m2 = is_valid ? conic_mahalanobis2(conic, dx, dy) : 0;
            float g = (float)exp(-m2 / 2);
            bool on_ring = fabs(sqrt(m2) - 1) < RING;
            rgb[0] = !is_valid ? 0.7f : on_ring ? 1.0f : g;
            rgb[1] = !is_valid ? 0.1f : on_ring ? 0.6f : g;
            rgb[2] = !is_valid ? 0.1f : on_ring ? 0.1f : g;
        }
    return image;
}
