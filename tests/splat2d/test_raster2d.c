// test_raster2d.c - the rasterizer against the walk of single pixels in doubles; maps, views, settings, invalid shapes.
#include "splat2d/raster2d.h"

#include "lab/base/mem.h"
#include "lab/base/rng.h"
#include "splat2d/pixel_walk.h"
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SCENES = 12, BLOBS = 40 };

static Scene2d random_scene(uint32_t seed, int count) {
    Rng rng = rng_at(seed, RNG_TEST, 0, 0);
    Scene2d scene = scene2d_create(83, 59);
    for (int c = 0; c < 3; c++) scene.background[c] = rng_uniform(&rng);
    for (int i = 0; i < count; i++) {
        Blob blob = {.mean = {rng_range(&rng, -10, 93), rng_range(&rng, -10, 69)},
                     .sigma_x = exp(rng_range(&rng, -1, 3.5)),
                     .sigma_y = exp(rng_range(&rng, -1, 3.5)),
                     .theta_rad = rng_range(&rng, -9, 9),
                     .rgb = {rng_uniform(&rng), rng_uniform(&rng), rng_uniform(&rng)},
                     .opacity = rng_uniform(&rng) < 0.3 ? 1 : rng_uniform(&rng),
                     .depth = rng_below(&rng, 10)};
        scene2d_add(&scene, &blob);
    }
    return scene;
}

// How many pixels differ by more than a float's rounding. One at the edge of ALPHA_MIN may be skipped by one of the two and not
// by the other: then they differ by at most 1 / 255.
static void compare_with_walks(Raster2d *raster, const RasterSettings *settings, int width, int height,
                               const char *what) {
    ImageF picture = imagef_create(width, height, 3);
    float *transmittance = mem_alloc((size_t)(width * height), sizeof *transmittance);
    RasterMaps maps = {.transmittance = transmittance};
    double mean = raster2d_draw(raster, settings, &picture, &maps), sum = 0;
    WalkStep *steps = mem_alloc((size_t)raster->count, sizeof *steps);
    int at_edges = 0;
    for (int i = 0; i < width * height; i++) {
        WalkResult walk = pixel_walk(raster, settings, i % width + 0.5, i / width + 0.5, steps);
        double worst = fabs(walk.transmittance - (double)transmittance[i]);
        for (int c = 0; c < 3; c++) worst = fmax(worst, fabs(walk.rgb[c] - (double)picture.values[3 * i + c]));
        if (worst > 1.01 / 255) fail_msg("%s, pixel %d %d: off by %g", what, i % width, i / width, worst);
        at_edges += worst > 1e-4;
        sum += 1 - walk.transmittance;
    }
    if (at_edges > 2 + width * height / 1000) fail_msg("%s: %d pixels differ", what, at_edges);
    support_near(mean, sum / (width * height), 1e-5, "mean accumulated opacity");
    mem_free(steps);
    mem_free(transmittance);
    imagef_destroy(&picture);
}

static void each_pixel_is_what_its_walk_says(void **state) {
    (void)state;
    for (uint32_t seed = 1; seed <= SCENES; seed++) {
        char what[64];
        snprintf(what, sizeof what, "seed %u", seed);
        Scene2d scene = random_scene(seed, BLOBS);
        Raster2d raster = {0};
        RasterSettings settings = raster_settings_default();
        raster2d_load(&raster, &scene, view2d_whole());
        compare_with_walks(&raster, &settings, 83, 59, what);
        settings.rule.rule = STOP_BEFORE_BLEND;
        compare_with_walks(&raster, &settings, 83, 59, what);
        settings = raster_settings_lesson();
        compare_with_walks(&raster, &settings, 83, 59, what);
        raster2d_load(&raster, &scene, (View2d){.left = 20.3, .top = -4.7, .zoom = 3.7});
        settings = raster_settings_default();
        compare_with_walks(&raster, &settings, 301, 47, what); // wider than a strip
        raster2d_destroy(&raster);
        scene2d_destroy(&scene);
    }
}

static ImageF draw(const Scene2d *scene, const RasterSettings *settings, View2d view, int width, int height) {
    ImageF picture = imagef_create(width, height, 3);
    Raster2d raster = {0};
    raster2d_load(&raster, scene, view);
    raster2d_draw(&raster, settings, &picture, NULL);
    raster2d_destroy(&raster);
    return picture;
}

static void one_thread_or_many_draw_the_same_bytes(void **state) {
    (void)state;
    Scene2d scene = random_scene(5, 200);
    RasterSettings settings = raster_settings_default();
    Raster2d raster = {0};
    raster2d_load(&raster, &scene, view2d_whole());
    ImageF pictures[3];
    double means[3];
    const char *threads[3] = {"1", "2", "7"};
    for (int i = 0; i < 3; i++) {
        setenv("SPLATLAB_THREADS", threads[i], 1);
        pictures[i] = imagef_create(83, 59, 3);
        means[i] = raster2d_draw(&raster, &settings, &pictures[i], NULL);
        assert_memory_equal(pictures[i].values, pictures[0].values, 83 * 59 * 3 * sizeof(float));
        assert_true(means[i] == means[0]);
    }
    unsetenv("SPLATLAB_THREADS");
    for (int i = 0; i < 3; i++) imagef_destroy(&pictures[i]);
    raster2d_destroy(&raster);
    scene2d_destroy(&scene);
}

static void an_empty_scene_is_its_background(void **state) {
    (void)state;
    Scene2d scene = scene2d_create(5, 4);
    scene.background[1] = 0.25;
    RasterSettings settings = raster_settings_default();
    ImageF picture = draw(&scene, &settings, view2d_whole(), 5, 4);
    for (int i = 0; i < 20; i++) assert_true(picture.values[3 * i] == 0 && picture.values[3 * i + 1] == 0.25f);
    imagef_destroy(&picture);
}

// A point of the canvas looks the same in any view: four pixels of a picture twice as large lie around one of the other.
static void a_view_shows_the_canvas_where_it_is(void **state) {
    (void)state;
    Scene2d scene = scene2d_create(40, 30);
    Blob blob = {.mean = {21, 13}, .sigma_x = 9, .sigma_y = 4, .theta_rad = 0.6, .rgb = {1, 1, 1}, .opacity = 0.9};
    scene2d_add(&scene, &blob);
    RasterSettings settings = raster_settings_default();
    View2d fit = view2d_fit(&scene, 80, 80);
    assert_true(fit.zoom == 2 && fit.left == 0 && fit.top == -5);
    ImageF small = draw(&scene, &settings, view2d_whole(), 40, 30), large = draw(&scene, &settings, fit, 80, 80);
    for (int y = 4; y < 26; y++)
        for (int x = 4; x < 36; x++) {
            double around = 0;
            for (int k = 0; k < 4; k++)
                around += (double)large.values[3 * ((2 * y + 10 + k / 2) * 80 + 2 * x + k % 2)] / 4;
            support_near(around, (double)small.values[3 * (y * 40 + x)], 0.01, "pixel");
        }
    imagef_destroy(&small);
    imagef_destroy(&large);
    scene2d_destroy(&scene);
}

static void the_unattenuated_background_shines_through_what_is_opaque(void **state) {
    (void)state;
    Scene2d scene = scene2d_create(9, 9);
    for (int c = 0; c < 3; c++) scene.background[c] = 0.5;
    Blob blob = {.mean = {4.5, 4.5}, .sigma_x = 50, .sigma_y = 50, .rgb = {0.75, 0.25, 0}, .opacity = 1};
    for (int i = 0; i < 3; i++) scene2d_add(&scene, &blob);
    RasterSettings settings = raster_settings_default();
    ImageF right = draw(&scene, &settings, view2d_whole(), 9, 9);
    settings.background_unattenuated = true;
    ImageF lesson = draw(&scene, &settings, view2d_whole(), 9, 9);
    const float *a = right.values + 3 * 40, *b = lesson.values + 3 * 40;
    support_near((double)a[0], 0.75, 1e-4, "opaque: the blob's colour");
    for (int c = 0; c < 3; c++) support_near((double)(b[c] - a[c]), 0.5, 1e-4, "the whole background on top of it");
    imagef_destroy(&right);
    imagef_destroy(&lesson);
    scene2d_destroy(&scene);
}

static void discs_end_at_one_standard_deviation(void **state) {
    (void)state;
    Scene2d scene = scene2d_create(64, 64);
    Blob blob = {.mean = {32, 32}, .sigma_x = 20, .sigma_y = 6, .theta_rad = 0.5, .rgb = {1, 1, 1}, .opacity = 0.5};
    scene2d_add(&scene, &blob);
    RasterSettings settings = raster_settings_default();
    settings.discs = true;
    ImageF picture = draw(&scene, &settings, view2d_whole(), 64, 64);
    double area = 0;
    for (int i = 0; i < 64 * 64; i++) {
        assert_true(picture.values[3 * i] == 0 || picture.values[3 * i] == 0.5f);
        area += picture.values[3 * i] > 0;
    }
    support_near(area, M_PI * 20 * 6, 10, "area of the ellipse");
    imagef_destroy(&picture);
    scene2d_destroy(&scene);
}

// ---- order and ends ----

static void order_matters_and_ties_go_by_index(void **state) {
    (void)state;
    Scene2d scene = scene2d_create(3, 3);
    scene.background[2] = 1;
    Blob red = {.mean = {1.5, 1.5}, .sigma_x = 9, .sigma_y = 9, .rgb = {1, 0, 0}, .opacity = 0.6, .depth = 1};
    Blob green = {.mean = {1.5, 1.5}, .sigma_x = 9, .sigma_y = 9, .rgb = {0, 1, 0}, .opacity = 0.5, .depth = 1};
    scene2d_add(&scene, &red);
    scene2d_add(&scene, &green);
    RasterSettings settings = raster_settings_default();
    ImageF tie = draw(&scene, &settings, view2d_whole(), 3, 3);
    const float *centre = tie.values + 3 * 4;
    support_near((double)centre[0], 0.6, 1e-6, "red in front");
    support_near((double)centre[1], 0.4 * 0.5, 1e-6, "green behind");
    support_near((double)centre[2], 0.4 * 0.5, 1e-6, "background");
    scene.blobs[1].depth = 0.5;
    ImageF swapped = draw(&scene, &settings, view2d_whole(), 3, 3);
    // What pops is a1 a2 |c1 - c2| of each channel, with nothing in front of the two.
    support_near((double)(swapped.values[12] - centre[0]), -0.6 * 0.5, 1e-6, "red jumps");
    support_near((double)(swapped.values[13] - centre[1]), 0.6 * 0.5, 1e-6, "green jumps");
    support_near((double)(swapped.values[14] - centre[2]), 0, 1e-6, "the background stays");
    imagef_destroy(&tie);
    imagef_destroy(&swapped);
    scene2d_destroy(&scene);
}

static void an_opaque_pixel_visits_nothing_behind_it(void **state) {
    (void)state;
    Scene2d scene = scene2d_create(8, 8);
    Blob blob = {.mean = {4, 4}, .sigma_x = 500, .sigma_y = 500, .rgb = {1, 1, 1}, .opacity = 1};
    for (int i = 0; i < 50; i++) scene2d_add(&scene, &blob);
    Raster2d raster = {0};
    ImageF picture = imagef_create(8, 8, 3);
    int visits[64];
    RasterMaps maps = {.visits = visits};
    RasterSettings settings = raster_settings_default();
    raster2d_load(&raster, &scene, view2d_whole());
    raster2d_draw(&raster, &settings, &picture, &maps);
    // alpha 0.99 three times leaves T = 1e-6 < 1e-4; two leave about 1e-4, on one side of it or the other.
    for (int i = 0; i < 64; i++) assert_in_range(visits[i], 2, 3);
    settings.rule.stop = 0;
    raster2d_draw(&raster, &settings, &picture, &maps);
    for (int i = 0; i < 64; i++) assert_int_equal(visits[i], 50);
    raster2d_destroy(&raster);
    imagef_destroy(&picture);
    scene2d_destroy(&scene);
}

// The two bounds of early termination: blending before stopping leaves at most `stop` unseen, stopping before blending up to
// stop / (1 - alpha_max).
static void early_termination_stays_within_its_bounds(void **state) {
    (void)state;
    double worst[2] = {0};
    for (uint32_t seed = 1; seed <= SCENES; seed++) {
        Scene2d scene = random_scene(seed, 300);
        RasterSettings all = raster_settings_default();
        all.rule.stop = 0;
        ImageF exact = draw(&scene, &all, view2d_whole(), 83, 59);
        for (int r = 0; r < 2; r++) {
            RasterSettings settings = raster_settings_default();
            settings.rule.rule = r ? STOP_BEFORE_BLEND : STOP_AFTER_BLEND;
            settings.rule.stop = 0.01;
            ImageF picture = draw(&scene, &settings, view2d_whole(), 83, 59);
            for (int i = 0; i < 83 * 59 * 3; i++)
                worst[r] = fmax(worst[r], fabs((double)exact.values[i] - (double)picture.values[i]));
            imagef_destroy(&picture);
        }
        imagef_destroy(&exact);
        scene2d_destroy(&scene);
    }
    assert_true(worst[0] <= 0.01 && worst[0] > 1e-3);
    assert_true(worst[1] > 0.01 && worst[1] <= 0.01 / (1 - 0.99));
}

// ---- raw covariances ----

static void shapes_are_told_apart(void **state) {
    (void)state;
    assert_int_equal(shape_of((Sym2){2, 1, 2}), SHAPE_VALID);
    assert_int_equal(shape_of((Sym2){2, 2, 2}), SHAPE_FLAT);
    assert_int_equal(shape_of((Sym2){2, 3, 2}), SHAPE_INDEFINITE);
    assert_int_equal(shape_of((Sym2){-2, 1, -2}), SHAPE_NEGATIVE);
    assert_int_equal(shape_of((Sym2){NAN, 1, 2}), SHAPE_FLAT);
}

static Scene2d one_blob(void) {
    Scene2d scene = scene2d_create(41, 31);
    Blob blob = {
        .mean = {20.5, 15.5}, .sigma_x = 7, .sigma_y = 3, .theta_rad = 0.4, .rgb = {1, 0.5, 0}, .opacity = 0.8};
    scene2d_add(&scene, &blob);
    return scene;
}

static void a_valid_raw_covariance_draws_the_blob_it_belongs_to(void **state) {
    (void)state;
    Scene2d scene = one_blob();
    RasterSettings settings = raster_settings_default();
    View2d view = {.left = -2, .top = 3, .zoom = 1.5};
    ImageF expected = draw(&scene, &settings, view, 70, 50), picture = imagef_create(70, 50, 3);
    Sym2 sigma = blob_covariance(&scene.blobs[0]);
    scene.blobs[0].sigma_x = 1, scene.blobs[0].sigma_y = 1;
    Raster2d raster = {0};
    raster2d_load(&raster, &scene, view);
    assert_int_equal(raster2d_set_covariance(&raster, 0, sigma), SHAPE_VALID);
    raster2d_draw(&raster, &settings, &picture, NULL);
    for (int i = 0; i < 70 * 50 * 3; i++)
        support_near((double)picture.values[i], (double)expected.values[i], 2e-6, "pixel");
    raster2d_destroy(&raster);
    imagef_destroy(&picture);
    imagef_destroy(&expected);
    scene2d_destroy(&scene);
}

// xx = 16, yy = -4: along y the "Gaussian" grows, so the ends of the middle column are at the clamp; its row still falls off.
static void an_indefinite_covariance_blows_up_along_one_axis(void **state) {
    (void)state;
    Scene2d scene = one_blob();
    RasterSettings settings = raster_settings_default();
    Raster2d raster = {0};
    ImageF picture = imagef_create(41, 31, 3);
    raster2d_load(&raster, &scene, view2d_whole());
    assert_int_equal(raster2d_set_covariance(&raster, 0, (Sym2){16, 0, -4}), SHAPE_INDEFINITE);
    raster2d_draw(&raster, &settings, &picture, NULL);
    support_near((double)picture.values[3 * 20], 0.99, 1e-6, "top of the column");
    support_near((double)picture.values[3 * (30 * 41 + 20)], 0.99, 1e-6, "its bottom");
    support_near((double)picture.values[3 * (15 * 41 + 20)], 0.8, 1e-6, "centre");
    support_near((double)picture.values[3 * (15 * 41)], 0, 1e-6, "end of the row");
    compare_with_walks(&raster, &settings, 41, 31, "indefinite");
    assert_int_equal(raster2d_set_covariance(&raster, 0, (Sym2){-16, 3, -4}), SHAPE_NEGATIVE);
    compare_with_walks(&raster, &settings, 41, 31, "negative");
    assert_int_equal(raster2d_set_covariance(&raster, 0, (Sym2){4, 4, 4}), SHAPE_FLAT);
    raster2d_draw(&raster, &settings, &picture, NULL);
    for (int i = 0; i < 41 * 31 * 3; i++) assert_true(picture.values[i] == 0);
    raster2d_destroy(&raster);
    imagef_destroy(&picture);
    scene2d_destroy(&scene);
}

static void needles_and_points_draw_without_nan(void **state) {
    (void)state;
    const double sigmas[][2] = {{1e5, 1e-3}, {1e-9, 1e-9}, {1e5, 1e5}, {30, 0}, {0, 0}, {1e-300, 5}};
    for (size_t k = 0; k < sizeof sigmas / sizeof sigmas[0]; k++) {
        Scene2d scene = one_blob();
        scene.blobs[0].sigma_x = sigmas[k][0], scene.blobs[0].sigma_y = sigmas[k][1];
        const RasterSettings all[] = {raster_settings_default(), raster_settings_lesson()};
        for (int s = 0; s < 2; s++) {
            ImageF picture = draw(&scene, &all[s], view2d_whole(), 41, 31);
            for (int i = 0; i < 41 * 31 * 3; i++) assert_true(picture.values[i] >= 0 && picture.values[i] <= 0.80001f);
            imagef_destroy(&picture);
        }
        scene2d_destroy(&scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_pixel_is_what_its_walk_says),
        cmocka_unit_test(one_thread_or_many_draw_the_same_bytes),
        cmocka_unit_test(an_empty_scene_is_its_background),
        cmocka_unit_test(a_view_shows_the_canvas_where_it_is),
        cmocka_unit_test(the_unattenuated_background_shines_through_what_is_opaque),
        cmocka_unit_test(discs_end_at_one_standard_deviation),
        cmocka_unit_test(order_matters_and_ties_go_by_index),
        cmocka_unit_test(an_opaque_pixel_visits_nothing_behind_it),
        cmocka_unit_test(early_termination_stays_within_its_bounds),
        cmocka_unit_test(shapes_are_told_apart),
        cmocka_unit_test(a_valid_raw_covariance_draws_the_blob_it_belongs_to),
        cmocka_unit_test(an_indefinite_covariance_blows_up_along_one_axis),
        cmocka_unit_test(needles_and_points_draw_without_nan),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
