// test_pixel_walk.c - the walk against back-to-front "over" in long double, and what it says about each step.
#include "splat2d/pixel_walk.h"

#include "lab/base/rng.h"
#include "tests/support/support.h"

#include <math.h>

enum { SEEDS = 200, BLOBS = 15 };

static Scene2d random_scene(uint32_t seed) {
    Rng rng = rng_at(seed, RNG_TEST, 3, 0);
    Scene2d scene = scene2d_create(32, 32);
    for (int c = 0; c < 3; c++) scene.background[c] = rng_uniform(&rng);
    for (int i = 0; i < BLOBS; i++) {
        Blob blob = {.mean = {rng_range(&rng, 0, 32), rng_range(&rng, 0, 32)},
                     .sigma_x = rng_range(&rng, 2, 20),
                     .sigma_y = rng_range(&rng, 2, 20),
                     .theta_rad = rng_range(&rng, 0, 7),
                     .rgb = {rng_uniform(&rng), rng_uniform(&rng), rng_uniform(&rng)},
                     .opacity = rng_range(&rng, 0, 0.9),
                     .depth = rng_normal(&rng)};
        scene2d_add(&scene, &blob);
    }
    return scene;
}

// From the back, straight from the blobs' angles and scales.
static void over_from_the_back(const Scene2d *scene, double x, double y, long double rgb[3]) {
    int order[BLOBS];
    scene2d_order(scene, order);
    for (int c = 0; c < 3; c++) rgb[c] = scene->background[c];
    for (int rank = BLOBS - 1; rank >= 0; rank--) {
        const Blob *blob = &scene->blobs[order[rank]];
        long double cosine = cosl(blob->theta_rad), sine = sinl(blob->theta_rad);
        long double dx = x - blob->mean[0], dy = y - blob->mean[1];
        long double u = (cosine * dx + sine * dy) / blob->sigma_x, v = (cosine * dy - sine * dx) / blob->sigma_y;
        long double alpha = blob->opacity * expl(-(u * u + v * v) / 2);
        for (int c = 0; c < 3; c++) rgb[c] = alpha * blob->rgb[c] + (1 - alpha) * rgb[c];
    }
}

static void the_walk_is_over_from_the_back(void **state) {
    (void)state;
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        char what[32];
        snprintf(what, sizeof what, "seed %u", seed);
        Scene2d scene = random_scene(seed);
        Raster2d raster = {0};
        RasterSettings settings = {.rule = {.alpha_max = 1, .alpha_min = 0, .stop = 0}};
        WalkStep steps[BLOBS];
        raster2d_load(&raster, &scene, view2d_whole());
        WalkResult walk = pixel_walk(&raster, &settings, 13.5, 20.5, steps);
        long double expected[3];
        over_from_the_back(&scene, 13.5, 20.5, expected);
        for (int c = 0; c < 3; c++) support_near(walk.rgb[c], (double)expected[c], 1e-14 * BLOBS, what);
        support_near(walk.weights + walk.transmittance, 1, 1e-14, what);
        assert_int_equal(walk.blended, BLOBS);
        raster2d_destroy(&raster);
        scene2d_destroy(&scene);
    }
}

static void each_step_says_what_it_did(void **state) {
    (void)state;
    Scene2d scene = scene2d_create(10, 10);
    scene.background[0] = 1;
    Blob blob = {.mean = {5, 5}, .sigma_x = 2, .sigma_y = 2, .rgb = {0, 1, 0}, .opacity = 0.5, .depth = 1};
    scene2d_add(&scene, &blob); // 0: blended, at one sigma
    blob.opacity = 1, blob.depth = 3, blob.sigma_x = blob.sigma_y = 1e4;
    scene2d_add(&scene, &blob); // 1: blended, clamped
    blob.depth = 4;
    scene2d_add(&scene, &blob); // 2: blended, makes it opaque
    blob.depth = 5;
    scene2d_add(&scene, &blob); // 3: hidden
    blob.depth = 2, blob.opacity = 0.003;
    scene2d_add(&scene, &blob); // 4: faint, between 0 and 1
    blob.depth = 0, blob.sigma_x = 0, blob.opacity = 1;
    scene2d_add(&scene, &blob); // 5: flat, in front
    Raster2d raster = {0};
    RasterSettings settings = raster_settings_default();
    WalkStep steps[6];
    raster2d_load(&raster, &scene, view2d_whole());
    WalkResult walk = pixel_walk(&raster, &settings, 7, 5, steps);

    const int indices[6] = {5, 0, 4, 1, 2, 3};
    const StepKind kinds[6] = {STEP_FLAT, STEP_BLENDED, STEP_FAINT, STEP_BLENDED, STEP_BLENDED, STEP_HIDDEN};
    for (int i = 0; i < 6; i++) {
        assert_int_equal(steps[i].index, indices[i]);
        assert_int_equal(steps[i].kind, kinds[i]);
        support_near(steps[i].depth, scene.blobs[indices[i]].depth, 0, "depth");
    }
    double g = exp(-0.5), alpha = 0.5 * g;
    support_near(steps[1].m2, 1, 1e-14, "m^2");
    support_near(steps[1].g, g, 1e-14, "g");
    support_near(steps[1].alpha, alpha, 1e-14, "alpha");
    support_near(steps[1].before, 1, 0, "T before");
    support_near(steps[1].weight, alpha, 1e-14, "weight");
    support_near(steps[1].rgb[0], 1 - alpha, 1e-14, "red so far: what is left of the background");
    support_near(steps[1].rgb[1], alpha, 1e-14, "green so far");
    support_near(steps[2].weight, 0, 0, "a faint one weighs nothing");
    support_near(steps[3].before, 1 - alpha, 1e-14, "T before");
    support_near(steps[3].alpha, (double)0.99f, 1e-14, "clamped");
    support_near(steps[5].weight, 0, 0, "a hidden one weighs nothing");
    support_near(steps[5].before, walk.transmittance, 0, "T at the end");
    assert_int_equal(walk.blended, 3);
    support_near(walk.weights + walk.transmittance, 1, 1e-14, "sum");

    settings.rule.rule = STOP_BEFORE_BLEND;
    pixel_walk(&raster, &settings, 7, 5, steps);
    assert_int_equal(steps[4].kind, STEP_HIDDEN); // the one that would make it opaque
    raster2d_destroy(&raster);
    scene2d_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_walk_is_over_from_the_back),
        cmocka_unit_test(each_step_says_what_it_did),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
