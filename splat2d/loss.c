// loss.c - L1 and SSIM with their gradients, by separable blurs over planes of one channel.
//
// How SSIM is computed here. Of picture x and photo y, per channel, with * the zero-padded convolution by the window w:
//     mx = w * x            my = w * y                                               local means
//     vx = w * x^2 - mx^2   vy = w * y^2 - my^2   cov = w * (x y) - mx my            local variances, covariance
//     SSIM = (2 mx my + C1)(2 cov + C2) / ((mx^2 + my^2 + C1)(vx + vy + C2))         (Wang et al. 2004, eq. 13)
//
// How its gradient comes about. At each window centre p, SSIM depends on x through three blurred planes: mx,
// xx = w * x^2 and xy = w * (x y). With the partial derivatives of SSIM by these three, a, b and c,
//     d SSIM(p) / d x(q) = w(p - q) [ a(p) + 2 x(q) b(p) + y(q) c(p) ].
// Summed over all p this is again a convolution (the window is symmetric, and centres outside the picture do not
// exist, which is what zero padding says):
//     d (sum_p SSIM(p)) / d x = w * a + 2 x (w * b) + y (w * c).
#include "splat2d/loss.h"

#include "kernels/shared.h"
#include "lab/base/mem.h"

#include <assert.h>
#include <math.h>
#include <stddef.h>

enum { TAPS = 2 * SSIM_RADIUS + 1, CHANNELS = 3 };

// The planes of one channel, (height, width) each.
typedef struct {
    int width, height;
    double window[TAPS]; // 1-D; the 2-D window is its outer product
    double *x, *y;       // picture, photo
    double *mx, *my;     // blurred: x, y
    double *xx, *yy;     // x^2, y^2
    double *xy;          // x y
    double *scratch;     // between the two passes of a blur
} Planes;

static void fill_window(double window[TAPS]) {
    double sum = 0;
    for (int k = 0; k < TAPS; k++) {
        double distance = (k - SSIM_RADIUS) / (double)SSIM_SIGMA;
        window[k] = exp(-distance * distance / 2);
        sum += window[k];
    }
    for (int k = 0; k < TAPS; k++) window[k] /= sum;
}

static Planes planes_create(int width, int height) {
    Planes p = {.width = width, .height = height};
    fill_window(p.window);
    double **planes[] = {&p.x, &p.y, &p.mx, &p.my, &p.xx, &p.yy, &p.xy, &p.scratch};
    for (size_t k = 0; k < sizeof planes / sizeof planes[0]; k++)
        *planes[k] = mem_alloc((size_t)width * height, sizeof(double));
    return p;
}

static void planes_destroy(Planes *p) {
    double *planes[] = {p->x, p->y, p->mx, p->my, p->xx, p->yy, p->xy, p->scratch};
    for (size_t k = 0; k < sizeof planes / sizeof planes[0]; k++) mem_free(planes[k]);
}

// One pass along rows (stride 1) or columns (stride width) for `count` pixels that begin at `in` and `out`.
static void blur_line(const double window[TAPS], int count, int stride, const double *in, double *out) {
    for (int i = 0; i < count; i++) {
        double sum = 0;
        for (int k = -SSIM_RADIUS; k <= SSIM_RADIUS; k++)
            if (i + k >= 0 && i + k < count) sum += window[k + SSIM_RADIUS] * in[(ptrdiff_t)(i + k) * stride];
        out[(ptrdiff_t)i * stride] = sum;
    }
}

static void blur(const Planes *p, double *plane) {
    for (int row = 0; row < p->height; row++)
        blur_line(p->window, p->width, 1, plane + (ptrdiff_t)row * p->width, p->scratch + (ptrdiff_t)row * p->width);
    for (int column = 0; column < p->width; column++)
        blur_line(p->window, p->height, p->width, p->scratch + column, plane + column);
}

// Takes channel c of both pictures apart and blurs what SSIM needs.
static void planes_load(Planes *p, const ImageF *picture, const ImageF *photo, int c) {
    ptrdiff_t pixels = (ptrdiff_t)p->width * p->height;
    for (ptrdiff_t i = 0; i < pixels; i++) {
        double x = picture->values[i * CHANNELS + c], y = photo->values[i * CHANNELS + c];
        p->x[i] = p->mx[i] = x;
        p->y[i] = p->my[i] = y;
        p->xx[i] = x * x;
        p->yy[i] = y * y;
        p->xy[i] = x * y;
    }
    double *planes[] = {p->mx, p->my, p->xx, p->yy, p->xy};
    for (int k = 0; k < 5; k++) blur(p, planes[k]);
}

// SSIM at one window centre and, in d, its derivatives by mx, xx and xy.
static double ssim_at(const Planes *p, ptrdiff_t i, double d[3]) {
    double mx = p->mx[i], my = p->my[i];
    double vx = p->xx[i] - mx * mx, vy = p->yy[i] - my * my, covariance = p->xy[i] - mx * my;
    double light = 2 * mx * my + (double)SSIM_C1, light_norm = mx * mx + my * my + (double)SSIM_C1;
    double structure = 2 * covariance + (double)SSIM_C2, structure_norm = vx + vy + (double)SSIM_C2;
    double ssim = light * structure / (light_norm * structure_norm);

    // By the four factors, then by what they are made of; mx also stands in vx (-mx^2) and in the covariance (-mx my).
    double d_light = structure / (light_norm * structure_norm), d_structure = light / (light_norm * structure_norm);
    double d_light_norm = -ssim / light_norm, d_structure_norm = -ssim / structure_norm;
    d[0] = 2 * my * (d_light - d_structure) + 2 * mx * (d_light_norm - d_structure_norm);
    d[1] = d_structure_norm;
    d[2] = 2 * d_structure;
    return ssim;
}

// Sum of SSIM over the channel's pixels. With `gradient`, leaves w * a + 2 x (w * b) + y (w * c) in mx.
static double ssim_sum(Planes *p, bool gradient) {
    ptrdiff_t pixels = (ptrdiff_t)p->width * p->height;
    double sum = 0, d[3];
    double *a = p->mx, *b = p->xx,
           *c = p->xy; // pixel i of the planes is read for the last time where it is overwritten
    for (ptrdiff_t i = 0; i < pixels; i++) {
        sum += ssim_at(p, i, d);
        a[i] = d[0];
        b[i] = d[1];
        c[i] = d[2];
    }
    if (!gradient) return sum;
    blur(p, a);
    blur(p, b);
    blur(p, c);
    for (ptrdiff_t i = 0; i < pixels; i++) a[i] += 2 * p->x[i] * b[i] + p->y[i] * c[i];
    return sum;
}

static void assert_comparable(const ImageF *picture, const ImageF *photo) {
    assert(picture->channels == CHANNELS && photo->channels == CHANNELS);
    assert(picture->width == photo->width && picture->height == photo->height);
    (void)picture, (void)photo; // with NDEBUG
}

Loss loss_l1_dssim(const ImageF *picture, const ImageF *photo, double lambda, double *d_picture) {
    assert_comparable(picture, photo);
    ptrdiff_t pixels = (ptrdiff_t)picture->width * picture->height;
    double values = (double)pixels * CHANNELS; // both terms are means over pixels and channels
    Loss loss = {0};
    Planes planes = planes_create(picture->width, picture->height);
    for (int c = 0; c < CHANNELS; c++) {
        planes_load(&planes, picture, photo, c);
        loss.ssim += ssim_sum(&planes, d_picture != NULL) / values;
        for (ptrdiff_t i = 0; i < pixels; i++) {
            double difference = planes.x[i] - planes.y[i];
            loss.l1 += fabs(difference) / values;
            if (!d_picture) continue;
            double d_l1 = (difference > 0) - (difference < 0);
            double d_ssim = planes.mx[i];
            d_picture[i * CHANNELS + c] = ((1 - lambda) * d_l1 - lambda * d_ssim) / values;
        }
    }
    planes_destroy(&planes);
    loss.total = (1 - lambda) * loss.l1 + lambda * (1 - loss.ssim);
    return loss;
}

double metric_ssim(const ImageF *picture, const ImageF *photo) { return loss_l1_dssim(picture, photo, 1, NULL).ssim; }

double metric_psnr(const ImageF *picture, const ImageF *photo) {
    assert_comparable(picture, photo);
    ptrdiff_t values = (ptrdiff_t)picture->width * picture->height * CHANNELS;
    double squares = 0;
    for (ptrdiff_t i = 0; i < values; i++) {
        double difference = fmin(fmax(picture->values[i], 0), 1) - photo->values[i];
        squares += difference * difference;
    }
    return fmin(99, -10 * log10(squares / (double)values));
}
