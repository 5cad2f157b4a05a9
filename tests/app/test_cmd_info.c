#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "splat3d/ply.h"
#include "tests/support/command.h"
#include "tests/support/little_scene.h"
#include "tests/support/support.h"

#include <jansson.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

// The fixture: a scene, its model, a run folder, a cut model, and things that are neither.
static char scene[4096], model[4096], run[4096], cut[4096], text[4096], empty[4096];

static int make_files(void **state) {
    (void)state;
    const char *folder = support_scratch();
    snprintf(scene, sizeof scene, "%s", support_path(folder, "scene"));
    snprintf(model, sizeof model, "%s", support_path(folder, "model.ply"));
    snprintf(run, sizeof run, "%s", support_path(folder, "run"));
    snprintf(cut, sizeof cut, "%s", support_path(folder, "cut.ply"));
    snprintf(text, sizeof text, "%s", support_path(folder, "notes.txt"));
    snprintf(empty, sizeof empty, "%s", support_path(folder, "empty"));
    little_scene_write(scene);
    Gaussians splats = little_scene_model();
    char *bytes = NULL;
    size_t size;
    bool good = ply_save(model, &splats) && file_make_folder(run) && file_make_folder(empty) &&
                ply_save(support_path(run, "model.ply"), &splats) && file_read(model, &bytes, &size) &&
                file_write(cut, bytes, size - 100) && file_write(text, "shopping list\n", 14);
    const char *options = "{\"scene\": \"somewhere\", \"downscale\": 2, \"background\": \"white\"}";
    good = good && file_write(support_path(run, "options.json"), options, strlen(options));
    gaussians_destroy(&splats);
    mem_free(bytes);
    return good ? 0 : -1;
}

static json_t *info_json(const char *path, const char *option) {
    CommandResult r = command_run("info", path, "--json", option, NULL);
    command_expect(&r, 0);
    json_t *root = json_loads(r.out, 0, NULL); // exactly one document: anything behind it is refused
    assert_non_null(root);
    return root;
}

static long long integer(const json_t *object, const char *key) {
    const json_t *value = json_object_get(object, key);
    if (!json_is_integer(value)) fail_msg("\"%s\" is missing or no integer", key);
    return json_integer_value(value);
}

// 1.1 times the largest distance of a training camera (views 1 to 7) from their mean.
static double expected_extent(void) {
    Vec3 mean = vec3(0, 0, 0);
    double largest = 0;
    for (int v = 1; v < 8; v++) {
        Camera camera = little_scene_camera(v);
        mean = vec3_add(mean, vec3_scale(camera_position(&camera), 1.0 / 7));
    }
    for (int v = 1; v < 8; v++) {
        Camera camera = little_scene_camera(v);
        largest = fmax(largest, vec3_length(vec3_sub(camera_position(&camera), mean)));
    }
    return 1.1 * largest;
}

static void a_scene_is_counted(void **state) {
    (void)state;
    json_t *root = info_json(scene, NULL);
    assert_string_equal(json_string_value(json_object_get(root, "kind")), "scene");
    assert_int_equal(integer(root, "views"), LITTLE_VIEWS);
    assert_int_equal(integer(root, "held_out"), 2);
    assert_int_equal(integer(root, "train"), LITTLE_VIEWS - 2);
    assert_int_equal(integer(root, "points"), 24);
    assert_int_equal(integer(json_object_get(root, "resolutions_px"), "48x32"), LITTLE_VIEWS);
    support_near(json_real_value(json_object_get(root, "extent_world")), expected_extent(), 1e-9, "extent");
    json_decref(root);
    CommandResult r = command_run("info", scene, "--downscale", "2", NULL);
    command_expect(&r, 0);
    assert_non_null(strstr(r.out, "24x16"));
}

static void a_run_that_says_nothing_of_halved_pictures_used_none(void **state) {
    (void)state;
    json_t *root = info_json(run, NULL);
    assert_int_equal(integer(json_object_get(root, "options"), "coarse_levels"), 0);
    assert_int_equal(integer(json_object_get(root, "options"), "iterations"), 7000);
    json_decref(root);
}

static void training_memory_is_708_bytes_a_splat_of_degree_3_and_more(void **state) {
    (void)state;
    CommandResult r = command_run("info", scene, "--json", "--memory", "--splats", "1000", NULL);
    command_expect(&r, 0);
    json_t *root = json_loads(r.out, 0, NULL);
    const json_t *memory = json_object_get(root, "training_memory");
    assert_int_equal(integer(memory, "learned_per_splat_bytes"), 708);
    assert_int_equal(integer(memory, "photographs_bytes"), 48 * 32 * (4 * 7 + 3 * 2));
    assert_int_equal(integer(memory, "per_photograph_bytes"), integer(memory, "photographs_bytes") / LITTLE_VIEWS);
    assert_int_equal(integer(memory, "per_splat_bytes"), integer(memory, "learned_per_splat_bytes") +
                                                             integer(memory, "working_per_splat_bytes") +
                                                             integer(memory, "copied_per_splat_bytes"));
    assert_true(integer(memory, "total_bytes") > 1000 * 708 + integer(memory, "photographs_bytes"));
    assert_int_equal(integer(memory, "total_bytes"), integer(root, "training_memory_bytes"));
    json_decref(root);
}

static void a_model_is_counted_and_measured(void **state) {
    (void)state;
    json_t *root = info_json(model, NULL);
    assert_string_equal(json_string_value(json_object_get(root, "kind")), "model");
    assert_int_equal(integer(root, "splats"), 24);
    assert_int_equal(integer(root, "sh_degree"), 1);
    Gaussians splats = little_scene_model();
    double low = INFINITY, opacity = 0;
    for (int i = 0; i < splats.count; i++) {
        low = fmin(low, gaussians_at(&splats, FIELD_MEAN, i)[2]);
        opacity = fmax(opacity, 1 / (1 + exp(-gaussians_at(&splats, FIELD_OPACITY_LOGIT, i)[0])));
    }
    const json_t *bounds = json_object_get(root, "bounds_world"), *opacities = json_object_get(root, "opacity");
    support_near(json_real_value(json_array_get(json_object_get(bounds, "min"), 2)), low, 1e-6, "lowest z");
    support_near(json_real_value(json_object_get(opacities, "max")), opacity, 1e-6, "largest opacity");
    assert_true(json_real_value(json_object_get(opacities, "5%")) <=
                json_real_value(json_object_get(opacities, "50%")));
    gaussians_destroy(&splats);
    json_decref(root);
}

static void a_run_shows_its_model_and_its_options(void **state) {
    (void)state;
    json_t *root = info_json(run, NULL);
    assert_string_equal(json_string_value(json_object_get(root, "kind")), "run");
    assert_string_equal(json_string_value(json_object_get(root, "scene")), "somewhere");
    assert_int_equal(integer(root, "splats"), 24);
    assert_int_equal(integer(json_object_get(root, "options"), "downscale"), 2);
    json_decref(root);
}

static void what_is_no_scene_and_no_model_fails_with_a_hint(void **state) {
    (void)state;
    CommandResult r = command_run("info", text, NULL);
    command_expect_error(&r, 1, "notes.txt", "no PLY file", "give a scene's folder", NULL);
    r = command_run("info", empty, NULL);
    command_expect_error(&r, 1, "empty", NULL);
    r = command_run("info", cut, "--json", NULL);
    command_expect_error(&r, 1, "cut.ply", NULL);
    r = command_run("info", "no/such/thing", NULL);
    command_expect_error(&r, 1, "there is no no/such/thing", NULL);
}

static void a_cloud_of_points_is_told_from_a_model(void **state) {
    (void)state;
    const char *path = support_path(support_scratch(), "points.ply");
    const char *ply = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
                      "end_header\n1 2 3\n-1 0 5\n";
    assert_true(file_write(path, ply, strlen(ply)));
    json_t *root = info_json(path, NULL);
    assert_string_equal(json_string_value(json_object_get(root, "kind")), "points");
    assert_int_equal(integer(root, "points"), 2);
    json_decref(root);
}

static void the_photo_set_is_described(void **state) {
    (void)state;
    json_t *root = info_json(support_data("banana"), NULL);
    assert_int_equal(integer(root, "views"), 15);
    assert_int_equal(integer(root, "held_out"), 2);
    assert_int_equal(integer(root, "points"), 7237);
    assert_int_equal(integer(json_object_get(root, "resolutions_px"), "640x426"), 15);
    json_decref(root);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scene_is_counted),
        cmocka_unit_test(a_run_that_says_nothing_of_halved_pictures_used_none),
        cmocka_unit_test(training_memory_is_708_bytes_a_splat_of_degree_3_and_more),
        cmocka_unit_test(a_model_is_counted_and_measured),
        cmocka_unit_test(a_run_shows_its_model_and_its_options),
        cmocka_unit_test(what_is_no_scene_and_no_model_fails_with_a_hint),
        cmocka_unit_test(a_cloud_of_points_is_told_from_a_model),
        cmocka_unit_test(the_photo_set_is_described),
    };
    return cmocka_run_group_tests(tests, make_files, NULL);
}
