#include "tests/support/command.h"
#include "tests/support/support.h"

#include <jansson.h>
#include <math.h>
#include <string.h>

static double number(const json_t *object, const char *key) {
    const json_t *value = json_object_get(object, key);
    if (!json_is_number(value)) fail_msg("\"%s\" is missing or no number", key);
    return json_number_value(value);
}

static json_t *parse(const CommandResult *result) {
    command_expect(result, 0);
    json_t *root = json_loads(result->out, 0, NULL);
    assert_non_null(root);
    return root;
}

static void every_stage_is_timed_beside_its_ceiling(void **state) {
    (void)state;
    CommandResult r =
        command_run("bench", "--json", "--splats", "2000", "--size", "96x64", "--rounds", "2", "--device", "cpu", NULL);
    json_t *root = parse(&r);
    static const char *const NAMES[] = {"project",          "sort", "bin",    "blend_forward", "loss", "blend_backward",
                                        "project_backward", "adam", "update", "frame",         "step"};
    const json_t *stages = json_object_get(root, "stages");
    const double evaluated = number(root, "evaluated_pairs");
    assert_int_equal(json_array_size(stages), 11);
    assert_true(number(root, "tile_pairs") < number(root, "tile_pairs_square"));
    for (size_t k = 0; k < 11; k++) {
        const json_t *stage = json_array_get(stages, k);
        assert_string_equal(json_string_value(json_object_get(stage, "name")), NAMES[k]);
        assert_true(number(stage, "ms") > 0 && number(stage, "cpu_ms") > 0);
        if (!strncmp(NAMES[k], "blend", 5)) {
            support_near(number(stage, "pairs"), evaluated, 0, "pairs");
            support_near(number(stage, "ns_per_pair"), 1e6 * number(stage, "cpu_ms") / evaluated, 1e-6, "ns per pair");
        }
        if (!strcmp(NAMES[k], "adam")) {
            assert_true(number(stage, "ratio_native") > 0);
            support_near(number(stage, "gbps") * number(stage, "ms") * 1e6, 28.0 * 59 * 2000, 1, "bytes of Adam");
        }
    }
    json_decref(root);
}

static void only_the_named_stages_are_listed(void **state) {
    (void)state;
    CommandResult r = command_run("bench", "--stage", "adam,bin", "--splats", "100", "--size", "32x32", "--rounds", "1",
                                  "--threads", "1", "--json", NULL);
    json_t *root = parse(&r);
    const json_t *stages = json_object_get(root, "stages");
    assert_int_equal(json_array_size(stages), 2);
    assert_string_equal(json_string_value(json_object_get(json_array_get(stages, 0), "name")), "bin");
    assert_int_equal((int)number(root, "threads"), 1);
    json_decref(root);
    r = command_run("bench", "--stage", "adam", "--splats", "100", "--size", "32x32", "--rounds", "1", NULL);
    command_expect(&r, 0);
    assert_non_null(strstr(r.out, "adam"));
    assert_null(strstr(r.out, "project"));
}

static void a_wrong_stage_is_named_with_the_nearest_one(void **state) {
    (void)state;
    CommandResult r = command_run("bench", "--stage", "bin,blend_forwad", NULL);
    command_expect_error(&r, 2, "blend_forwad", "blend_forward", NULL);
    r = command_run("bench", "--camera", "cam.json", NULL);
    command_expect_error(&r, 2, "--model", NULL);
    r = command_run("bench", "--scaling", "--stage", "adam", NULL);
    command_expect_error(&r, 2, "--stage", "standard scene", NULL);
    r = command_run("bench", "--scaling", "--model", "model.ply", NULL);
    command_expect_error(&r, 2, "--model", "standard scene", NULL);
    r = command_run("bench", "--model", "no/such.ply", NULL);
    command_expect_error(&r, 1, "no/such.ply", NULL);
}

static void a_model_of_a_file_is_measured(void **state) {
    (void)state;
    char path[4096];
    snprintf(path, sizeof path, "%s", support_data("reference/random_5k.ply"));
    CommandResult r =
        command_run("bench", "--model", path, "--size", "270x480", "--stage", "frame", "--rounds", "1", "--json", NULL);
    json_t *root = parse(&r);
    assert_int_equal((int)number(root, "splats"), 5000);
    assert_int_equal((int)number(root, "height"), 480);
    json_decref(root);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_stage_is_timed_beside_its_ceiling),
        cmocka_unit_test(only_the_named_stages_are_listed),
        cmocka_unit_test(a_wrong_stage_is_named_with_the_nearest_one),
        cmocka_unit_test(a_model_of_a_file_is_measured),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
