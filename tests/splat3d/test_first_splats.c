#include "splat3d/first_splats.h"
#include "tests/support/support.h"

#include <math.h>

static void a_point_becomes_a_round_faint_splat_of_its_colour(void **state) {
    (void)state;
    Points p = points_create(4); // the corners of a unit square: distances 1, 1, sqrt(2) from each
    for (int i = 0; i < 4; i++)
        p.xyz[3 * i] = i % 2, p.xyz[3 * i + 1] = i / 2, p.rgb[3 * i] = 255, p.rgb[3 * i + 1] = 51;
    Gaussians g = first_splats_from_points(&p, 3, 0.1);
    assert_int_equal(g.count, 4);
    for (int i = 0; i < 4; i++) {
        for (int a = 0; a < 3; a++) {
            support_near(gaussians_at(&g, FIELD_MEAN, i)[a], p.xyz[3 * i + a], 1e-7, "mean");
            support_near(exp(gaussians_at(&g, FIELD_LOG_SCALE, i)[a]), sqrt(4.0 / 3), 1e-6,
                         "root mean squared distance");
        }
        support_near(1 / (1 + exp(-*gaussians_at(&g, FIELD_OPACITY_LOGIT, i))), 0.1, 1e-7, "opacity");
        support_near(0.5 + gaussians_at(&g, FIELD_SH0, i)[0] / (2 * sqrt(M_PI)), 1.0, 1e-6, "red");
        support_near(0.5 + gaussians_at(&g, FIELD_SH0, i)[1] / (2 * sqrt(M_PI)), 0.2, 1e-6, "green");
        support_near(gaussians_at(&g, FIELD_QUAT, i)[0], 1, 0, "no rotation");
        for (int k = 0; k < 21; k++) support_near(gaussians_at(&g, FIELD_SH3, i)[k], 0, 0, "higher degrees");
    }
    gaussians_destroy(&g);
    points_destroy(&p);
}

static void splats_come_along_the_curve_through_space_with_their_own_colours(void **state) {
    (void)state;
    Points p = points_create(8); // the corners of a cube, last one first
    for (int i = 0; i < 8; i++)
        for (int a = 0; a < 3; a++) p.xyz[3 * i + a] = (7 - i) >> a & 1, p.rgb[3 * i + a] = (uint8_t)(10 * i);
    Gaussians g = first_splats_from_points(&p, 0, 0.1);
    for (int i = 0; i < 8; i++) {
        for (int a = 0; a < 3; a++) support_near(gaussians_at(&g, FIELD_MEAN, i)[a], i >> a & 1, 0, "mean");
        support_near(0.5 + gaussians_at(&g, FIELD_SH0, i)[0] / (2 * sqrt(M_PI)), 10 * (7 - i) / 255.0, 1e-6, "red");
    }
    gaussians_destroy(&g);
    points_destroy(&p);
}

static void points_at_one_place_still_get_an_extent(void **state) {
    (void)state;
    Points p = points_create(5);
    Gaussians g = first_splats_from_points(&p, 0, 0.1);
    for (int i = 0; i < 5; i++) assert_true(isfinite(gaussians_at(&g, FIELD_LOG_SCALE, i)[0]));
    support_near(exp(gaussians_at(&g, FIELD_LOG_SCALE, 0)[0]), sqrt(1e-7), 1e-9, "smallest scale");
    gaussians_destroy(&g);
    points_destroy(&p);
}

static void random_points_fill_the_cube_and_depend_on_the_seed(void **state) {
    (void)state;
    Dataset d = {.init_half_width = 1.3, .init_centre = vec3(1, 2, 3)};
    Points a = first_splats_random_points(&d, 3000, 1), b = first_splats_random_points(&d, 3000, 1);
    Points c = first_splats_random_points(&d, 3000, 2);
    assert_memory_equal(a.xyz, b.xyz, 3000 * 3 * sizeof(double));
    assert_memory_not_equal(a.xyz, c.xyz, 3000 * 3 * sizeof(double));
    double mean[3] = {0};
    for (int i = 0; i < 3000; i++)
        for (int k = 0; k < 3; k++) {
            mean[k] += a.xyz[3 * i + k] / 3000;
            support_near(a.xyz[3 * i + k], 1 + k, 1.3, "inside the cube");
        }
    for (int k = 0; k < 3; k++) support_near(mean[k], 1 + k, 0.07, "centre"); // 5 sigma: 1.3 / sqrt(3 x 3000) x 5
    points_destroy(&a);
    points_destroy(&b);
    points_destroy(&c);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_point_becomes_a_round_faint_splat_of_its_colour),
        cmocka_unit_test(splats_come_along_the_curve_through_space_with_their_own_colours),
        cmocka_unit_test(points_at_one_place_still_get_an_extent),
        cmocka_unit_test(random_points_fill_the_cube_and_depend_on_the_seed),
    };
    return cmocka_run_group_tests_name("first_splats", tests, NULL, NULL);
}
