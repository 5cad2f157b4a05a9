#include "lab/base/mem.h"
#include "lab/base/rng.h"
#include "splat3d/kd_tree.h"
#include "tests/support/support.h"

#include <stdlib.h>

static int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// Clustered, with points at the same place: the cases in which a tree goes wrong.
static double *clustered_points(uint64_t seed, int count) {
    double *xyz = mem_alloc((size_t)count, 3 * sizeof(double));
    for (int i = 0; i < count; i++) {
        Rng rng = rng_at(seed, RNG_TEST, (uint32_t)i, 0);
        double size = rng_below(&rng, 3) ? 1 : 100;
        for (int a = 0; a < 3; a++) xyz[3 * i + a] = size * rng_normal(&rng);
        if (i > 0 && rng_below(&rng, 10) == 0)
            for (int a = 0; a < 3; a++) xyz[3 * i + a] = xyz[3 * (i - 1) + a];
    }
    return xyz;
}

static void check_against_all_pairs(uint64_t seed, int count, int k) {
    double *xyz = clustered_points(seed, count), *all = mem_alloc((size_t)count, sizeof(double));
    KdTree tree = kd_tree_create(xyz, count);
    for (int i = 0; i < count; i++) {
        int others = 0;
        for (int j = 0; j < count; j++) {
            double d2 = 0;
            for (int a = 0; a < 3; a++) d2 += (xyz[3 * j + a] - xyz[3 * i + a]) * (xyz[3 * j + a] - xyz[3 * i + a]);
            if (j != i) all[others++] = d2;
        }
        qsort(all, (size_t)others, sizeof *all, ascending);
        double found[KD_NEIGHBOURS_MAX];
        int n = kd_tree_nearest(&tree, xyz + 3 * i, i, k, found);
        assert_int_equal(n, others < k ? others : k);
        for (int j = 0; j < n; j++)
            if (found[j] != all[j])
                fail_msg("seed %d, point %d, neighbour %d: %g, want %g", (int)seed, i, j, found[j], all[j]);
    }
    kd_tree_destroy(&tree);
    mem_free(xyz);
    mem_free(all);
}

static void neighbours_are_those_of_a_search_over_all_pairs(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 8; seed++) check_against_all_pairs(seed, 300, 3);
    check_against_all_pairs(99, 500, KD_NEIGHBOURS_MAX);
}

static void small_clouds_have_fewer_neighbours(void **state) {
    (void)state;
    for (int count = 1; count < 5; count++) check_against_all_pairs(7, count, 3);
}

// Each search ends at once; if it went through all points, this would take minutes.
static void a_heap_of_points_at_one_place_is_done_quickly(void **state) {
    (void)state;
    enum { COUNT = 300000 };
    double *xyz = mem_alloc(COUNT, 3 * sizeof(double)), *mean = mem_alloc(COUNT, sizeof(double));
    KdTree tree = kd_tree_create(xyz, COUNT);
    kd_tree_mean_distance2(&tree, 3, mean);
    for (int i = 0; i < COUNT; i++) assert_true(mean[i] == 0);
    kd_tree_destroy(&tree);
    mem_free(xyz);
    mem_free(mean);
}

static void mean_distance_on_a_lattice_is_its_spacing(void **state) {
    (void)state;
    double xyz[27 * 3], mean[27];
    for (int i = 0; i < 27; i++)
        xyz[3 * i] = 2 * (i % 3), xyz[3 * i + 1] = 2 * (i / 3 % 3), xyz[3 * i + 2] = 2 * (i / 9);
    KdTree tree = kd_tree_create(xyz, 27);
    kd_tree_mean_distance2(&tree, 3, mean);
    for (int i = 0; i < 27; i++) support_near(mean[i], 4, 0, "squared spacing");
    kd_tree_destroy(&tree);
}

static void a_lone_point_has_no_distance(void **state) {
    (void)state;
    double xyz[3] = {1, 2, 3}, mean = -1;
    KdTree tree = kd_tree_create(xyz, 1);
    kd_tree_mean_distance2(&tree, 3, &mean);
    support_near(mean, 0, 0, "mean squared distance");
    kd_tree_destroy(&tree);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(neighbours_are_those_of_a_search_over_all_pairs),
        cmocka_unit_test(small_clouds_have_fewer_neighbours),
        cmocka_unit_test(a_heap_of_points_at_one_place_is_done_quickly),
        cmocka_unit_test(mean_distance_on_a_lattice_is_its_spacing),
        cmocka_unit_test(a_lone_point_has_no_distance),
    };
    return cmocka_run_group_tests_name("kd_tree", tests, NULL, NULL);
}
