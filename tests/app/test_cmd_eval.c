#include "lab/base/image.h"
#include "lab/io/file.h"
#include "lab/io/image_io.h"
#include "splat3d/ply.h"
#include "tests/support/command.h"
#include "tests/support/little_scene.h"
#include "tests/support/support.h"

#include <jansson.h>
#include <stdbool.h>
#include <string.h>
#include <unistd.h>

// The fixture: a scene, the model that its pictures show, and a run folder with that model trained at half size.
static char scene[4096], model[4096], run[4096];

static int make_files(void **state) {
    (void)state;
    const char *folder = support_scratch();
    snprintf(scene, sizeof scene, "%s", support_path(folder, "scene"));
    snprintf(model, sizeof model, "%s", support_path(folder, "model.ply"));
    snprintf(run, sizeof run, "%s", support_path(folder, "run"));
    little_scene_write(scene);
    Gaussians splats = little_scene_model();
    bool good = ply_save(model, &splats) && file_make_folder(run) && ply_save(support_path(run, "model.ply"), &splats);
    char options[8192];
    snprintf(options, sizeof options, "{\"scene\": \"%s\", \"downscale\": 2, \"background\": \"black\"}", scene);
    good = good && file_write(support_path(run, "options.json"), options, strlen(options));
    gaussians_destroy(&splats);
    return good ? 0 : -1;
}

static json_t *parse(const CommandResult *result) {
    command_expect(result, 0);
    json_t *root = json_loads(result->out, 0, NULL); // exactly one document: anything behind it is refused
    assert_non_null(root);
    return root;
}

static double number(const json_t *object, const char *key) {
    const json_t *value = json_object_get(object, key);
    if (!json_is_number(value)) fail_msg("\"%s\" is missing or no number", key);
    return json_number_value(value);
}

// The photographs are the model's own pictures rounded to 8 bit: an error of at most half a step, 59 dB on average.
static void the_true_model_scores_as_high_as_rounding_allows(void **state) {
    (void)state;
    static const char *const ways[] = {"--reference", "--quiet"};
    for (int w = 0; w < 2; w++) {
        CommandResult r = command_run("eval", model, "--scene", scene, "--json", ways[w], NULL);
        json_t *root = parse(&r);
        support_near(number(root, "psnr"), 60, 5, "PSNR");
        assert_true(number(root, "ssim") > 0.99);
        assert_true(number(root, "psnr8") > 70); // rounded as the photographs are: nearly all equal
        const json_t *views = json_object_get(root, "views");
        assert_int_equal(json_array_size(views), 2);
        assert_string_equal(json_string_value(json_object_get(json_array_get(views, 0), "name")), "view_0.png");
        assert_string_equal(json_string_value(json_object_get(json_array_get(views, 1), "name")), "view_8.png");
        double mean = (number(json_array_get(views, 0), "psnr") + number(json_array_get(views, 1), "psnr")) / 2;
        support_near(number(root, "psnr"), mean, 1e-9, "mean of the views");
        assert_non_null(strstr(json_string_value(json_object_get(root, "protocol")), "PSNR"));
        json_decref(root);
    }
}

static void a_wrong_model_scores_low(void **state) {
    (void)state;
    Gaussians splats = little_scene_model();
    for (int i = 0; i < splats.count; i++) gaussians_at(&splats, FIELD_MEAN, i)[0] += 0.3f;
    const char *path = support_path(support_scratch(), "wrong.ply");
    assert_true(ply_save(path, &splats));
    gaussians_destroy(&splats);
    CommandResult r = command_run("eval", path, "--scene", scene, "--json", "--reference", NULL);
    json_t *root = parse(&r);
    assert_true(number(root, "psnr") < 30);
    json_decref(root);
}

static void the_table_names_views_means_and_protocol(void **state) {
    (void)state;
    CommandResult r = command_run("eval", model, "--scene", scene, "--reference", NULL);
    command_expect(&r, 0);
    assert_non_null(strstr(r.out, "view_8.png"));
    assert_non_null(strstr(r.out, "\nmean"));
    assert_non_null(strstr(r.out, "\nprotocol: "));
}

// At half size the photograph is a mean of pixels, the render a sample: close, but no longer equal.
static void a_run_brings_scene_and_downscale_and_the_command_line_wins(void **state) {
    (void)state;
    CommandResult r = command_run("eval", run, "--json", "--reference", NULL);
    json_t *half = parse(&r);
    r = command_run("eval", model, "--scene", scene, "--downscale", "2", "--json", "--reference", NULL);
    json_t *same = parse(&r);
    r = command_run("eval", run, "--downscale", "1", "--json", "--reference", NULL);
    json_t *full = parse(&r);
    assert_true(number(half, "psnr") == number(same, "psnr"));
    assert_true(number(half, "psnr") < 50 && number(full, "psnr") > 50);
    json_decref(half);
    json_decref(same);
    json_decref(full);
}

static void the_contact_sheet_is_written(void **state) {
    (void)state;
    const char *path = support_path(support_scratch(), "sheet.png");
    CommandResult r = command_run("eval", model, "--scene", scene, "--reference", "--contact-sheet", path, NULL);
    command_expect(&r, 0);
    int width, height, channels;
    assert_true(image_probe(path, &width, &height, &channels));
    assert_int_equal(width, 3 * LITTLE_WIDTH + 8);
    assert_int_equal(height, 2 * LITTLE_HEIGHT + 4);
}

static void wrong_usage_ends_with_exit_code_2(void **state) {
    (void)state;
    CommandResult r = command_run("eval", model, NULL);
    command_expect_error(&r, 2, "--scene", NULL);
    r = command_run("eval", model, "--scene", scene, "--background", "mauve", NULL);
    command_expect_error(&r, 2, "mauve", NULL);
    r = command_run("eval", model, "--scene", scene, "--background", "0,0,2", NULL);
    command_expect_error(&r, 2, "0,0,2", NULL);
    r = command_run("eval", model, "--scene", scene, "--downscale", "0", NULL);
    command_expect_error(&r, 2, "--downscale 0", NULL);
    r = command_run("eval", model, "--scene", scene, "--contact-sheet", "sheet.txt", NULL);
    command_expect_error(&r, 2, "sheet.txt", ".png", NULL);
    r = command_run("eval", model, "--scene", scene, "--device", "abacus", NULL);
    command_expect_error(&r, 2, "abacus", NULL);
}

static void what_cannot_be_had_ends_with_exit_code_1(void **state) {
    (void)state;
    CommandResult r = command_run("eval", "none.ply", "--scene", scene, NULL);
    command_expect_error(&r, 1, "there is no none.ply", NULL);
    r = command_run("eval", model, "--scene", "nowhere", NULL);
    command_expect_error(&r, 1, "nowhere", NULL);
    r = command_run("eval", scene, "--scene", scene, NULL);
    command_expect_error(&r, 1, "is no run", NULL);
    r = command_run("eval", "README.md", "--scene", scene, NULL);
    command_expect_error(&r, 1, "README.md", NULL);
    r = command_run("eval", model, "--scene", scene, "--contact-sheet", "/nonexistent/sheet.png", NULL);
    command_expect_error(&r, 1, "/nonexistent", NULL);
}

static void a_photograph_that_is_gone_is_named(void **state) {
    (void)state;
    const char *damaged = support_path(support_scratch(), "damaged");
    little_scene_write(damaged);
    assert_int_equal(unlink(support_path(damaged, "images/view_3.png")), 0);
    CommandResult r = command_run("eval", model, "--scene", damaged, NULL);
    command_expect_error(&r, 1, "view_3.png", NULL);
}

static void a_run_without_a_model_says_how_to_go_on(void **state) {
    (void)state;
    const char *unfinished = support_path(support_scratch(), "unfinished");
    assert_true(file_make_folder(unfinished));
    assert_true(file_write(support_path(unfinished, "options.json"), "{\"scene\": \"x\"}", 14));
    CommandResult r = command_run("eval", unfinished, NULL);
    command_expect_error(&r, 1, "no model.ply", "--resume", NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_true_model_scores_as_high_as_rounding_allows),
        cmocka_unit_test(a_wrong_model_scores_low),
        cmocka_unit_test(the_table_names_views_means_and_protocol),
        cmocka_unit_test(a_run_brings_scene_and_downscale_and_the_command_line_wins),
        cmocka_unit_test(the_contact_sheet_is_written),
        cmocka_unit_test(wrong_usage_ends_with_exit_code_2),
        cmocka_unit_test(what_cannot_be_had_ends_with_exit_code_1),
        cmocka_unit_test(a_photograph_that_is_gone_is_named),
        cmocka_unit_test(a_run_without_a_model_says_how_to_go_on),
    };
    return cmocka_run_group_tests(tests, make_files, NULL);
}
