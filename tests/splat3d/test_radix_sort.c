#include "splat3d/radix_sort.h"

#include "lab/base/mem.h"
#include "lab/base/rng.h"
#include "tests/support/support.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

// Sorts `count` depths; checks that each comes once, nearest first, equal ones by index.
static void check_order(const float *depth, int count) {
    uint64_t *keys = mem_alloc((size_t)count, sizeof *keys), *scratch = mem_alloc((size_t)count, sizeof *scratch);
    uint32_t *order = mem_alloc((size_t)count, sizeof *order);
    bool *met = mem_alloc((size_t)count, sizeof *met);
    for (int i = 0; i < count; i++) keys[i] = radix_key_depth(depth[i], (uint32_t)i);
    radix_sort(count, keys, scratch, order);
    for (int r = 0; r < count; r++) {
        assert_in_range(order[r], 0, count - 1);
        assert_false(met[order[r]]);
        met[order[r]] = true;
        if (!r) continue;
        const uint32_t a = order[r - 1], b = order[r];
        if (!(depth[a] < depth[b] || (depth[a] == depth[b] && a < b)))
            fail_msg("rank %d: splat %u at %g stands before splat %u at %g", r, a, depth[a], b, depth[b]);
    }
    mem_free(keys);
    mem_free(scratch);
    mem_free(order);
    mem_free(met);
}

static void random_depths_of_all_magnitudes_come_out_nearest_first(void **state) {
    (void)state;
    enum { COUNT = 5000 };
    static float depth[COUNT];
    for (uint32_t seed = 1; seed <= 5; seed++) {
        Rng rng = rng_at(seed, RNG_TEST, 0, 0);
        for (int i = 0; i < COUNT; i++) depth[i] = (float)exp(rng_range(&rng, -80, 80));
        print_message("seed %u\n", seed);
        check_order(depth, COUNT);
    }
}

static void equal_depths_keep_the_order_of_their_indices(void **state) {
    (void)state;
    enum { COUNT = 3000 };
    static float depth[COUNT];
    for (int i = 0; i < COUNT; i++) depth[i] = (float)(1 + i * 7 % 5);
    check_order(depth, COUNT);
}

static void neighbouring_floats_and_extremes_are_told_apart(void **state) {
    (void)state;
    const float depth[] = {FLT_MAX, nextafterf(2, 3), 2, nextafterf(2, 1), FLT_MIN, 0, FLT_TRUE_MIN, INFINITY, 1};
    check_order(depth, sizeof depth / sizeof *depth);
}

static void nothing_and_one_splat_are_sorted_too(void **state) {
    (void)state;
    const float depth = 3;
    check_order(&depth, 0);
    check_order(&depth, 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_depths_of_all_magnitudes_come_out_nearest_first),
        cmocka_unit_test(equal_depths_keep_the_order_of_their_indices),
        cmocka_unit_test(neighbouring_floats_and_extremes_are_told_apart),
        cmocka_unit_test(nothing_and_one_splat_are_sorted_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
