#include "lab/base/image.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "lab/io/image_io.h"
#include "splat3d/ply.h"
#include "splat3d/reference.h"
#include "tests/support/command.h"
#include "tests/support/little_scene.h"
#include "tests/support/support.h"

#include <jansson.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>
#include <unistd.h>

// The fixture: a scene, its model, and view 3's camera as a file.
static char scene[4096], model[4096], camera_file[4096];

static int make_files(void **state) {
    (void)state;
    const char *folder = support_scratch();
    snprintf(scene, sizeof scene, "%s", support_path(folder, "scene"));
    snprintf(model, sizeof model, "%s", support_path(folder, "model.ply"));
    snprintf(camera_file, sizeof camera_file, "%s", support_path(folder, "camera.json"));
    little_scene_write(scene);
    Gaussians splats = little_scene_model();
    Camera camera = little_scene_camera(3);
    bool good = ply_save(model, &splats) && camera_save_json(camera_file, &camera);
    gaussians_destroy(&splats);
    return good ? 0 : -1;
}

// What the reference shows in view 3.
static Picture expected_picture(RenderSettings settings) {
    Gaussians splats = little_scene_model();
    Camera camera = little_scene_camera(3);
    Rasterizer *reference = reference_rasterizer_create();
    Picture picture;
    assert_true(rasterizer_render(reference, &splats, &camera, &settings, &picture));
    rasterizer_destroy(reference);
    gaussians_destroy(&splats);
    return picture;
}

static ImageF load(const char *path, int channels) {
    ImageF image;
    assert_true(image_loadf(path, &image));
    assert_int_equal(image.channels, channels);
    assert_int_equal(image.width, LITTLE_WIDTH);
    assert_int_equal(image.height, LITTLE_HEIGHT);
    return image;
}

static double largest_difference(const ImageF *a, const ImageF *b) {
    double largest = 0;
    for (int i = 0; i < a->width * a->height * a->channels; i++)
        largest = fmax(largest, fabs((double)a->values[i] - b->values[i]));
    return largest;
}

static void a_camera_file_gives_the_references_floats(void **state) {
    (void)state;
    const char *path = support_path(support_scratch(), "out.exr");
    CommandResult r = command_run("render", model, "--camera", camera_file, "-o", path, "--background", "0.2,0.4,0.6",
                                  "--reference", NULL);
    command_expect(&r, 0);
    char *line = mem_format("%s\n", path);
    assert_string_equal(r.out, line);
    mem_free(line);
    RenderSettings settings = render_settings_default();
    settings.background[0] = 0.2f, settings.background[1] = 0.4f, settings.background[2] = 0.6f;
    Picture expected = expected_picture(settings);
    ImageF image = load(path, 3);
    support_near(largest_difference(&image, &expected.rgb), 0, 1e-6, "difference");
    imagef_destroy(&image);
    picture_destroy(&expected);
}

// The device computes in single precision: a factor of ten above its rounding of sums of a few dozen terms.
static void the_device_agrees_with_the_reference(void **state) {
    (void)state;
    const char *path = support_path(support_scratch(), "device.exr");
    CommandResult r = command_run("render", model, "--scene", scene, "--view", "view_3", "-o", path, NULL);
    command_expect(&r, 0);
    Picture expected = expected_picture(render_settings_default());
    ImageF image = load(path, 3);
    support_near(largest_difference(&image, &expected.rgb), 0, 1e-4, "difference");
    imagef_destroy(&image);
    picture_destroy(&expected);
}

static void alpha_is_the_fourth_channel(void **state) {
    (void)state;
    const char *path = support_path(support_scratch(), "alpha.exr");
    CommandResult r = command_run("render", model, "--camera", camera_file, "-o", path, "--alpha", "--reference", NULL);
    command_expect(&r, 0);
    Picture expected = expected_picture(render_settings_default());
    ImageF image = load(path, 4);
    for (int i = 0; i < LITTLE_WIDTH * LITTLE_HEIGHT; i++) {
        const float *pixel = image.values + 4 * i;
        support_near(pixel[3], expected.alpha.values[i], 1e-6, "alpha");
        for (int c = 0; c < 3; c++)
            support_near(pixel[c] * pixel[3], expected.rgb.values[3 * i + c], 1e-6, "premultiplied colour");
    }
    imagef_destroy(&image);
    picture_destroy(&expected);
}

static void depth_is_in_world_units_in_a_float_file(void **state) {
    (void)state;
    const char *path = support_path(support_scratch(), "depth.exr");
    CommandResult r = command_run("render", model, "--camera", camera_file, "-o", path, "--depth", "--reference", NULL);
    command_expect(&r, 0);
    ImageF image = load(path, 1);
    float nearest = INFINITY, farthest = 0;
    for (int i = 0; i < LITTLE_WIDTH * LITTLE_HEIGHT; i++) {
        if (image.values[i] == 0) continue;
        nearest = fminf(nearest, image.values[i]);
        farthest = fmaxf(farthest, image.values[i]);
    }
    double distance = hypot(4, 1.2); // of the camera from the middle of the splats, which reach 0.7 sqrt(3) around it
    assert_true(farthest > nearest && nearest > distance - 1.25 && farthest < distance + 1.25);
    imagef_destroy(&image);

    path = support_path(support_scratch(), "depth.png");
    r = command_run("render", model, "--camera", camera_file, "-o", path, "--depth", "--reference", NULL);
    command_expect(&r, 0);
    image = load(path, 1);
    float brightest = 0;
    for (int i = 0; i < LITTLE_WIDTH * LITTLE_HEIGHT; i++) brightest = fmaxf(brightest, image.values[i]);
    assert_true(brightest == 1);
    imagef_destroy(&image);
}

static void an_orbit_is_a_file_per_frame(void **state) {
    (void)state;
    const char *path = support_path(support_scratch(), "turn.png");
    CommandResult r =
        command_run("render", model, "--scene", scene, "--orbit", "3", "-o", path, "--json", "--reference", NULL);
    command_expect(&r, 0);
    json_t *root = json_loads(r.out, 0, NULL);
    const json_t *files = json_object_get(root, "files");
    assert_int_equal(json_array_size(files), 3);
    assert_int_equal(json_integer_value(json_object_get(root, "width")), LITTLE_WIDTH);
    ImageF frames[3];
    for (int i = 0; i < 3; i++) {
        char name[32];
        snprintf(name, sizeof name, "turn_%04d.png", i);
        const char *expected = support_path(support_scratch(), name);
        assert_string_equal(json_string_value(json_array_get(files, (size_t)i)), expected);
        frames[i] = load(expected, 3);
    }
    // The first frame stands where the first camera does, on the circle of all of them.
    ImageF photo = load(support_path(scene, "images/view_0.png"), 3);
    support_near(largest_difference(&frames[0], &photo), 0, 3 / 255.0, "first frame");
    assert_true(largest_difference(&frames[1], &photo) > 0.1);
    for (int i = 0; i < 3; i++) imagef_destroy(&frames[i]);
    imagef_destroy(&photo);
    json_decref(root);
}

static void downscale_makes_smaller_pictures(void **state) {
    (void)state;
    const char *path = support_path(support_scratch(), "small.png");
    static const char *const froms[][2] = {{"--view", "view_3"}, {"--camera", camera_file}};
    for (int i = 0; i < 2; i++) {
        CommandResult r = command_run("render", model, "--scene", scene, froms[i][0], froms[i][1], "-o", path,
                                      "--downscale", "2", "--reference", NULL);
        command_expect(&r, 0);
        int width, height, channels;
        assert_true(image_probe(path, &width, &height, &channels));
        assert_int_equal(width, LITTLE_WIDTH / 2);
        assert_int_equal(height, LITTLE_HEIGHT / 2);
    }
}

static void a_view_that_is_not_there_is_answered_with_the_nearest(void **state) {
    (void)state;
    CommandResult r = command_run("render", model, "--scene", scene, "--view", "view_33.png", "-o", "x.png", NULL);
    command_expect_error(&r, 1, "no view 'view_33.png'", "nearest: view_3.png", NULL);
    r = command_run("render", model, "--scene", scene, "--view", "banana", "-o", "x.png", NULL);
    command_expect_error(&r, 1, "its 9 views go from view_0.png to view_8.png", NULL);
}

static void wrong_usage_ends_with_exit_code_2(void **state) {
    (void)state;
    CommandResult r = command_run("render", model, "-o", "x.png", NULL);
    command_expect_error(&r, 2, "--view NAME", "--camera", "--orbit", NULL);
    r = command_run("render", model, "--view", "view_3", "--orbit", "3", "--scene", scene, "-o", "x.png", NULL);
    command_expect_error(&r, 2, "not several", NULL);
    r = command_run("render", model, "--view", "view_3", "-o", "x.png", NULL);
    command_expect_error(&r, 2, "--scene", NULL);
    r = command_run("render", model, "--camera", camera_file, NULL);
    command_expect_error(&r, 2, "-o OUT.png", NULL);
    r = command_run("render", model, "--camera", camera_file, "-o", "x.gif", NULL);
    command_expect_error(&r, 2, "x.gif", ".exr", NULL);
    r = command_run("render", model, "--camera", camera_file, "-o", "x.jpg", "--alpha", NULL);
    command_expect_error(&r, 2, "JPEG", NULL);
    r = command_run("render", model, "--camera", camera_file, "-o", "x.png", "--alpha", "--depth", NULL);
    command_expect_error(&r, 2, "--depth and --alpha", NULL);
    r = command_run("render", model, "--camera", camera_file, "-o", "x.png", "--stop", "before", NULL);
    command_expect_error(&r, 2, "--reference", NULL);
    r = command_run("render", model, "--camera", camera_file, "-o", "x.png", "--background", "1,1", NULL);
    command_expect_error(&r, 2, "1,1", NULL);
}

static void what_cannot_be_had_ends_with_exit_code_1(void **state) {
    (void)state;
    CommandResult r = command_run("render", model, "--camera", "none.json", "-o", "x.png", NULL);
    command_expect_error(&r, 1, "none.json", NULL);
    r = command_run("render", model, "--camera", "README.md", "-o", "x.png", NULL);
    command_expect_error(&r, 1, "README.md", NULL);
    r = command_run("render", model, "--camera", camera_file, "-o", "/nonexistent/x.png", NULL);
    command_expect_error(&r, 1, "/nonexistent", NULL);
    r = command_run("render", "none.ply", "--camera", camera_file, "-o", "x.png", NULL);
    command_expect_error(&r, 1, "none.ply", NULL);
    assert_int_equal(access("x.png", F_OK), -1); // nothing was left behind
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_camera_file_gives_the_references_floats),
        cmocka_unit_test(the_device_agrees_with_the_reference),
        cmocka_unit_test(alpha_is_the_fourth_channel),
        cmocka_unit_test(depth_is_in_world_units_in_a_float_file),
        cmocka_unit_test(an_orbit_is_a_file_per_frame),
        cmocka_unit_test(downscale_makes_smaller_pictures),
        cmocka_unit_test(a_view_that_is_not_there_is_answered_with_the_nearest),
        cmocka_unit_test(wrong_usage_ends_with_exit_code_2),
        cmocka_unit_test(what_cannot_be_had_ends_with_exit_code_1),
    };
    return cmocka_run_group_tests(tests, make_files, NULL);
}
