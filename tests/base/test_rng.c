#include "lab/base/rng.h"
#include "tests/support/support.h"

#include <math.h>

// The known answers that come with the paper's own code (Random123, kat_vectors, philox4x32 10).
static void philox_gives_the_papers_known_answers(void **state) {
    (void)state;
    static const struct {
        uint32_t counter[4], key[2], out[4];
    } known[] = {
        {{0, 0, 0, 0}, {0, 0}, {0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}},
        {{0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff},
         {0xffffffff, 0xffffffff},
         {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}},
        {{0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344},
         {0xa4093822, 0x299f31d0},
         {0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}},
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        uint32_t out[4];
        rng_philox4x32(known[i].counter, known[i].key, out);
        for (int j = 0; j < 4; j++) assert_int_equal(out[j], known[i].out[j]);
    }
}

static void a_stream_is_a_pure_function_of_its_key(void **state) {
    (void)state;
    Rng a = rng_at(42, RNG_TEST, 3, 5), b = rng_at(42, RNG_TEST, 3, 5);
    Rng others[] = {rng_at(43, RNG_TEST, 3, 5), rng_at(42, RNG_SPLIT, 3, 5), rng_at(42, RNG_TEST, 4, 5),
                    rng_at(42, RNG_TEST, 3, 6), rng_at(42 + (1ull << 32), RNG_TEST, 3, 5)};
    for (int draw = 0; draw < 11; draw++) {
        uint32_t value = rng_u32(&a);
        assert_int_equal(value, rng_u32(&b));
        for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) assert_int_not_equal(value, rng_u32(&others[i]));
    }
}

static void a_stream_runs_through_the_blocks_in_order(void **state) {
    (void)state;
    Rng rng = rng_at(0x100000002ull, RNG_VIEW_ORDER, 7, 8);
    const uint32_t key[2] = {2, 1};
    for (uint32_t draw = 0; draw < 3; draw++) {
        uint32_t counter[4] = {draw, RNG_VIEW_ORDER, 7, 8}, out[4];
        rng_philox4x32(counter, key, out);
        for (int j = 0; j < 4; j++) assert_int_equal(rng_u32(&rng), out[j]);
    }
}

enum { DRAWS = 200000 };

// Five standard errors of the mean: a fixed seed makes the outcome fixed, too.
static void uniform_numbers_have_the_moments_of_their_distribution(void **state) {
    (void)state;
    Rng rng = rng_at(1, RNG_TEST, 0, 0);
    double sum = 0, squares = 0;
    for (int i = 0; i < DRAWS; i++) {
        double u = rng_uniform(&rng);
        assert_true(u >= 0 && u < 1);
        sum += u;
        squares += u * u;
    }
    support_near(sum / DRAWS, 0.5, 5 * sqrt(1.0 / 12 / DRAWS), "mean");
    support_near(squares / DRAWS, 1.0 / 3, 5 * sqrt(4.0 / 45 / DRAWS), "mean square");
}

static void normal_numbers_have_the_moments_of_their_distribution(void **state) {
    (void)state;
    Rng rng = rng_at(2, RNG_TEST, 0, 0);
    double power[5] = {0};
    for (int i = 0; i < DRAWS; i++) {
        double x = rng_normal(&rng);
        assert_true(isfinite(x));
        for (int k = 1; k <= 4; k++) power[k] += pow(x, k) / DRAWS;
    }
    support_near(power[1], 0, 5 * sqrt(1.0 / DRAWS), "mean");
    support_near(power[2], 1, 5 * sqrt(2.0 / DRAWS), "variance");
    support_near(power[3], 0, 5 * sqrt(15.0 / DRAWS), "third moment");
    support_near(power[4], 3, 5 * sqrt(96.0 / DRAWS), "fourth moment");
}

static void a_range_holds_its_ends(void **state) {
    (void)state;
    Rng rng = rng_at(3, RNG_TEST, 0, 0);
    double low = 1, high = nextafter(1, 2); // one step of double apart: only `low` is allowed
    for (int i = 0; i < 1000; i++) assert_true(rng_range(&rng, low, high) == low);
    for (int i = 0; i < 1000; i++) {
        double value = rng_range(&rng, -3, 5);
        assert_true(value >= -3 && value < 5);
    }
}

static void below_hits_every_result_equally_often(void **state) {
    (void)state;
    enum { N = 7 };
    Rng rng = rng_at(4, RNG_TEST, 0, 0);
    int hits[N] = {0};
    for (int i = 0; i < DRAWS; i++) {
        uint32_t value = rng_below(&rng, N);
        assert_true(value < N);
        hits[value]++;
    }
    double chi2 = 0, expected = (double)DRAWS / N;
    for (int i = 0; i < N; i++) chi2 += (hits[i] - expected) * (hits[i] - expected) / expected;
    assert_true(chi2 < 22.5); // 6 degrees of freedom: 0.1 %
    for (int i = 0; i < 10; i++) assert_int_equal(rng_below(&rng, 1), 0);
}

// With n = 3 * 2^30 a plain remainder would give results below 2^30 half of the time instead of a third.
static void below_is_unbiased_where_a_remainder_is_not(void **state) {
    (void)state;
    Rng rng = rng_at(5, RNG_TEST, 0, 0);
    int low = 0;
    for (int i = 0; i < DRAWS; i++) low += rng_below(&rng, 3u << 30) < 1u << 30;
    support_near((double)low / DRAWS, 1.0 / 3, 5 * sqrt(2.0 / 9 / DRAWS), "share below 2^30");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(philox_gives_the_papers_known_answers),
        cmocka_unit_test(a_stream_is_a_pure_function_of_its_key),
        cmocka_unit_test(a_stream_runs_through_the_blocks_in_order),
        cmocka_unit_test(uniform_numbers_have_the_moments_of_their_distribution),
        cmocka_unit_test(normal_numbers_have_the_moments_of_their_distribution),
        cmocka_unit_test(a_range_holds_its_ends),
        cmocka_unit_test(below_hits_every_result_equally_often),
        cmocka_unit_test(below_is_unbiased_where_a_remainder_is_not),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
