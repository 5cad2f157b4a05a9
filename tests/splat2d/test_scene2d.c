// test_scene2d.c - shapes of blobs against GSL's eigen solver, edits, and the order in depth.
#include "splat2d/scene2d.h"

#include "lab/base/fail.h"
#include "lab/base/rng.h"
#include "tests/support/support.h"

#include <float.h>
#include <gsl/gsl_eigen.h>
#include <math.h>
#include <string.h>

enum { SEEDS = 300 };

static Blob some_blob(double depth) {
    return (Blob){.mean = {10, 20}, .sigma_x = 3, .sigma_y = 2, .rgb = {1, 0.5, 0}, .opacity = 0.8, .depth = depth};
}

static Scene2d scene_of_depths(const double *depths, int count) {
    Scene2d scene = scene2d_create(100, 80);
    for (int i = 0; i < count; i++) {
        Blob blob = some_blob(depths[i]);
        blob.mean[0] = i; // a mark that shows which one it was
        assert_int_equal(scene2d_add(&scene, &blob), i);
    }
    return scene;
}

// ---- shapes ----

static void gsl_eigenvalues(Sym2 a, double *major, double *minor) {
    double entries[4] = {a.xx, a.xy, a.xy, a.yy};
    gsl_matrix_view matrix = gsl_matrix_view_array(entries, 2, 2);
    gsl_vector *values = gsl_vector_alloc(2);
    gsl_eigen_symm_workspace *work = gsl_eigen_symm_alloc(2);
    gsl_eigen_symm(&matrix.matrix, values, work);
    *major = gsl_vector_max(values);
    *minor = gsl_vector_min(values);
    gsl_eigen_symm_free(work);
    gsl_vector_free(values);
}

static void near_shape(Sym2 a, Sym2 b, double tolerance, const char *what) {
    support_near(a.xx, b.xx, tolerance, what);
    support_near(a.xy, b.xy, tolerance, what);
    support_near(a.yy, b.yy, tolerance, what);
}

// Scales over six decades and angles over several turns. What can be asked of three stored doubles is eps times the largest.
static void the_eigenvalues_are_the_squared_scales(void **state) {
    (void)state;
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        char name[32];
        snprintf(name, sizeof name, "seed %u", seed);
        Rng rng = rng_at(seed, RNG_TEST, 0, 0);
        double theta = rng_range(&rng, -4 * M_PI, 4 * M_PI);
        double sx = pow(10, rng_range(&rng, -3, 3)), sy = pow(10, rng_range(&rng, -3, 3));
        Blob blob = {.sigma_x = sx, .sigma_y = sy, .theta_rad = theta};
        Sym2 sigma = blob_covariance(&blob);
        double big = fmax(sx * sx, sy * sy), small = fmin(sx * sx, sy * sy), tolerance = 8 * DBL_EPSILON * big;
        double major, minor;
        gsl_eigenvalues(sigma, &major, &minor);
        support_near(major, big, tolerance, name);
        support_near(minor, small, tolerance, name);
        support_near(sym2_determinant(sigma), big * small, 8 * DBL_EPSILON * big * big, name);

        Blob half_turn = {.sigma_x = sx, .sigma_y = sy, .theta_rad = theta + M_PI};
        near_shape(blob_covariance(&half_turn), sigma, 32 * DBL_EPSILON * big, name);
        Blob swapped = {.sigma_x = sy, .sigma_y = sx, .theta_rad = theta + M_PI / 2};
        near_shape(blob_covariance(&swapped), sigma, 32 * DBL_EPSILON * big, name);
        Blob round = {.sigma_x = sx, .sigma_y = sx, .theta_rad = theta};
        near_shape(blob_covariance(&round), (Sym2){sx * sx, 0, sx * sx}, 8 * DBL_EPSILON * sx * sx, name);
    }
}

static void a_scale_of_zero_gives_rank_one_and_no_conic(void **state) {
    (void)state;
    Blob blob = {.sigma_x = 5, .sigma_y = 0, .theta_rad = 0.7};
    Sym2 sigma = blob_covariance(&blob), conic;
    double major, minor;
    gsl_eigenvalues(sigma, &major, &minor);
    support_near(major, 25, 1e-13, "the axis that is left");
    support_near(minor, 0, 1e-14, "the other");
    assert_false(blob_conic(&blob, &conic));
    blob.sigma_x = 0;
    sigma = blob_covariance(&blob);
    assert_true(sigma.xx == 0 && sigma.xy == 0 && sigma.yy == 0);
    assert_false(blob_conic(&blob, &conic));
}

// Aspect 1e6: the computed Sigma has lost its small eigenvalue and with it the inverse, the conic from the scales has not.
static void the_conic_keeps_its_digits_at_an_extreme_aspect(void **state) {
    (void)state;
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        Rng rng = rng_at(seed, RNG_TEST, 1, 0);
        Blob blob = {.sigma_x = 1e4, .sigma_y = 1e-2, .theta_rad = rng_range(&rng, -7, 7)};
        Sym2 conic;
        assert_true(blob_conic(&blob, &conic));
        double c = cos(blob.theta_rad), s = sin(blob.theta_rad), v = rng_range(&rng, -2, 2) * blob.sigma_y;
        double distance2 = conic_mahalanobis2(conic, -s * v, c * v); // across the needle
        support_near(distance2, v * v / 1e-4, 1e-9, "Mahalanobis");
    }
}

// ---- edits ----

static void blobs_come_and_go_and_the_others_keep_their_order(void **state) {
    (void)state;
    const double depths[4] = {3, 1, 2, 0};
    Scene2d scene = scene_of_depths(depths, 4);
    scene2d_remove(&scene, 1);
    assert_int_equal(scene.count, 3);
    assert_true(scene.blobs[0].mean[0] == 0 && scene.blobs[1].mean[0] == 2 && scene.blobs[2].mean[0] == 3);
    scene2d_remove(&scene, 2);
    scene2d_remove(&scene, 0);
    scene2d_remove(&scene, 0);
    assert_int_equal(scene.count, 0);
    assert_int_equal(scene2d_pick(&scene, 0, 0, 1), -1);
    scene2d_destroy(&scene);
    scene2d_destroy(&scene);
}

static void a_duplicate_lies_right_behind_its_original(void **state) {
    (void)state;
    const double depths[3] = {1, 1, 2};
    for (int original = 0; original < 3; original++) {
        Scene2d scene = scene_of_depths(depths, 3);
        int copy = scene2d_duplicate(&scene, original);
        assert_int_equal(copy, 3);
        assert_true(scene.blobs[copy].mean[0] == scene.blobs[original].mean[0]);
        assert_int_equal(scene2d_rank(&scene, copy), scene2d_rank(&scene, original) + 1);
        assert_int_equal(scene2d_rank(&scene, original), original);
        scene2d_destroy(&scene);
    }
}

static void a_full_scene_takes_no_more(void **state) {
    (void)state;
    Scene2d scene = scene2d_create(10, 10);
    Blob blob = some_blob(0);
    for (int i = 0; i < SCENE2D_BLOBS_MAX; i++) scene2d_add(&scene, &blob);
    assert_int_equal(scene2d_add(&scene, &blob), -1);
    assert_int_equal(scene2d_duplicate(&scene, 5), -1);
    assert_int_equal(scene.count, SCENE2D_BLOBS_MAX);
    assert_non_null(strstr(fail_text(), "100000"));
    scene2d_destroy(&scene);
}

static void a_copy_is_its_own(void **state) {
    (void)state;
    Scene2d scene = scene2d_default(), copy = scene2d_copy(&scene);
    assert_int_equal(copy.count, 6);
    assert_memory_equal(copy.blobs, scene.blobs, 6 * sizeof(Blob));
    copy.blobs[0].depth = 99;
    assert_true(scene.blobs[0].depth != 99);
    assert_true(scene2d_check(&scene, "default"));
    scene2d_destroy(&scene);
    scene2d_destroy(&copy);
}

// ---- order ----

static void equal_depths_keep_the_order_of_indices(void **state) {
    (void)state;
    const double depths[6] = {2, 1, 2, 0, 1, 2};
    const int expected[6] = {3, 1, 4, 0, 2, 5};
    int order[6];
    Scene2d scene = scene_of_depths(depths, 6);
    scene2d_order(&scene, order);
    for (int rank = 0; rank < 6; rank++) {
        assert_int_equal(order[rank], expected[rank]);
        assert_int_equal(scene2d_rank(&scene, expected[rank]), rank);
    }
    scene2d_destroy(&scene);
}

// Any blob to any place, in scenes with and without ties: it stands there, and the others stand as before.
static void set_rank_moves_one_blob_and_no_other(void **state) {
    (void)state;
    enum { COUNT = 7 };
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        Rng rng = rng_at(seed, RNG_TEST, 2, 0);
        double depths[COUNT];
        for (int i = 0; i < COUNT; i++) depths[i] = seed % 2 ? rng_normal(&rng) : (double)rng_below(&rng, 3);
        Scene2d scene = scene_of_depths(depths, COUNT);
        int before[COUNT], after[COUNT], index = (int)rng_below(&rng, COUNT),
                                         rank = (int)rng_below(&rng, COUNT + 4) - 2;
        scene2d_order(&scene, before);
        scene2d_set_rank(&scene, index, rank);
        scene2d_order(&scene, after);
        int place = rank < 0 ? 0 : rank >= COUNT ? COUNT - 1 : rank;
        if (after[place] != index) fail_msg("seed %u: blob %d is not at %d", seed, index, place);
        for (int i = 0, j = 0; i < COUNT; i++) {
            if (before[i] == index) continue;
            if (after[j] == index) j++;
            if (before[i] != after[j++]) fail_msg("seed %u: the others were disturbed", seed);
        }
        scene2d_destroy(&scene);
    }
}

static void a_rank_between_neighbours_without_a_number_renumbers(void **state) {
    (void)state;
    const double depths[3] = {1, 1 + DBL_EPSILON, 5};
    Scene2d scene = scene_of_depths(depths, 3);
    scene2d_set_rank(&scene, 2, 1);
    assert_true(scene.blobs[0].depth == 1 && scene.blobs[2].depth == 2 && scene.blobs[1].depth == 3);
    scene2d_set_rank(&scene, 0, 0); // where it is: nothing changes
    assert_true(scene.blobs[0].depth == 1);
    scene2d_destroy(&scene);
}

static void the_front_blob_under_the_point_is_picked(void **state) {
    (void)state;
    Scene2d scene = scene2d_create(100, 100);
    Blob back = {.mean = {50, 50}, .sigma_x = 30, .sigma_y = 5, .theta_rad = M_PI / 4, .depth = 2};
    Blob front = {.mean = {50, 50}, .sigma_x = 4, .sigma_y = 4, .depth = 1};
    Blob flat = {.mean = {50, 50}, .sigma_x = 5, .sigma_y = 0, .depth = 0};
    scene2d_add(&scene, &back);
    scene2d_add(&scene, &front);
    scene2d_add(&scene, &flat);
    assert_int_equal(scene2d_pick(&scene, 51, 51, 1), 1);
    assert_int_equal(scene2d_pick(&scene, 65, 65, 1), 0);
    assert_int_equal(scene2d_pick(&scene, 65, 35, 1), -1); // inside the box, outside the ellipse
    assert_int_equal(scene2d_pick(&scene, 65, 35, 5), 0);
    scene2d_destroy(&scene);
}

static void every_value_out_of_range_is_named(void **state) {
    (void)state;
    static const struct {
        const char *field;
        size_t offset;
        double value;
    } cases[] = {
        {"mean", offsetof(Blob, mean), NAN},           {"mean", offsetof(Blob, mean) + sizeof(double), 1e9},
        {"sigma_x", offsetof(Blob, sigma_x), -1},      {"sigma_y", offsetof(Blob, sigma_y), INFINITY},
        {"theta_rad", offsetof(Blob, theta_rad), NAN}, {"rgb", offsetof(Blob, rgb) + 2 * sizeof(double), 1.01},
        {"opacity", offsetof(Blob, opacity), -0.1},    {"depth", offsetof(Blob, depth), INFINITY},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const double depths[2] = {0, 1};
        Scene2d scene = scene_of_depths(depths, 2);
        assert_true(scene2d_check(&scene, "here"));
        *(double *)((char *)&scene.blobs[1] + cases[i].offset) = cases[i].value;
        assert_false(scene2d_check(&scene, "here"));
        assert_non_null(strstr(fail_text(), "here, blob 1"));
        assert_non_null(strstr(fail_text(), cases[i].field));
        scene2d_destroy(&scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_eigenvalues_are_the_squared_scales),
        cmocka_unit_test(a_scale_of_zero_gives_rank_one_and_no_conic),
        cmocka_unit_test(the_conic_keeps_its_digits_at_an_extreme_aspect),
        cmocka_unit_test(blobs_come_and_go_and_the_others_keep_their_order),
        cmocka_unit_test(a_duplicate_lies_right_behind_its_original),
        cmocka_unit_test(a_full_scene_takes_no_more),
        cmocka_unit_test(a_copy_is_its_own),
        cmocka_unit_test(equal_depths_keep_the_order_of_indices),
        cmocka_unit_test(set_rank_moves_one_blob_and_no_other),
        cmocka_unit_test(a_rank_between_neighbours_without_a_number_renumbers),
        cmocka_unit_test(the_front_blob_under_the_point_is_picked),
        cmocka_unit_test(every_value_out_of_range_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
