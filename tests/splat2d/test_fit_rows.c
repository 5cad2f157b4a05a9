// test_fit_rows.c - the rows' code compiled with doubles: gradients by central differences, then the library's floats against
// these doubles.
#define LANES_DOUBLE
#include "splat2d/fit_rows.h"

#include "lab/base/rng.h"
#include "splat2d/fit_pass.h"
#include "splat2d/planes3.h"
#include "tests/support/support.h"

#include <math.h>

enum { WIDTH = 23, HEIGHT = 37, STRIDE = 32, BLOBS = 7, SEEDS = 12, PARAMETERS = FIT_FIELDS * BLOBS };

typedef struct {
    double rgb[3][HEIGHT][STRIDE], d_rgb[3][HEIGHT][STRIDE];
    double weight[3][HEIGHT][STRIDE]; // the loss is sum of weight rgb + rgb^2 / 2
    double transmittance[HEIGHT][STRIDE], last[HEIGHT][STRIDE], behind[3][HEIGHT][STRIDE];
} Picture;

static const double BACKGROUND[3] = {0.3, 0.1, 0.7};

// (FIT_FIELDS, BLOBS). The first two are nearly opaque: clamped in the middle, and together they end pixels.
static void random_parameters(uint32_t seed, double p[PARAMETERS]) {
    Rng rng = rng_at(seed, RNG_TEST, 4, 0);
    for (int i = 0; i < BLOBS; i++) {
        p[FIT_MEAN_X * BLOBS + i] = rng_range(&rng, -3, WIDTH + 3);
        p[FIT_MEAN_Y * BLOBS + i] = rng_range(&rng, -3, HEIGHT + 3);
        p[FIT_LOG_SX * BLOBS + i] = rng_range(&rng, 0.3, 2.5);
        p[FIT_LOG_SY * BLOBS + i] = rng_range(&rng, 0.3, 2.5);
        p[FIT_THETA * BLOBS + i] = rng_range(&rng, -4, 4);
        p[FIT_OPACITY_LOGIT * BLOBS + i] = i < 3 ? 6 : rng_range(&rng, -3, 3);
        for (int c = 0; c < 3; c++) p[(FIT_RGB + c) * BLOBS + i] = rng_uniform(&rng);
    }
    for (int i = 0; i < 3; i++) { // on top of each other
        p[FIT_MEAN_X * BLOBS + i] = 12 + i;
        p[FIT_MEAN_Y * BLOBS + i] = 20 - i;
    }
}

static void random_weights(uint32_t seed, Picture *picture) {
    Rng rng = rng_at(seed, RNG_TEST, 5, 0);
    for (int c = 0; c < 3; c++)
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++) picture->weight[c][y][x] = rng_normal(&rng);
}

static FitRow row_of(Picture *picture, int y) {
    FitRow row = {.transmittance = picture->transmittance[y], .last = picture->last[y]};
    for (int c = 0; c < 3; c++) {
        row.rgb[c] = picture->rgb[c][y];
        row.d_rgb[c] = picture->d_rgb[c][y];
        row.behind[c] = picture->behind[c][y];
    }
    return row;
}

static void gather(const double p[PARAMETERS], int blob, double out[FIT_FIELDS]) {
    for (int k = 0; k < FIT_FIELDS; k++) out[k] = p[k * BLOBS + blob];
}

static double forward(const double p[PARAMETERS], Picture *picture) {
    FitBlob blobs[BLOBS];
    double loss = 0, own[FIT_FIELDS];
    for (int i = 0; i < BLOBS; i++) {
        gather(p, i, own);
        blobs[i] = blob_forward(own, HEIGHT);
    }
    for (int y = 0; y < HEIGHT; y++) {
        FitRow row = row_of(picture, y);
        row_begin(&row, STRIDE);
        for (int i = 0; i < BLOBS; i++) row_forward(&row, y, WIDTH, &blobs[i], i);
        row_end(&row, WIDTH, BACKGROUND);
        for (int c = 0; c < 3; c++)
            for (int x = 0; x < WIDTH; x++) {
                double value = picture->rgb[c][y][x];
                loss += picture->weight[c][y][x] * value + value * value / 2;
                picture->d_rgb[c][y][x] = picture->weight[c][y][x] + value;
            }
    }
    return loss;
}

static void backward(const double p[PARAMETERS], Picture *picture, double d_p[PARAMETERS]) {
    FitSums sums[BLOBS] = {0};
    double own[FIT_FIELDS], own_sums[FIT_SUMS], d_own[FIT_FIELDS];
    for (int y = 0; y < HEIGHT; y++) {
        FitRow row = row_of(picture, y);
        row_begin_backward(&row, STRIDE, BACKGROUND);
        for (int i = BLOBS - 1; i >= 0; i--) {
            gather(p, i, own);
            FitBlob blob = blob_forward(own, HEIGHT);
            row_backward(&row, y, WIDTH, &blob, i, &sums[i]);
        }
    }
    for (int i = 0; i < BLOBS; i++) {
        gather(p, i, own);
        for (int k = 0; k < FIT_SUMS; k++) own_sums[k] = lanes_sum(sums[i].sum[k]);
        blob_backward(own, own_sums, d_own);
        for (int k = 0; k < FIT_FIELDS; k++) d_p[k * BLOBS + i] = d_own[k];
    }
}

// The step is so small that hardly a pixel crosses alpha = 1/255 within it, where the picture jumps.
static void every_derivative_is_that_of_the_loss(void **state) {
    (void)state;
    static Picture picture;
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        double p[PARAMETERS], d_p[PARAMETERS], differences[PARAMETERS], largest[FIT_FIELDS] = {0};
        random_parameters(seed, p);
        random_weights(seed, &picture);
        forward(p, &picture);
        backward(p, &picture, d_p);
        for (int k = 0; k < PARAMETERS; k++) {
            double value = p[k], h = 2e-6;
            p[k] = value + h;
            double above = forward(p, &picture);
            p[k] = value - h;
            double below = forward(p, &picture);
            p[k] = value;
            differences[k] = (above - below) / (2 * h);
            largest[k / BLOBS] = fmax(largest[k / BLOBS], fabs(d_p[k]));
        }
        for (int k = 0; k < PARAMETERS; k++) {
            char what[64];
            snprintf(what, sizeof what, "seed %u, field %d, blob %d", seed, k / BLOBS, k % BLOBS);
            support_near(d_p[k], differences[k], 1e-6 * largest[k / BLOBS] + 1e-7, what);
        }
    }
}

// What a constant added to every colour does to a constant loss is known: sum of weights + T = 1.
static void the_colours_gradients_and_the_background_share_one_whole(void **state) {
    (void)state;
    static Picture picture;
    double p[PARAMETERS], d_p[PARAMETERS], of_colours = 0, of_background = 0;
    random_parameters(3, p);
    forward(p, &picture);
    for (int c = 0; c < 3; c++)
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++) {
                picture.d_rgb[c][y][x] = 1;
                of_background += picture.transmittance[y][x];
            }
    backward(p, &picture, d_p);
    for (int k = FIT_RGB * BLOBS; k < PARAMETERS; k++) of_colours += d_p[k];
    support_near(of_colours + of_background, 3.0 * WIDTH * HEIGHT, 1e-9, "sum of all weights");
}

// Solid blobs as large as the picture, all in one place: T falls by 0.01 with each, so at most three are seen.
static void nothing_is_blended_behind_an_opaque_pixel(void **state) {
    (void)state;
    static Picture picture;
    double p[PARAMETERS], d_p[PARAMETERS];
    random_parameters(1, p);
    for (int i = 0; i < BLOBS; i++) {
        p[FIT_MEAN_X * BLOBS + i] = 11, p[FIT_MEAN_Y * BLOBS + i] = 18;
        p[FIT_LOG_SX * BLOBS + i] = p[FIT_LOG_SY * BLOBS + i] = 7;
        p[FIT_OPACITY_LOGIT * BLOBS + i] = 6;
    }
    random_weights(1, &picture);
    forward(p, &picture);
    backward(p, &picture, d_p);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) assert_in_range((int)picture.last[y][x], 2, 3);
    for (int k = 0; k < FIT_FIELDS; k++)
        for (int i = 3; i < BLOBS; i++) assert_true(d_p[k * BLOBS + i] == 0);
    assert_true(d_p[FIT_RGB * BLOBS] != 0);
}

// ---- the library's floats ----

static void floats_agree_with_doubles_forward_and_backward(void **state) {
    (void)state;
    static Picture picture;
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        double p[PARAMETERS], d_p[PARAMETERS], d_floats[PARAMETERS];
        random_parameters(seed, p);
        random_weights(seed, &picture);
        forward(p, &picture);
        backward(p, &picture, d_p);

        FitPass *pass = fit_pass_create(WIDTH, HEIGHT);
        Planes3 floats = planes3_create(WIDTH, HEIGHT), d_floats_rgb = planes3_create(WIDTH, HEIGHT);
        fit_pass_forward(pass, BLOBS, p, BACKGROUND, &floats);
        int at_edges = 0; // alpha = 1/255 on one side in float and on the other in double
        for (int c = 0; c < 3; c++)
            for (int y = 0; y < HEIGHT; y++)
                for (int x = 0; x < WIDTH; x++) {
                    double off = fabs((double)planes3_row(&floats, c, y)[x] - picture.rgb[c][y][x]);
                    assert_true(off < 1.01 / 255);
                    at_edges += off > 1e-5;
                    planes3_row(&d_floats_rgb, c, y)[x] = (float)picture.d_rgb[c][y][x];
                }
        if (at_edges > 6) fail_msg("seed %u: %d values differ", seed, at_edges);
        fit_pass_backward(pass, p, &d_floats_rgb, d_floats);
        for (int field = 0; field < FIT_FIELDS; field++) {
            double error = support_relative_l2(d_floats + field * BLOBS, d_p + field * BLOBS, BLOBS);
            if (error > 2e-3) fail_msg("seed %u, field %d: relative error %g", seed, field, error);
        }
        planes3_destroy(&floats);
        planes3_destroy(&d_floats_rgb);
        fit_pass_destroy(pass);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_derivative_is_that_of_the_loss),
        cmocka_unit_test(the_colours_gradients_and_the_background_share_one_whole),
        cmocka_unit_test(nothing_is_blended_behind_an_opaque_pixel),
        cmocka_unit_test(floats_agree_with_doubles_forward_and_backward),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
