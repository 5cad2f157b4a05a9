// test_fit2d.c - fits of pictures whose answer is known: counts, shapes, growth, and the same bytes with any number of threads.
#include "splat2d/fit2d.h"

#include "splat2d/fit_sample.h"
#include "splat2d/raster2d.h"

#include "lab/base/mem.h"
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static ImageF picture_of(const Scene2d *scene) {
    ImageF picture = imagef_create(scene->width, scene->height, 3);
    Raster2d raster = {0};
    RasterSettings settings = raster_settings_default();
    raster2d_load(&raster, scene, view2d_whole());
    raster2d_draw(&raster, &settings, &picture, NULL);
    raster2d_destroy(&raster);
    return picture;
}

// The lesson's six blobs, small.
static ImageF lesson_photo(void) {
    Scene2d scene = scene2d_default();
    ImageF photo = imagef_create(64, 48, 3);
    Raster2d raster = {0};
    RasterSettings settings = raster_settings_default();
    raster2d_load(&raster, &scene, view2d_fit(&scene, 64, 48));
    raster2d_draw(&raster, &settings, &photo, NULL);
    raster2d_destroy(&raster);
    scene2d_destroy(&scene);
    return photo;
}

// One bright diagonal streak of that aspect on black.
static ImageF streak_photo(double aspect) {
    Scene2d scene = scene2d_create(64, 64);
    Blob streak = {.mean = {32, 32},
                   .sigma_x = 2.0 * aspect,
                   .sigma_y = 2,
                   .theta_rad = -0.7,
                   .rgb = {1, 0.8, 0.3},
                   .opacity = 0.95};
    scene2d_add(&scene, &streak);
    ImageF photo = picture_of(&scene);
    scene2d_destroy(&scene);
    return photo;
}

static Fit2d *fit_for(const ImageF *photo, Fit2dOptions options) {
    Fit2d *fit = fit2d_create(photo, &options);
    while (fit2d_steps_done(fit) < options.iterations) fit2d_step(fit);
    return fit;
}

static double psnr_of_fit(const ImageF *photo, Fit2dOptions options) {
    Fit2d *fit = fit_for(photo, options);
    ImageF picture = imagef_create(photo->width, photo->height, 3);
    fit2d_picture(fit, &picture);
    double psnr = metric_psnr(&picture, photo);
    imagef_destroy(&picture);
    fit2d_destroy(fit);
    return psnr;
}

static void a_few_blobs_find_the_lessons_picture(void **state) {
    (void)state;
    ImageF photo = lesson_photo();
    Fit2dOptions options = fit2d_options_default();
    options.gaussians = 24;
    options.iterations = 300;
    double psnr = psnr_of_fit(&photo, options);
    print_message("24 blobs: %.1f dB\n", psnr);
    assert_true(psnr > 32);
    imagef_destroy(&photo);
}

// What anisotropy is worth: on a streak of aspect 8 one stretched blob does what a handful of round ones cannot.
static void one_stretched_blob_beats_many_round_ones_on_a_streak(void **state) {
    (void)state;
    ImageF photo = streak_photo(8);
    Fit2dOptions options = fit2d_options_default();
    options.iterations = 400;
    options.gaussians = 1;
    double stretched = psnr_of_fit(&photo, options);
    options.isotropic = true;
    options.gaussians = 6;
    double round = psnr_of_fit(&photo, options);
    print_message("1 stretched: %.1f dB, 6 round: %.1f dB\n", stretched, round);
    assert_true(stretched > round + 3);
    imagef_destroy(&photo);
}

static void round_blobs_stay_round(void **state) {
    (void)state;
    ImageF photo = lesson_photo();
    Fit2dOptions options = fit2d_options_default();
    options.gaussians = 10;
    options.iterations = 30;
    options.isotropic = true;
    Fit2d *fit = fit_for(&photo, options);
    Scene2d scene = fit2d_scene(fit);
    for (int i = 0; i < scene.count; i++)
        assert_true(scene.blobs[i].sigma_x == scene.blobs[i].sigma_y && scene.blobs[i].theta_rad == 0);
    scene2d_destroy(&scene);
    fit2d_destroy(fit);
    imagef_destroy(&photo);
}

static void the_scene_of_a_fit_draws_its_picture(void **state) {
    (void)state;
    ImageF photo = lesson_photo();
    Fit2dOptions options = fit2d_options_default();
    options.gaussians = 40;
    options.iterations = 40;
    Fit2d *fit = fit_for(&photo, options);
    Scene2d scene = fit2d_scene(fit);
    assert_int_equal(scene.count, 40);
    assert_true(scene2d_check(&scene, "fit"));
    ImageF drawn = picture_of(&scene), picture = imagef_create(64, 48, 3);
    fit2d_picture(fit, &picture);
    int at_edges = 0;
    for (int i = 0; i < 64 * 48 * 3; i++) {
        double off = fabs((double)(drawn.values[i] - picture.values[i]));
        assert_true(off < 1.01 / 255); // a blob at the edge of visibility
        at_edges += off > 1e-4;
    }
    assert_in_range(at_edges, 0, 15);
    imagef_destroy(&drawn);
    imagef_destroy(&picture);
    scene2d_destroy(&scene);
    fit2d_destroy(fit);
    imagef_destroy(&photo);
}

static void growth_begins_with_an_eighth_and_ends_at_half_time(void **state) {
    (void)state;
    ImageF photo = lesson_photo();
    Fit2dOptions options = fit2d_options_default();
    options.gaussians = 50;
    options.iterations = 60;
    options.grow = true;
    Fit2d *fit = fit2d_create(&photo, &options);
    assert_int_equal(fit2d_count(fit), 7);
    int before = 7;
    for (int step = 1; step <= 60; step++) {
        Loss loss = fit2d_step(fit);
        assert_true(isfinite(loss.total));
        int count = fit2d_count(fit);
        assert_true(count >= before && count <= 50);
        if (step > 30) assert_int_equal(count, 50);
        if (step < 20) assert_true(count < 50);
        before = count;
    }
    fit2d_destroy(fit);
    imagef_destroy(&photo);
}

static void the_loss_falls_and_goes_on_falling_behind_the_schedule(void **state) {
    (void)state;
    ImageF photo = lesson_photo();
    Fit2dOptions options = fit2d_options_default();
    options.gaussians = 30;
    options.iterations = 20;
    Fit2d *fit = fit2d_create(&photo, &options);
    double first = fit2d_step(fit).total, scheduled = 0, later = 0;
    for (int step = 1; step < 20; step++) scheduled = fit2d_step(fit).total;
    for (int step = 0; step < 100; step++) later = fit2d_step(fit).total;
    assert_int_equal(fit2d_steps_done(fit), 120);
    assert_true(scheduled < 0.8 * first);
    assert_true(later < 0.9 * scheduled);
    fit2d_destroy(fit);
    imagef_destroy(&photo);
}

static Scene2d fit_with_threads(const ImageF *photo, const char *threads, uint64_t seed) {
    setenv("SPLATLAB_THREADS", threads, 1);
    Fit2dOptions options = fit2d_options_default();
    options.gaussians = 60;
    options.iterations = 40;
    options.grow = true;
    options.seed = seed;
    Fit2d *fit = fit_for(photo, options);
    Scene2d scene = fit2d_scene(fit);
    fit2d_destroy(fit);
    unsetenv("SPLATLAB_THREADS");
    return scene;
}

static void one_thread_or_many_find_the_same_blobs(void **state) {
    (void)state;
    ImageF photo = lesson_photo();
    const char *threads[3] = {"1", "2", "5"};
    Scene2d first = fit_with_threads(&photo, "2", 7), other_seed = fit_with_threads(&photo, "2", 8);
    for (int k = 0; k < 3; k++) {
        Scene2d scene = fit_with_threads(&photo, threads[k], 7);
        assert_int_equal(scene.count, first.count);
        assert_memory_equal(scene.blobs, first.blobs, (size_t)first.count * sizeof(Blob));
        scene2d_destroy(&scene);
    }
    assert_memory_not_equal(first.blobs, other_seed.blobs, (size_t)first.count * sizeof(Blob));
    scene2d_destroy(&first);
    scene2d_destroy(&other_seed);
    imagef_destroy(&photo);
}

static void tiny_flat_and_black_pictures_are_fitted_too(void **state) {
    (void)state;
    static const int sizes[][2] = {{1, 1}, {3, 1}, {1, 19}, {16, 16}};
    for (size_t k = 0; k < sizeof sizes / sizeof sizes[0]; k++)
        for (int value = 0; value < 2; value++) {
            ImageF photo = imagef_create(sizes[k][0], sizes[k][1], 3);
            for (int i = 0; i < photo.width * photo.height * 3; i++) photo.values[i] = 0.6f * (float)value;
            Fit2dOptions options = fit2d_options_default();
            options.gaussians = 3;
            options.iterations = 25;
            options.grow = true;
            double psnr = psnr_of_fit(&photo, options);
            assert_true(psnr > 35);
            imagef_destroy(&photo);
        }
}

// ---- where blobs begin ----

static void places_are_drawn_as_often_as_their_weight_says(void **state) {
    (void)state;
    enum { COUNT = 20000 };
    const double weights[4] = {0, 1, 3, 0};
    FitPlace *places = mem_alloc(COUNT, sizeof *places);
    int often[4] = {0};
    fit_sample(weights, 2, 2, 1, RNG_TEST, 0, COUNT, places);
    for (int i = 0; i < COUNT; i++) {
        int at = (int)places[i].y * 2 + (int)places[i].x;
        often[at]++;
        support_near(places[i].spacing_px, sqrt(4 / weights[at] / COUNT), 1e-12, "spacing");
    }
    assert_true(often[0] == 0 && often[3] == 0);
    support_near(often[2] / (double)COUNT, 0.75, 4 * sqrt(0.75 * 0.25 / COUNT), "share");
    mem_free(places);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_few_blobs_find_the_lessons_picture),
        cmocka_unit_test(one_stretched_blob_beats_many_round_ones_on_a_streak),
        cmocka_unit_test(round_blobs_stay_round),
        cmocka_unit_test(the_scene_of_a_fit_draws_its_picture),
        cmocka_unit_test(growth_begins_with_an_eighth_and_ends_at_half_time),
        cmocka_unit_test(the_loss_falls_and_goes_on_falling_behind_the_schedule),
        cmocka_unit_test(one_thread_or_many_find_the_same_blobs),
        cmocka_unit_test(tiny_flat_and_black_pictures_are_fitted_too),
        cmocka_unit_test(places_are_drawn_as_often_as_their_weight_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
