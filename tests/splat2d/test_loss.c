#include "splat2d/loss.h"

#include "kernels/shared.h"
#include "lab/base/mem.h"
#include "lab/base/rng.h"
#include "tests/support/support.h"

#include <math.h>
#include <string.h>

// Values are multiples of 2^-8 and the step of differences is 2^-18, so that value +- step has no rounding as a float.
static const float STEP = 0x1p-18f;

static ImageF random_picture(int width, int height, uint32_t seed) {
    ImageF picture = imagef_create(width, height, 3);
    Rng rng = rng_at(seed, RNG_TEST, 0, 0);
    for (int i = 0; i < width * height * 3; i++) picture.values[i] = (float)(rng_below(&rng, 200) + 20) / 256;
    return picture;
}

static double at_or_zero(const ImageF *image, int x, int y, int c) {
    if (x < 0 || y < 0 || x >= image->width || y >= image->height) return 0;
    return image->values[(y * image->width + x) * 3 + c];
}

// SSIM from its definition: one 11x11 window per pixel, weights exp(-(dx^2 + dy^2) / 4.5) that sum to 1.
static double ssim_by_definition(const ImageF *a, const ImageF *b) {
    double total = 0, norm = 0;
    for (int dy = -5; dy <= 5; dy++)
        for (int dx = -5; dx <= 5; dx++) norm += exp(-(dx * dx + dy * dy) / 4.5);
    for (int i = 0; i < a->width * a->height * 3; i++) {
        int c = i % 3, x = i / 3 % a->width, y = i / 3 / a->width;
        double ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
        for (int dy = -5; dy <= 5; dy++)
            for (int dx = -5; dx <= 5; dx++) {
                double w = exp(-(dx * dx + dy * dy) / 4.5) / norm;
                double p = at_or_zero(a, x + dx, y + dy, c), q = at_or_zero(b, x + dx, y + dy, c);
                ma += w * p, mb += w * q, aa += w * p * p, bb += w * q * q, ab += w * p * q;
            }
        total += (2 * ma * mb + 1e-4) * (2 * (ab - ma * mb) + 9e-4) /
                 ((ma * ma + mb * mb + 1e-4) * (aa - ma * ma + bb - mb * mb + 9e-4));
    }
    return total / (a->width * a->height * 3);
}

static void ssim_is_what_its_definition_says(void **state) {
    (void)state;
    ImageF a = random_picture(17, 13, 1), b = random_picture(17, 13, 2);
    support_near(metric_ssim(&a, &b), ssim_by_definition(&a, &b), 1e-7, "SSIM"); // C1, C2 are floats in shared.h
    support_near(metric_ssim(&a, &b), metric_ssim(&b, &a), 1e-15, "the other way round");
    imagef_destroy(&a);
    imagef_destroy(&b);
}

static void identical_pictures_have_ssim_1_and_no_loss(void **state) {
    (void)state;
    ImageF a = random_picture(20, 9, 3);
    double *d = mem_alloc(20 * 9 * 3, sizeof(double));
    support_near(metric_ssim(&a, &a), 1, 1e-14, "SSIM");
    support_near(metric_psnr(&a, &a), 99, 0, "PSNR");
    Loss loss = loss_l1_dssim(&a, &a, 0.2, d);
    support_near(loss.total, 0, 1e-14, "loss");
    support_near(loss.l1, 0, 0, "L1");
    for (int i = 0; i < 20 * 9 * 3; i++) support_near(d[i], 0, 1e-15, "gradient");
    mem_free(d);
    imagef_destroy(&a);
}

static void the_loss_mixes_l1_and_ssim(void **state) {
    (void)state;
    ImageF a = imagef_create(4, 3, 3), b = imagef_create(4, 3, 3);
    for (int i = 0; i < 36; i++) a.values[i] = 0.75f, b.values[i] = i % 2 ? 0.25f : 1.0f;
    Loss loss = loss_l1_dssim(&a, &b, 0.2, NULL);
    support_near(loss.l1, 0.375, 1e-15, "L1: half 0.5, half 0.25");
    support_near(loss.ssim, metric_ssim(&a, &b), 1e-15, "SSIM");
    support_near(loss.total, 0.8 * loss.l1 + 0.2 * (1 - loss.ssim), 1e-15, "total");
    imagef_destroy(&a);
    imagef_destroy(&b);
}

// The gradient of every value, at borders and corners as well as inside, against central differences.
static void check_gradient(int width, int height, double lambda) {
    ImageF picture = random_picture(width, height, 4), photo = random_picture(width, height, 5);
    int count = width * height * 3;
    double *d = mem_alloc(count, sizeof *d), *expected = mem_alloc(count, sizeof *expected), largest = 0;
    for (int i = 0; i < count; i++) // away from the kink of |x - y|
        if (picture.values[i] == photo.values[i]) picture.values[i] += 1 / 256.0f;
    loss_l1_dssim(&picture, &photo, lambda, d);
    for (int i = 0; i < count; i++) {
        float value = picture.values[i];
        picture.values[i] = value + STEP;
        double above = loss_l1_dssim(&picture, &photo, lambda, NULL).total;
        picture.values[i] = value - STEP;
        double below = loss_l1_dssim(&picture, &photo, lambda, NULL).total;
        picture.values[i] = value;
        expected[i] = (above - below) / (2 * (double)STEP);
        largest = fmax(largest, fabs(expected[i]));
    }
    char what[64];
    for (int i = 0; i < count; i++) {
        snprintf(what, sizeof what, "lambda %g, value %d of %dx%d", lambda, i, width, height);
        support_near(d[i], expected[i], 1e-6 * largest, what);
    }
    mem_free(d);
    mem_free(expected);
    imagef_destroy(&picture);
    imagef_destroy(&photo);
}

static void the_gradient_agrees_with_central_differences_up_to_the_borders(void **state) {
    (void)state;
    check_gradient(14, 12, 0.2); // has pixels whose whole window lies inside
    check_gradient(14, 12, 1);
    check_gradient(7, 4, 0.2); // every window is cut on two sides
    check_gradient(3, 2, 0);
}

static void psnr_counts_decibels_after_clipping(void **state) {
    (void)state;
    ImageF a = imagef_create(5, 4, 3), b = imagef_create(5, 4, 3);
    for (int i = 0; i < 60; i++) a.values[i] = 0.5f, b.values[i] = 0.25f;
    support_near(metric_psnr(&a, &b), 20 * log10(4), 1e-12, "a quarter off");
    for (int i = 0; i < 60; i++) a.values[i] = i % 2 ? 3 : -2, b.values[i] = i % 2;
    support_near(metric_psnr(&a, &b), 99, 0, "outside of [0, 1]");
    imagef_destroy(&a);
    imagef_destroy(&b);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ssim_is_what_its_definition_says),
        cmocka_unit_test(identical_pictures_have_ssim_1_and_no_loss),
        cmocka_unit_test(the_loss_mixes_l1_and_ssim),
        cmocka_unit_test(the_gradient_agrees_with_central_differences_up_to_the_borders),
        cmocka_unit_test(psnr_counts_decibels_after_clipping),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
