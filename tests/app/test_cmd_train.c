#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "splat3d/ply.h"
#include "tests/support/command.h"
#include "tests/support/little_scene.h"
#include "tests/support/support.h"

#include <jansson.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char scene[4096];

static int make_files(void **state) {
    (void)state;
    snprintf(scene, sizeof scene, "%s", support_path(support_scratch(), "scene"));
    little_scene_write(scene);
    return 0;
}

// The path of a run folder that is not there yet.
static const char *new_run(const char *name) { return support_path(support_scratch(), name); }

static json_t *parse(const CommandResult *result) {
    command_expect(result, 0);
    json_t *root = json_loads(result->out, 0, NULL); // exactly one document: anything behind it is refused
    assert_non_null(root);
    return root;
}

static void a_run_leaves_its_files_and_its_figures(void **state) {
    (void)state;
    char run[4096];
    snprintf(run, sizeof run, "%s", new_run("run"));
    CommandResult r = command_run("train", scene, "-o", run, "--iterations", "20", "--quiet", "--json", NULL);
    json_t *root = parse(&r);
    assert_string_equal(r.err, "");
    static const char *const keys[] = {"psnr",
                                       "ssim",
                                       "splats",
                                       "seconds",
                                       "ms_per_iteration",
                                       "model_sha256",
                                       "peak_rss_bytes",
                                       "seconds_to_first_iteration"};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
        if (!json_object_get(root, keys[i])) fail_msg("no \"%s\" in the result", keys[i]);
    char hex[65];
    assert_true(file_sha256(support_path(run, "model.ply"), hex));
    assert_string_equal(json_string_value(json_object_get(root, "model_sha256")), hex);
    assert_true(file_exists(support_path(run, "options.json")));
    json_t *profile = json_object_get(root, "profile"), *stages = json_object_get(profile, "stages_ms"), *ms;
    const char *stage;
    double sum = 0;
    assert_int_equal(json_integer_value(json_object_get(profile, "steps")), 20);
    assert_int_equal(json_object_size(stages), json_object_get(stages, "update") ? 8 : 9); // a GPU has two for it
    json_object_foreach(stages, stage, ms) {
        assert_true(json_real_value(ms) > 0 || strcmp(stage, "other") == 0);
        sum += json_real_value(ms);
    }
    support_near(sum, json_real_value(json_object_get(profile, "ms")), 1e-9, "ms a step");
    assert_true(json_real_value(json_object_get(root, "seconds_to_first_iteration")) > 0.001);
    assert_true(file_exists(support_path(run, "metrics.jsonl")));

    // The figures are those that eval finds in the saved model.
    r = command_run("eval", run, "--json", "--quiet", NULL);
    json_t *scores = parse(&r);
    support_near(json_number_value(json_object_get(scores, "psnr")), json_number_value(json_object_get(root, "psnr")),
                 1e-9, "PSNR");
    json_decref(scores);
    json_decref(root);

    r = command_run("train", scene, "-o", run, "--iterations", "20", NULL);
    command_expect_error(&r, 1, "holds a run already", "--overwrite", NULL);
}

static void a_profile_is_a_table_of_stages(void **state) {
    (void)state;
    CommandResult r =
        command_run("train", scene, "-o", new_run("profile"), "--iterations", "3", "--quiet", "--profile", NULL);
    command_expect(&r, 0);
    assert_non_null(strstr(r.out, "3 steps with 24 splats in the mean"));
    assert_non_null(strstr(r.out, "\nblend_backward "));
    assert_non_null(strstr(r.out, "\nother "));
}

static void wrong_usage_ends_with_exit_code_2(void **state) {
    (void)state;
    CommandResult r = command_run("train", scene, NULL);
    command_expect_error(&r, 2, "-o RUN", NULL);
    r = command_run("train", scene, "-o", new_run("never"), "--iterations", "0", NULL);
    command_expect_error(&r, 2, "--iterations 0", "1 to", NULL);
    r = command_run("train", scene, "-o", new_run("never"), "--background", "plaid", NULL);
    command_expect_error(&r, 2, "plaid", NULL);
    r = command_run("train", scene, "-o", new_run("never"), "--iteration", "5", NULL);
    command_expect_error(&r, 2, "did you mean --iterations?", NULL);
    assert_false(file_exists(new_run("never")));
}

static void what_is_no_scene_fails_with_a_hint(void **state) {
    (void)state;
    const char *empty = support_path(support_scratch(), "empty"), *text = support_path(support_scratch(), "notes.txt");
    assert_true(file_make_folder(empty));
    assert_true(file_write(text, "milk, eggs\n", 11));
    static const char *const missing = "no/such/scene";
    const char *const paths[] = {empty, text, missing};
    for (int i = 0; i < 3; i++) {
        CommandResult r = command_run("train", paths[i], "-o", new_run("never"), NULL);
        command_expect_error(&r, 1, paths[i], NULL);
        assert_non_null(strpbrk(r.err, ";?(")); // a hint follows
    }
    assert_false(file_exists(new_run("never")));
}

static void a_missing_image_is_named(void **state) {
    (void)state;
    const char *damaged = support_path(support_scratch(), "damaged");
    little_scene_write(damaged);
    assert_int_equal(unlink(support_path(damaged, "images/view_5.png")), 0);
    CommandResult r = command_run("train", damaged, "-o", new_run("never"), NULL);
    command_expect_error(&r, 1, "view_5.png", NULL);
}

static void a_truncated_image_is_named(void **state) {
    (void)state;
    const char *damaged = support_path(support_scratch(), "truncated");
    little_scene_write(damaged);
    const char *image = support_path(damaged, "images/view_4.png");
    assert_int_equal(truncate(image, 200), 0);
    CommandResult r = command_run("train", damaged, "-o", new_run("truncated-run"), "--quiet", NULL);
    command_expect_error(&r, 1, "view_4.png", NULL);
}

static void a_camera_that_is_not_a_number_is_refused(void **state) {
    (void)state;
    const char *folder = support_path(support_scratch(), "nan");
    assert_true(file_make_folder(folder));
    const char *json =
        "{\"fl_x\": 50, \"w\": 48, \"h\": 32, \"frames\": [{\"file_path\": \"a.png\", \"transform_matrix\": "
        "[[1,0,0,NaN],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}]}";
    assert_true(file_write(support_path(folder, "transforms.json"), json, strlen(json)));
    CommandResult r = command_run("train", folder, "-o", new_run("never"), NULL);
    command_expect_error(&r, 1, "transforms.json", NULL);
}

static void resuming_what_is_no_run_says_so(void **state) {
    (void)state;
    CommandResult r = command_run("train", "--resume", "no/such/run", NULL);
    command_expect_error(&r, 1, "no/such/run", "holds no run", NULL);
    r = command_run("train", scene, "--resume", "no/such/run", NULL);
    command_expect_error(&r, 2, "--resume takes the scene from its run", NULL);
    r = command_run("train", "--resume", "no/such/run", "-o", new_run("never"), NULL);
    command_expect_error(&r, 2, "--resume writes to the folder of its run", NULL);
}

static void a_run_that_cannot_begin_leaves_the_folder_as_it_was(void **state) {
    (void)state;
    char run[4096];
    snprintf(run, sizeof run, "%s", new_run("second try"));
    CommandResult r = command_run("train", scene, "-o", run, "--device", "no such device", NULL);
    command_expect_error(&r, 2, "no such device", NULL);
    assert_false(file_exists(support_path(run, "options.json")));
    r = command_run("train", scene, "-o", run, "--iterations", "2", "--quiet", NULL); // nothing is in its way
    command_expect(&r, 0);
    char before[65], after[65];
    assert_true(file_sha256(support_path(run, "model.ply"), before));
    r = command_run("train", scene, "-o", run, "--overwrite", "--device", "no such device", NULL);
    command_expect_error(&r, 2, "no such device", NULL);
    assert_true(file_sha256(support_path(run, "model.ply"), after));
    assert_string_equal(before, after);
}

static void resuming_keeps_to_the_options_of_the_run(void **state) {
    (void)state;
    char run[4096];
    snprintf(run, sizeof run, "%s", new_run("own options"));
    CommandResult r = command_run("train", scene, "-o", run, "--iterations", "2", "--quiet", NULL);
    command_expect(&r, 0);
    r = command_run("train", "--resume", run, "--iterations", "7000",
                    NULL); // 7000 is the default: it is noticed all the same
    command_expect_error(&r, 2, "--iterations 7000", "was begun with 2", NULL);
    char before[65], after[65];
    assert_true(file_sha256(support_path(run, "metrics.jsonl"), before));
    r = command_run("train", "--resume", run, "--iterations", "2", "--quiet", NULL); // it is done: nothing happens
    command_expect(&r, 0);
    assert_true(file_sha256(support_path(run, "metrics.jsonl"), after));
    assert_string_equal(before, after);
}

static void a_scene_whose_path_is_no_utf8_is_refused_before_anything_is_written(void **state) {
    (void)state;
    const char *odd = support_path(support_scratch(), "sc\xe8ne");
    if (!file_make_folder(odd)) skip(); // some file systems take no such name
    CommandResult r = command_run("train", odd, "-o", new_run("never"), NULL);
    command_expect_error(&r, 1, "no UTF-8", "rename", NULL);
    assert_false(file_exists(new_run("never")));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_run_leaves_its_files_and_its_figures),
        cmocka_unit_test(a_profile_is_a_table_of_stages),
        cmocka_unit_test(wrong_usage_ends_with_exit_code_2),
        cmocka_unit_test(what_is_no_scene_fails_with_a_hint),
        cmocka_unit_test(a_missing_image_is_named),
        cmocka_unit_test(a_truncated_image_is_named),
        cmocka_unit_test(a_camera_that_is_not_a_number_is_refused),
        cmocka_unit_test(resuming_what_is_no_run_says_so),
        cmocka_unit_test(a_run_that_cannot_begin_leaves_the_folder_as_it_was),
        cmocka_unit_test(resuming_keeps_to_the_options_of_the_run),
        cmocka_unit_test(a_scene_whose_path_is_no_utf8_is_refused_before_anything_is_written),
    };
    return cmocka_run_group_tests(tests, make_files, NULL);
}
