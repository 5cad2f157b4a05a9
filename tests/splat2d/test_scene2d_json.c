// test_scene2d_json.c - scenes there and back to the byte; malformed ones are refused by file, blob and field.
#include "splat2d/scene2d_json.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/base/rng.h"
#include "lab/io/file.h"
#include "tests/support/support.h"

#include <math.h>
#include <string.h>

static const char *scratch(const char *name) { return support_path(support_scratch(), name); }

static void a_scene_comes_back_to_the_bit(void **state) {
    (void)state;
    Scene2d scene = scene2d_default(), copy;
    Rng rng = rng_at(1, RNG_TEST, 0, 0);
    for (int i = 0; i < 40; i++) {
        Blob blob = {.mean = {1e3 * rng_normal(&rng), 1e-3 * rng_normal(&rng)},
                     .sigma_x = exp(9 * rng_normal(&rng) / 3),
                     .sigma_y = i == 7 ? 0 : rng_uniform(&rng),
                     .theta_rad = rng_range(&rng, -9, 9),
                     .rgb = {rng_uniform(&rng), 0, 1},
                     .opacity = rng_uniform(&rng),
                     .depth = rng_normal(&rng)};
        scene2d_add(&scene, &blob);
    }
    assert_true(scene2d_save(scratch("a.json"), &scene));
    if (!scene2d_load(scratch("a.json"), &copy)) fail_msg("%s", fail_text());
    assert_int_equal(copy.width, scene.width);
    assert_int_equal(copy.height, scene.height);
    assert_memory_equal(copy.background, scene.background, sizeof scene.background);
    assert_int_equal(copy.count, scene.count);
    assert_memory_equal(copy.blobs, scene.blobs, (size_t)scene.count * sizeof(Blob));

    assert_true(scene2d_save(scratch("b.json"), &copy));
    char sums[2][65];
    assert_true(file_sha256(scratch("a.json"), sums[0]) && file_sha256(scratch("b.json"), sums[1]));
    assert_string_equal(sums[0], sums[1]);
    scene2d_destroy(&scene);
    scene2d_destroy(&copy);
}

static void a_scene_written_by_hand_is_read(void **state) {
    (void)state;
    const char text[] =
        "{\"width\": 64, \"height\": 48, \"background\": [0, 0, 1], \"gaussians\": [{\"mean\": [1, 2.5],"
        "\"sigma_x\": 3, \"sigma_y\": 0, \"theta_rad\": -1e-3, \"rgb\": [1, 0, 0.5], \"opacity\": 1,"
        "\"depth\": 7}]}";
    Scene2d scene;
    assert_true(file_write(scratch("hand.json"), text, strlen(text)));
    if (!scene2d_load(scratch("hand.json"), &scene)) fail_msg("%s", fail_text());
    assert_int_equal(scene.count, 1);
    assert_true(scene.blobs[0].mean[1] == 2.5 && scene.blobs[0].theta_rad == -1e-3 && scene.blobs[0].rgb[2] == 0.5);
    scene2d_destroy(&scene);
}

// A good scene with one text replaced by another.
static void refused(const char *part, const char *by, const char *first_word, const char *second_word) {
    const char good[] = "{\"width\": 64, \"height\": 48, \"background\": [0, 0, 1], \"gaussians\": ["
                        "{\"mean\": [1, 2], \"sigma_x\": 3, \"sigma_y\": 4, \"theta_rad\": 5, \"rgb\": [1, 0, 0],"
                        " \"opacity\": 0.5, \"depth\": 7},"
                        "{\"mean\": [11, 12], \"sigma_x\": 13, \"sigma_y\": 14, \"theta_rad\": 15, \"rgb\": [0, 1, 0],"
                        " \"opacity\": 0.25, \"depth\": 17}]}";
    const char *at = strstr(good, part);
    assert_non_null(at);
    char *text = mem_format("%.*s%s%s", (int)(at - good), good, by, at + strlen(part));
    Scene2d scene = {.count = 99};
    assert_true(file_write(scratch("bad.json"), text, strlen(text)));
    if (scene2d_load(scratch("bad.json"), &scene)) fail_msg("accepted: %s", text);
    assert_int_equal(scene.count, 0);
    assert_null(scene.blobs);
    if (!strstr(fail_text(), "bad.json") || !strstr(fail_text(), first_word) || !strstr(fail_text(), second_word))
        fail_msg("\"%s\" should say \"%s\" and \"%s\"", fail_text(), first_word, second_word);
    mem_free(text);
}

static void malformed_scenes_are_refused_by_blob_and_field(void **state) {
    (void)state;
    refused("13", "-13", "blob 1", "sigma_x");
    refused("\"sigma_y\": 14", "\"sigma_y\": \"wide\"", "blob 1", "sigma_y");
    refused("\"sigma_y\": 4,", "", "blob 0", "sigma_y");
    refused("[11, 12]", "[11]", "blob 1", "mean");
    refused("[11, 12]", "[11, null]", "blob 1", "mean");
    refused("0.25", "1.25", "blob 1", "opacity");
    refused("0.25", "true", "blob 1", "opacity");
    refused("[0, 1, 0]", "[0, 2, 0]", "blob 1", "rgb");
    refused("17", "1e300", "blob 1", "depth");
    refused("15", "1e999", "line 1", "overflow");
    refused("15", "NaN", "line 1", "finite");
    refused("\"opacity\"", "\"opacitty\"", "blob 0", "opacity");
    refused("\"depth\": 17", "\"depth\": 17, \"deph\": 1", "did you mean", "depth");
    refused("{\"mean\": [1, 2]", "7, {\"mean\": [1, 2]", "blob 0", "object");
}

static void malformed_canvases_are_refused(void **state) {
    (void)state;
    refused("64", "0", "width", "0");
    refused("64", "64.5", "width", "64.5");
    refused("48", "1e9", "height", "16384");
    refused("48", "\"48\"", "height", "number");
    refused("[0, 0, 1]", "[0, 0]", "background", "3");
    refused("[0, 0, 1]", "[0, 0, -1]", "background", "0 to 1");
    refused("\"gaussians\"", "\"gausians\"", "gaussians", "missing");
    refused("\"width\": 64", "\"width\": 64, \"widht\": 1", "did you mean", "width");
    refused("{\"width\"", "[{\"width\"", "bad.json", "line");
}

static void a_list_that_is_too_long_is_refused_before_it_is_read(void **state) {
    (void)state;
    FILE *file = fopen(scratch("many.json"), "w");
    fprintf(file, "{\"width\": 8, \"height\": 8, \"background\": [0, 0, 0], \"gaussians\": [0");
    for (int i = 0; i < SCENE2D_BLOBS_MAX; i++) fputs(",0", file);
    fprintf(file, "]}");
    fclose(file);
    Scene2d scene;
    assert_false(scene2d_load(scratch("many.json"), &scene));
    assert_non_null(strstr(fail_text(), "100001 blobs"));
}

static void what_could_not_be_read_back_is_not_written(void **state) {
    (void)state;
    Scene2d scene = scene2d_default();
    scene.blobs[2].sigma_x = NAN;
    assert_false(scene2d_save(scratch("nan.json"), &scene));
    assert_non_null(strstr(fail_text(), "blob 2"));
    assert_false(file_exists(scratch("nan.json")));
    scene2d_destroy(&scene);
    assert_false(scene2d_load(scratch("absent.json"), &scene));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scene_comes_back_to_the_bit),
        cmocka_unit_test(a_scene_written_by_hand_is_read),
        cmocka_unit_test(malformed_scenes_are_refused_by_blob_and_field),
        cmocka_unit_test(malformed_canvases_are_refused),
        cmocka_unit_test(a_list_that_is_too_long_is_refused_before_it_is_read),
        cmocka_unit_test(what_could_not_be_read_back_is_not_written),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
