// test_fit_loss.c - the fast loss against loss.c, which is the text; and the same bits with any number of threads.
#include "splat2d/fit_loss.h"

#include "lab/base/mem.h"
#include "lab/base/rng.h"
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static ImageF noise(int width, int height, uint32_t seed, const ImageF *near_to) {
    ImageF image = imagef_create(width, height, 3);
    Rng rng = rng_at(seed, RNG_TEST, 6, 0);
    for (int i = 0; i < width * height * 3; i++)
        image.values[i] = (float)(near_to ? (double)near_to->values[i] + 0.1 * rng_normal(&rng) : rng_uniform(&rng));
    return image;
}

static void it_agrees_with_the_plain_loss_at_any_size(void **state) {
    (void)state;
    static const int sizes[][2] = {{1, 1}, {2, 3}, {4, 4}, {5, 31}, {33, 7}, {61, 47}};
    for (size_t k = 0; k < sizeof sizes / sizeof sizes[0]; k++)
        for (int l = 0; l < 3; l++) {
            int width = sizes[k][0], height = sizes[k][1];
            double lambda = 0.5 * l;
            size_t values = (size_t)(width * height * 3);
            ImageF photo = noise(width, height, 1, NULL), image = noise(width, height, 2, &photo);
            Planes3 picture = planes3_create(width, height), d_picture = planes3_create(width, height);
            planes3_from_image(&picture, &image);
            FitLoss *loss = fit_loss_create(&photo, lambda);
            Loss fast = fit_loss_evaluate(loss, &picture, &d_picture);
            double *expected = mem_alloc(values, sizeof *expected), *actual = mem_alloc(values, sizeof *actual);
            Loss plain = loss_l1_dssim(&image, &photo, lambda, expected);
            support_near(fast.total, plain.total, 2e-6, "total");
            support_near(fast.l1, plain.l1, 1e-6, "L1");
            support_near(fast.ssim, plain.ssim, 5e-6, "SSIM");

            ImageF d_image = imagef_create(width, height, 3);
            planes3_to_image(&d_picture, &d_image);
            for (size_t i = 0; i < values; i++) actual[i] = (double)d_image.values[i];
            double error = support_relative_l2(actual, expected, values);
            if (error > 2e-5) fail_msg("%d x %d, lambda %g: gradient off by %g", width, height, lambda, error);
            imagef_destroy(&d_image);
            mem_free(expected);
            mem_free(actual);
            fit_loss_destroy(loss);
            planes3_destroy(&picture);
            planes3_destroy(&d_picture);
            imagef_destroy(&photo);
            imagef_destroy(&image);
        }
}

static void the_gradients_margin_stays_zero(void **state) {
    (void)state;
    enum { WIDTH = 9, HEIGHT = 5 };
    ImageF photo = noise(WIDTH, HEIGHT, 3, NULL), image = noise(WIDTH, HEIGHT, 4, NULL);
    Planes3 picture = planes3_create(WIDTH, HEIGHT), d_picture = planes3_create(WIDTH, HEIGHT);
    planes3_from_image(&picture, &image);
    FitLoss *loss = fit_loss_create(&photo, 0.2);
    fit_loss_evaluate(loss, &picture, &d_picture);
    for (int c = 0; c < 3; c++)
        for (int y = -PLANES3_MARGIN; y < HEIGHT + PLANES3_MARGIN; y++)
            for (int x = -PLANES3_MARGIN; x < planes3_lanes_width(&d_picture) + PLANES3_MARGIN; x++)
                if (x < 0 || x >= WIDTH || y < 0 || y >= HEIGHT) assert_true(planes3_row(&d_picture, c, y)[x] == 0);
    fit_loss_destroy(loss);
    planes3_destroy(&picture);
    planes3_destroy(&d_picture);
    imagef_destroy(&photo);
    imagef_destroy(&image);
}

static void one_thread_or_many_give_the_same_bits(void **state) {
    (void)state;
    enum { WIDTH = 50, HEIGHT = 70 };
    ImageF photo = noise(WIDTH, HEIGHT, 5, NULL), image = noise(WIDTH, HEIGHT, 6, NULL);
    Planes3 picture = planes3_create(WIDTH, HEIGHT);
    planes3_from_image(&picture, &image);
    const char *threads[3] = {"1", "2", "9"};
    Loss losses[3];
    ImageF gradients[3];
    for (int k = 0; k < 3; k++) {
        setenv("SPLATLAB_THREADS", threads[k], 1);
        Planes3 d_picture = planes3_create(WIDTH, HEIGHT);
        FitLoss *loss = fit_loss_create(&photo, 0.2);
        losses[k] = fit_loss_evaluate(loss, &picture, &d_picture);
        gradients[k] = imagef_create(WIDTH, HEIGHT, 3);
        planes3_to_image(&d_picture, &gradients[k]);
        assert_memory_equal(&losses[k], &losses[0], sizeof losses[0]);
        assert_memory_equal(gradients[k].values, gradients[0].values, WIDTH * HEIGHT * 3 * sizeof(float));
        fit_loss_destroy(loss);
        planes3_destroy(&d_picture);
    }
    unsetenv("SPLATLAB_THREADS");
    for (int k = 0; k < 3; k++) imagef_destroy(&gradients[k]);
    planes3_destroy(&picture);
    imagef_destroy(&photo);
    imagef_destroy(&image);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_agrees_with_the_plain_loss_at_any_size),
        cmocka_unit_test(the_gradients_margin_stays_zero),
        cmocka_unit_test(one_thread_or_many_give_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
