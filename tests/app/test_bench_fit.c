#include "lab/app/bench_fit.h"
#include "tests/support/support.h"

#include <math.h>

typedef double Cost(double evaluated, double tile_pairs, double pixels, double splats); // ns

// Rows of 1 and 2 threads in three sizes, four crowds each; two threads cost twice as much.
static json_t *make_rows(Cost *cost) {
    static const int sides[] = {100, 300, 1000}, splats[] = {5000, 20000, 100000, 400000};
    json_t *rows = json_array();
    for (int threads = 1; threads <= 2; threads++)
        for (int s = 0; s < 3; s++)
            for (int n = 0; n < 4; n++) {
                double pixels = (double)sides[s] * 2 * sides[s], evaluated = fmin(700.0 * splats[n], 150 * pixels);
                double ns = threads * cost(evaluated, 5.0 * splats[n], pixels, splats[n]);
                json_array_append_new(rows, json_pack("{si si si si sf sf sf}", "threads", threads, "width", sides[s],
                                                      "height", 2 * sides[s], "splats", splats[n], "tile_pairs",
                                                      5.0 * splats[n], "evaluated_pairs", evaluated, "blend_cpu_ms",
                                                      1e-6 * ns));
            }
    return rows;
}

static double of(const json_t *fit, const char *law, const char *key) {
    const json_t *value = json_object_get(json_object_get(fit, law), key);
    if (!json_is_number(value)) fail_msg("there is no \"%s\" in \"%s\"", key, law);
    return json_number_value(value);
}

static double cost_of_power(double evaluated, double tile_pairs, double pixels, double splats) {
    (void)tile_pairs, (void)pixels, (void)splats;
    return 3 * pow(evaluated, 1.25);
}

static void the_exponent_is_that_of_the_work(void **state) {
    (void)state;
    json_t *rows = make_rows(cost_of_power), *fit = bench_fit_rows(rows, 2);
    assert_int_equal(json_integer_value(json_object_get(fit, "threads")), 2);
    support_near(of(fit, "evaluated_pairs", "exponent"), 1.25, 1e-9, "exponent");
    support_near(of(fit, "evaluated_pairs", "scatter"), 0, 1e-6, "scatter");
    assert_true(of(fit, "pixels_times_splats", "exponent") < 1.1);
    assert_true(of(fit, "pixels_times_splats", "scatter") > 0.1);
    json_decref(fit);
    json_decref(rows);
}

static double cost_of_law(double evaluated, double tile_pairs, double pixels, double splats) {
    (void)splats;
    return 0.5 * evaluated + 20 * tile_pairs + 7 * pixels;
}

static void the_law_finds_its_three_constants(void **state) {
    (void)state;
    json_t *rows = make_rows(cost_of_law);
    for (int threads = 1; threads <= 2; threads++) {
        json_t *fit = bench_fit_rows(rows, threads);
        support_near(of(fit, "law", "ns_per_evaluated_pair"), 0.5 * threads, 1e-6, "evaluated pairs");
        support_near(of(fit, "law", "ns_per_tile_pair"), 20 * threads, 1e-4, "tile pairs");
        support_near(of(fit, "law", "ns_per_pixel"), 7 * threads, 1e-4, "pixels");
        support_near(of(fit, "law", "worst"), 0, 1e-6, "worst error");
        json_decref(fit);
    }
    json_decref(rows);
}

static double cost_of_all_pairs(double evaluated, double tile_pairs, double pixels, double splats) {
    (void)evaluated, (void)tile_pairs;
    return 1e-3 * pixels * splats;
}

static void a_cost_of_pixels_times_splats_is_told_apart(void **state) {
    (void)state;
    json_t *rows = make_rows(cost_of_all_pairs), *fit = bench_fit_rows(rows, 1);
    support_near(of(fit, "pixels_times_splats", "exponent"), 1, 1e-9, "exponent");
    assert_true(of(fit, "law", "scatter") > 0.3);
    json_decref(fit);
    json_decref(rows);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_exponent_is_that_of_the_work),
        cmocka_unit_test(the_law_finds_its_three_constants),
        cmocka_unit_test(a_cost_of_pixels_times_splats_is_told_apart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
