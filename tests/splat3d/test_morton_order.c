#include "splat3d/morton_order.h"

#include "lab/base/rng.h"
#include "tests/support/support.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { COUNT = 4096 };

static void every_point_comes_once(int count, const uint32_t *order) {
    static bool met[COUNT];
    memset(met, 0, sizeof met);
    for (int rank = 0; rank < count; rank++) {
        assert_in_range(order[rank], 0, count - 1);
        assert_false(met[order[rank]]);
        met[order[rank]] = true;
    }
}

// The definition, bit by bit: x's bits are the lowest of each three.
static uint64_t code_of(const uint32_t cell[3]) {
    uint64_t code = 0;
    for (int bit = 0; bit < 21; bit++)
        for (int a = 0; a < 3; a++) code |= (uint64_t)(cell[a] >> bit & 1) << (3 * bit + a);
    return code;
}

static void cells_come_in_the_order_of_their_interleaved_bits(void **state) {
    (void)state;
    static float xyz[3 * COUNT];
    static uint64_t code[COUNT];
    static uint32_t order[COUNT];
    Rng rng = rng_at(7, RNG_TEST, 0, 0);
    for (int i = 0; i < COUNT; i++) {
        uint32_t cell[3];
        for (int a = 0; a < 3; a++) {
            // The first two points span the cube of 2^21 cells; floats hold the middles of all of them.
            cell[a] = i < 2 ? (i ? (1u << 21) - 1 : 0) : (uint32_t)rng_below(&rng, (1 << 21) - 1);
            xyz[3 * i + a] = (float)cell[a] + (i < 2 ? 0 : 0.5f) - 77;
        }
        code[i] = code_of(cell);
    }
    morton_order(COUNT, xyz, order);
    every_point_comes_once(COUNT, order);
    for (int rank = 1; rank < COUNT; rank++)
        if (code[order[rank - 1]] > code[order[rank]])
            fail_msg("rank %d: code %llx before %llx", rank, (unsigned long long)code[order[rank - 1]],
                     (unsigned long long)code[order[rank]]);
}

static double mean_step(const float *xyz, const uint32_t *order) {
    double sum = 0;
    for (int rank = 1; rank < COUNT; rank++) {
        const float *a = xyz + 3 * order[rank - 1], *b = xyz + 3 * order[rank];
        sum += sqrt(pow(a[0] - b[0], 2) + pow(a[1] - b[1], 2) + pow(a[2] - b[2], 2)) / (COUNT - 1);
    }
    return sum;
}

// 4096 points in a unit cube are 1/16 apart; in any other order the next one is 0.66 away. One point a thousand times as far out takes
// ten bits of an axis, and leaves eleven.
static void neighbours_are_near_each_other_in_spite_of_one_far_outside(void **state) {
    (void)state;
    static float xyz[3 * COUNT];
    static uint32_t order[COUNT];
    for (int far = 0; far < 2; far++) {
        Rng rng = rng_at(8, RNG_TEST, 0, 0);
        for (int k = 0; k < 3 * COUNT; k++) xyz[k] = (float)rng_uniform(&rng);
        morton_order(COUNT - far, xyz, order); // the last point is the one
        if (far) {
            xyz[3 * COUNT - 1] = 1000;
            morton_order(COUNT, xyz, order);
            assert_int_equal(order[COUNT - 1], COUNT - 1);
        }
        every_point_comes_once(COUNT, order);
        const double step = mean_step(xyz, order) - (far ? 1000.0 / COUNT : 0);
        print_message("mean distance to the next: %.4f\n", step);
        assert_true(step < 2.0 / 16);
    }
}

static void a_model_is_arranged_with_all_that_belongs_to_a_splat(void **state) {
    (void)state;
    const float corner[4][3] = {{1, 1, 0}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}};
    const int source[4] = {1, 3, 2, 0};
    Gaussians g = gaussians_create(4, 1);
    for (int i = 0; i < 4; i++) {
        memcpy(gaussians_at(&g, FIELD_MEAN, i), corner[i], sizeof corner[i]);
        for (int k = 0; k < 9; k++) gaussians_at(&g, FIELD_SH1, i)[k] = (float)(10 * i + k);
        *gaussians_at(&g, FIELD_OPACITY_LOGIT, i) = (float)i;
    }
    morton_arrange(&g);
    for (int i = 0; i < 4; i++) {
        assert_memory_equal(gaussians_at(&g, FIELD_MEAN, i), corner[source[i]], sizeof corner[0]);
        for (int k = 0; k < 9; k++)
            support_near(gaussians_at(&g, FIELD_SH1, i)[k], 10 * source[i] + k, 0, "its colour");
        support_near(*gaussians_at(&g, FIELD_OPACITY_LOGIT, i), source[i], 0, "its opacity");
    }
    gaussians_destroy(&g);
}

static void points_of_one_place_keep_their_order(void **state) {
    (void)state;
    static float xyz[3 * COUNT];
    static uint32_t order[COUNT];
    for (int k = 0; k < 3 * COUNT; k++) xyz[k] = -3.5f;
    for (int count = 0; count <= COUNT; count = count ? 4 * count : 1) {
        morton_order(count, xyz, order);
        for (int rank = 0; rank < count; rank++) assert_int_equal(order[rank], rank);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cells_come_in_the_order_of_their_interleaved_bits),
        cmocka_unit_test(neighbours_are_near_each_other_in_spite_of_one_far_outside),
        cmocka_unit_test(a_model_is_arranged_with_all_that_belongs_to_a_splat),
        cmocka_unit_test(points_of_one_place_keep_their_order),
    };
    return cmocka_run_group_tests_name("morton_order", tests, NULL, NULL);
}
