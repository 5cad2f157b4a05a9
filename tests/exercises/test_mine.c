// test_mine.c - a person's own functions in the lab's pictures.
#include "exercises/harness/catalogue.h"
#include "exercises/harness/mine_picture2d.h"
#include "exercises/harness/mine_rasterizer.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "splat3d/reference.h"
#include "tests/support/random_scene.h"
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 40, HEIGHT = 30 };

static char *root; // a copy of the exercises, in which nobody has written anything

static int copy_exercises(void **state) {
    (void)state;
    root = mem_format("%s/exercises", support_scratch());
    char *command = mem_format("cp -r exercises '%s' && rm -f '%s'/progress.json", root, root);
    int code = system(command);
    setenv("SPLATLAB_EXERCISES", root, 1);
    mem_free(command);
    return code;
}

static int forget_exercises(void **state) {
    (void)state;
    mem_free(root);
    return 0;
}

static void write_text(const char *path, const char *text) { assert_true(file_write(path, text, strlen(text))); }

static void copy_file(const char *from, const char *to) {
    char *text;
    size_t size;
    assert_true(file_read(from, &text, &size));
    assert_true(file_write(to, text, size));
    mem_free(text);
}

// Everybody's file is the stub, or our solution.
static void lay_out(bool solved) {
    for (int i = 0; i < EXERCISE_COUNT; i++) {
        char *source = exercise_source(root, EXERCISES[i]), *solution = exercise_solution(root, EXERCISES[i]),
             *stub = exercise_path(root, EXERCISES[i], "stub.c");
        if (file_exists(stub)) copy_file(solved ? solution : stub, source);
        mem_free(source);
        mem_free(solution);
        mem_free(stub);
    }
}

static double largest_difference(const ImageF *a, const ImageF *b) {
    double largest = 0;
    for (int i = 0; i < a->width * a->height * 3; i++)
        largest = fmax(largest, fabs((double)(a->values[i] - b->values[i])));
    return largest;
}

static Scene2d small_scene(void) {
    Scene2d scene = scene2d_default();
    scene.width = WIDTH, scene.height = HEIGHT;
    for (int i = 0; i < scene.count; i++) {
        Blob *b = &scene.blobs[i];
        b->mean[0] *= WIDTH / 800.0, b->mean[1] *= HEIGHT / 600.0;
        b->sigma_x *= WIDTH / 800.0, b->sigma_y *= HEIGHT / 600.0;
    }
    return scene;
}

// The picture by the person's functions against the rasterizer's; returns the state of E01.
static void compare_plane(Mine *mine, const Scene2d *scene, char state[MINE_STATE_BYTES]) {
    ImageF mine_picture = imagef_create(WIDTH, HEIGHT, 3), picture = imagef_create(WIDTH, HEIGHT, 3);
    RasterSettings settings = raster_settings_default();
    Raster2d raster = {0};
    raster2d_load(&raster, scene, view2d_whole());
    raster2d_draw(&raster, &settings, &picture, NULL);
    assert_int_equal(mine_picture2d(mine, scene, view2d_whole(), &settings.rule, &mine_picture, NULL), 1);
    assert_true(largest_difference(&mine_picture, &picture) < 1e-5); // the rasterizer blends floats
    mine_state(mine, MINE_COV2, state);
    raster2d_destroy(&raster);
    imagef_destroy(&mine_picture);
    imagef_destroy(&picture);
}

static void with_nothing_written_the_reference_draws(void **state) {
    (void)state;
    char text[MINE_STATE_BYTES];
    Scene2d scene = small_scene();
    lay_out(false);
    Mine *mine = mine_open();
    if (!mine) print_message("%s\n", fail_text());
    assert_non_null(mine);
    compare_plane(mine, &scene, text);
    assert_string_equal(text, "E01 cov2: the reference (not started yet)");
    for (MinePart part = 0; part < MINE_COUNT; part++) assert_false(mine_is_used(mine, part));
    mine_close(mine);
    scene2d_destroy(&scene);
}

static void right_answers_draw_the_same_picture(void **state) {
    (void)state;
    char text[MINE_STATE_BYTES];
    Scene2d scene = small_scene();
    lay_out(true);
    Mine *mine = mine_open();
    if (!mine) print_message("%s\n", fail_text());
    assert_non_null(mine);
    compare_plane(mine, &scene, text);
    assert_string_equal(text, "E01 cov2: yours");
    for (MinePart part = 0; part < MINE_COUNT; part++) assert_true(mine_is_used(mine, part));
    mine_close(mine);
    scene2d_destroy(&scene);
}

static void what_is_saved_is_tried_again(void **state) {
    (void)state;
    char *source = exercise_source(root, EXERCISES[0]);
    lay_out(true);
    Mine *mine = mine_open();
    if (!mine) print_message("%s\n", fail_text());
    assert_non_null(mine);
    assert_false(mine_refresh(mine));
    write_text(source, "this is no C\n");
    assert_true(mine_refresh(mine));
    char text[MINE_STATE_BYTES];
    mine_state(mine, MINE_COV2, text);
    assert_string_equal(text, "E01 cov2: the reference (it does not compile)");
    mine_close(mine);
    mem_free(source);
}

// It passes every test, and breaks on a scale that no test has.
static void a_crash_is_shown_and_the_reference_draws(void **state) {
    (void)state;
    char text[MINE_STATE_BYTES], *source = exercise_source(root, EXERCISES[0]);
    Scene2d scene = small_scene();
    lay_out(true);
    write_text(source, "#include \"exercises/exercise.h\"\n"
                       "void cov2_from_rs(REAL theta, REAL sx, REAL sy, REAL S[3]) {\n"
                       "    REAL c = cos(theta), s = sin(theta), *nowhere = NULL;\n"
                       "    if (sx > 2000) *nowhere = 1;\n"
                       "    S[0] = c * c * sx * sx + s * s * sy * sy;\n"
                       "    S[1] = c * s * (sx * sx - sy * sy);\n"
                       "    S[2] = s * s * sx * sx + c * c * sy * sy;\n"
                       "}\n");
    Mine *mine = mine_open();
    if (!mine) print_message("%s\n", fail_text());
    assert_non_null(mine);
    compare_plane(mine, &scene, text);
    assert_string_equal(text, "E01 cov2: yours");
    scene.blobs[0].sigma_x = 3000;
    compare_plane(mine, &scene, text);
    assert_non_null(strstr(text, "cov2_from_rs() crashed at cov2.c:4"));
    mine_close(mine);
    scene2d_destroy(&scene);
    mem_free(source);
}

static void all_stages_of_a_3d_picture_may_be_yours(void **state) {
    (void)state;
    RandomScene scene = random_scene_default(5);
    Camera camera = random_scene_camera(5, WIDTH, HEIGHT);
    Gaussians model = random_scene_gaussians(&scene, &camera);
    RenderSettings settings = render_settings_default();
    Rasterizer *reference = reference_rasterizer_create();
    Picture wanted, picture;
    assert_true(rasterizer_render(reference, &model, &camera, &settings, &wanted));
    for (int solved = 0; solved <= 1; solved++) {
        lay_out(solved);
        Mine *mine = mine_open();
        assert_non_null(mine);
        Rasterizer *rasterizer = mine_rasterizer_create(mine);
        assert_true(rasterizer_render(rasterizer, &model, &camera, &settings, &picture));
        assert_true(largest_difference(&picture.rgb, &wanted.rgb) < 1e-6);
        picture_destroy(&picture);
        rasterizer_destroy(rasterizer);
        mine_close(mine);
    }
    picture_destroy(&wanted);
    rasterizer_destroy(reference);
    gaussians_destroy(&model);
}

// It passes every test; in a picture of this size alone it says infinite, not a number, and far outside.
static void wild_places_do_no_harm(void **state) {
    (void)state;
    RandomScene scene = random_scene_default(5);
    Camera camera = random_scene_camera(5, WIDTH, HEIGHT);
    Gaussians model = random_scene_gaussians(&scene, &camera);
    RenderSettings settings = render_settings_default();
    Picture picture;
    const Exercise *exercise = NULL;
    for (int i = 0; i < EXERCISE_COUNT; i++)
        if (strcmp(EXERCISES[i]->name, "camera") == 0) exercise = EXERCISES[i];
    char *source = exercise_source(root, exercise);
    lay_out(true);
    write_text(source, "#define project right_project\n"
                       "#include \"exercises/solutions/camera.c\"\n"
                       "#undef project\n"
                       "int project(const Cam *c, const REAL p[3], REAL uv[2], REAL *z) {\n"
                       "    static const REAL places[] = {1e30, -1e30, NAN, INFINITY, -INFINITY};\n"
                       "    static int call;\n"
                       "    int seen = right_project(c, p, uv, z);\n"
                       "    if (c->width != 40 || c->height != 30) return seen;\n"
                       "    uv[0] = uv[1] = *z = places[call++ % 5];\n"
                       "    if (call % 2) uv[1] = 15;\n"
                       "    return 1;\n"
                       "}\n");
    Mine *mine = mine_open();
    assert_non_null(mine);
    assert_true(mine_is_used(mine, MINE_CAMERA));
    Rasterizer *rasterizer = mine_rasterizer_create(mine);
    assert_true(rasterizer_render(rasterizer, &model, &camera, &settings, &picture));
    for (int i = 0; i < WIDTH * HEIGHT * 3; i++) assert_true(isfinite(picture.rgb.values[i]));
    picture_destroy(&picture);
    rasterizer_destroy(rasterizer);
    mine_close(mine);
    gaussians_destroy(&model);
    mem_free(source);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(with_nothing_written_the_reference_draws),
        cmocka_unit_test(right_answers_draw_the_same_picture),
        cmocka_unit_test(what_is_saved_is_tried_again),
        cmocka_unit_test(a_crash_is_shown_and_the_reference_draws),
        cmocka_unit_test(all_stages_of_a_3d_picture_may_be_yours),
        cmocka_unit_test(wild_places_do_no_harm),
    };
    return cmocka_run_group_tests(tests, copy_exercises, forget_exercises);
}
