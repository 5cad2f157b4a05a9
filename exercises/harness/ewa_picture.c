// ewa_picture.c - two Gaussians in one window, pixel by pixel.
#include "exercises/harness/ewa_picture.h"

#include <math.h>

enum { SIDE = 160 };
static const double RING = 0.06; // half the width of a ring, in standard deviations
static const float BLUE[3] = {0.2f, 0.5f, 1.0f}, ORANGE[3] = {1.0f, 0.6f, 0.1f};

static void paint(float rgb[3], const float colour[3]) {
    for (int c = 0; c < 3; c++) rgb[c] = colour[c];
}

// Infinitely far where the matrix is no covariance.
static double distance(Sym2 covariance, double dx, double dy) {
    Sym2 conic;
    if (!covariance_conic(covariance, &conic) || !(covariance.xx > 0)) return INFINITY;
    return sqrt(conic_mahalanobis2(conic, dx, dy));
}

ImageF ewa_picture(Sym2 ewa, double dx, double dy, Sym2 covariance, double half_width) {
    ImageF image = imagef_create(SIDE, SIDE, 3);
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            float *rgb = &image.values[(y * SIDE + x) * 3];
            double at_x = ((x + 0.5) / SIDE * 2 - 1) * half_width, at_y = ((y + 0.5) / SIDE * 2 - 1) * half_width;
            double m = distance(covariance, at_x - dx, at_y - dy);
            rgb[0] = rgb[1] = rgb[2] = (float)exp(-m * m / 2);
            if (fabs(distance(ewa, at_x, at_y) - 1) < RING) paint(rgb, BLUE);
            if (fabs(m - 1) < RING) paint(rgb, ORANGE);
        }
    return image;
}
