// test_transforms.c - Blender's and nerfstudio's transforms.json, good and broken.
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "tests/support/scene_files.h"
#include "tests/support/support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

// A camera at (0, 0, 4) that looks along -z with y up: OpenGL's own axes, moved.
#define MATRIX "[[1,0,0,0],[0,1,0,0],[0,0,1,4],[0,0,0,1]]"
#define MOVED  "[[1,0,0,2],[0,1,0,0],[0,0,1,4],[0,0,0,1]]"

static const char TRAIN[] = "{\"camera_angle_x\": 1.0, \"frames\": [\n"
                            "{\"file_path\": \"./train/r_1\", \"transform_matrix\": " MATRIX "},\n"
                            "{\"file_path\": \"./train/r_0\", \"transform_matrix\": " MOVED "}]}";
static const char TEST[] = "{\"camera_angle_x\": 1.0, \"frames\": [\n"
                           "{\"file_path\": \"test/r_0\", \"transform_matrix\": " MATRIX "}]}";

static const char *blender_scene(const char *name) {
    const char *folder = scene_folder(name);
    scene_write_text(folder, "transforms_train.json", TRAIN);
    scene_write_text(folder, "transforms_test.json", TEST);
    scene_write_image(folder, "train/r_0.png", 10, 8, 4);
    scene_write_image(folder, "train/r_1.jpg", 20, 16, 3);
    scene_write_image(folder, "test/r_0.png", 10, 8, 4);
    return folder;
}

static void a_blender_set_brings_its_own_split(void **state) {
    (void)state;
    Dataset read = scene_open(blender_scene("blender"), 1);
    assert_string_equal(read.kind, "Blender transforms.json");
    assert_int_equal(read.view_count, 3);
    const char *names[] = {"test/r_0", "train/r_0", "train/r_1"};
    for (int i = 0; i < 3; i++) {
        assert_string_equal(read.views[i].name, names[i]);
        assert_int_equal(read.views[i].held_out, i == 0);
    }
    assert_true(file_has_ending(read.views[2].path, "train/r_1.jpg"));
    assert_int_equal(read.views[1].channels, 4);
    const Camera *camera = &read.views[1].camera;
    support_near(camera->fx, 5 / tan(0.5), 1e-12, "focal length from the angle and the image's width");
    assert_true(camera->fy == camera->fx && camera->cx == 5 && camera->cy == 4);
    support_near(read.views[2].camera.fx, 10 / tan(0.5), 1e-12, "of the wider image");
    assert_int_equal(read.points.count, 0);
    assert_true(read.init_half_width == 1.3);
    assert_true(vec3_length(read.init_centre) == 0);
    dataset_destroy(&read);
}

static void opengl_axes_become_opencv_axes(void **state) {
    (void)state;
    Dataset read = scene_open(blender_scene("axes"), 1);
    const Camera *camera = &dataset_find_view(&read, "train/r_1")->camera;
    double x, y, depth;
    assert_true(camera_project(camera, vec3(0, 0, 0), &x, &y, &depth));
    support_near(depth, 4, 1e-12, "depth");
    support_near(x, 10, 1e-12, "x");
    assert_true(camera_project(camera, vec3(1, 1, 0), &x, &y, &depth));
    assert_true(x > 10 && y < 8); // right and up in the world are right and up in the picture
    dataset_destroy(&read);
}

static void without_a_test_file_the_val_file_or_every_8th_is_held_out(void **state) {
    (void)state;
    const char *folder = blender_scene("split");
    assert_int_equal(unlink(support_path(folder, "transforms_test.json")), 0);
    Dataset read = scene_open(folder, 1);
    assert_int_equal(read.view_count, 2);
    assert_true(read.views[0].held_out && !read.views[1].held_out);
    dataset_destroy(&read);
    scene_write_text(folder, "transforms_val.json", TEST);
    read = scene_open(folder, 1);
    assert_int_equal(read.view_count, 3);
    assert_int_equal(dataset_held_out_count(&read), 1);
    assert_true(dataset_find_view(&read, "test/r_0")->held_out);
    dataset_destroy(&read);
}

// ---- nerfstudio ----

static const char NERFSTUDIO[] =
    "{\"camera_model\": \"OPENCV\", \"k1\": 0, \"p2\": 0.0, \"w\": 40, \"h\": 32,\n"
    "\"fl_x\": 50, \"fl_y\": 51, \"cx\": 21, \"cy\": 15.5, \"ply_file_path\": \"cloud.ply\",\n"
    "\"frames\": [\n"
    "{\"file_path\": \"images/b.png\", \"transform_matrix\": " MATRIX "},\n"
    "{\"file_path\": \"images/a.png\", \"transform_matrix\": " MOVED ", \"fl_x\": 60}]}";
static const char CLOUD[] =
    "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n"
    "0 1 2 3 4 5\n6 7 8 9 10 11\n";

static const char *nerfstudio_scene(const char *name) {
    const char *folder = scene_folder(name);
    scene_write_text(folder, "transforms.json", NERFSTUDIO);
    scene_write_text(folder, "cloud.ply", CLOUD);
    scene_write_image(folder, "images/a.png", 40, 32, 3);
    scene_write_image(folder, "images/b.png", 20, 16, 3); // on disk at half the size that the file says
    return folder;
}

static void a_nerfstudio_scene_is_read(void **state) {
    (void)state;
    Dataset read = scene_open(nerfstudio_scene("nerfstudio"), 1);
    assert_string_equal(read.kind, "nerfstudio transforms.json");
    assert_string_equal(read.views[0].name, "images/a.png");
    assert_true(read.views[0].held_out && !read.views[1].held_out);
    const Camera *a = &read.views[0].camera, *b = &read.views[1].camera;
    assert_true(a->fx == 60 && a->fy == 51 && a->cx == 21 && a->cy == 15.5 && a->width == 40);
    assert_true(b->fx == 25 && b->fy == 25.5 && b->cx == 10.5 && b->cy == 7.75 && b->width == 20);
    assert_int_equal(read.points.count, 2);
    assert_true(read.points.xyz[5] == 8 && read.points.rgb[5] == 11);
    dataset_destroy(&read);
}

static void without_points_the_cube_is_round_the_cameras(void **state) {
    (void)state;
    const char *folder = scene_folder("cube");
    scene_write_text(folder, "transforms.json",
                     "{\"fl_x\": 50, \"frames\": [{\"file_path\": \"a.png\", \"transform_matrix\": " MATRIX "},"
                     "{\"file_path\": \"b.png\", \"transform_matrix\": " MATRIX "},"
                     "{\"file_path\": \"c.png\", \"transform_matrix\": " MOVED "}]}");
    for (int i = 0; i < 3; i++) scene_write_image(folder, (const char *[]){"a.png", "b.png", "c.png"}[i], 8, 8, 3);
    Dataset read = scene_open(folder, 1);
    support_near(read.centre.x, 1, 1e-12, "centre of the two training cameras");
    support_near(read.centre.z, 4, 1e-12, "centre");
    support_near(read.extent, 1.1, 1e-12, "extent");
    assert_true(read.init_half_width == read.extent && read.init_centre.x == read.centre.x);
    assert_true(read.views[0].camera.fx == 50 && read.views[0].camera.fy == 50);
    dataset_destroy(&read);
}

static void what_was_written_is_read_back(void **state) {
    (void)state;
    const char *folder = scene_folder("written");
    Dataset made = scene_make(folder, 10, 12, 9);
    char *path = file_join(folder, "transforms.json");
    if (!transforms_write(path, &made)) fail_msg("%s", fail_text());
    Dataset read = scene_open(folder, 1);
    assert_int_equal(read.view_count, 10);
    for (int i = 0; i < 10; i++) {
        const Camera *a = &read.views[i].camera, *b = &made.views[i].camera;
        assert_int_equal(strncmp(read.views[i].name, "images/v", 8), 0);
        assert_int_equal(read.views[i].held_out, i % 8 == 0);
        assert_true(a->fx == b->fx && a->fy == b->fy && a->cx == b->cx && a->cy == b->cy);
        for (int k = 0; k < 9; k++) support_near(a->rotation.m[k], b->rotation.m[k], 1e-12, "rotation");
        support_near(vec3_length(vec3_sub(a->translation, b->translation)), 0, 1e-12, "translation");
    }
    mem_free(path);
    dataset_destroy(&read);
    dataset_destroy(&made);
}

static void what_is_wrong_is_named(void **state) {
    (void)state;
    const struct {
        const char *find, *by, *reason;
    } cases[] = {
        {"\"fl_x\": 50", "\"fl_x\": NaN", "line 2"},
        {"\"fl_x\": 50", "\"fl_x\": -50", "focal"},
        {"\"fl_x\": 50", "\"fl_x\": \"50\"", "\"fl_x\" is a text"},
        {"\"fl_x\": 50, ", "", "neither \"fl_x\" nor"},
        {"\"fl_x\": 50", "\"camera_angle_x\": 4", "camera_angle_x"},
        {"\"cx\": 21", "\"cx\": null", "\"cx\" is null"},
        {"\"w\": 40", "\"w\": 40.5", "40.5 x 32"},
        {"\"w\": 40", "\"w\": 0", "0 x 32"},
        {"\"w\": 40", "\"w\": 32", "another shape"},
        {"\"w\": 40, \"h\": 32", "\"w\": 32, \"h\": 40", "turned"},
        {"\"k1\": 0", "\"k1\": 0.01", "k1 = 0.01"},
        {"\"p2\": 0.0", "\"p2\": -0.5", "image_undistorter"},
        {"OPENCV", "OPENCV_FISHEYE", "OPENCV_FISHEYE is not supported"},
        {"\"frames\"", "\"pictures\"", "no list \"frames\""},
        {"images/b.png", "images/gone.png", "images/gone.png"},
        {"images/b.png", "images", "there is no image"},
        {"images/b.png", "", "\"file_path\" is empty"},
        {"images/b.png", "images/a.png", "two views have the name"},
        {"\"file_path\"", "\"path\"", "frame 1 of 2: \"file_path\" is missing"},
        {"\"transform_matrix\": [[1,", "\"transform\": [[1,", "\"transform_matrix\" is missing"},
        {"[0,0,0,1]]}", "[0,0,0]]}", "3 entries, want 4"},
        {"[0,0,0,1]]}", "[0,0,1,1]]}", "0 0 0 1"},
        {"[[1,0,0,0]", "[[-1,0,0,0]", "mirror"},
        {"[[1,0,0,0]", "[[1,1,0,0]", "no rotation"},
        {"[[1,0,0,0]", "[[1,0,0,1e999]", "line 4"},
        {"[[1,0,0,0]", "[[1,0,0,null]", "frame 1 of 2"},
        {"\"cloud.ply\"", "\"gone.ply\"", "gone.ply"},
        {"\"cloud.ply\"", "7", "ply_file_path"},
        {"}]}", "}]", "line 5"},
        {"\"frames\": [", "\"frames\": [],\"more\": [", "empty"},
        {"\"frames\": [", "\"frames\": [7,", "frame 1 of 3"},
    };
    const char *folder = nerfstudio_scene("bad");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *at = strstr(NERFSTUDIO, cases[i].find);
        assert_non_null(at);
        char *text =
            mem_format("%.*s%s%s", (int)(at - NERFSTUDIO), NERFSTUDIO, cases[i].by, at + strlen(cases[i].find));
        scene_write_text(folder, "transforms.json", text);
        scene_refuses(folder, cases[i].by, cases[i].reason, "bad");
        mem_free(text);
    }
    scene_write_text(folder, "transforms.json", NERFSTUDIO);
    Dataset read = scene_open(folder, 1);
    dataset_destroy(&read);
}

static void a_broken_image_or_cloud_is_named(void **state) {
    (void)state;
    const char *folder = nerfstudio_scene("broken");
    scene_write_text(folder, "images/b.png", "text");
    scene_refuses(folder, "text", "images/b.png", "cannot read image");
    scene_write_image(folder, "images/b.png", 40, 32, 3);
    scene_write(folder, "cloud.ply", CLOUD, sizeof CLOUD - 20);
    scene_refuses(folder, "cut", "cloud.ply", "complete");
}

static void the_chair_is_read(void **state) {
    (void)state;
    Dataset read = scene_open(support_data("chair"), 1);
    assert_int_equal(dataset_train_count(&read), 100);
    assert_int_equal(dataset_held_out_count(&read), 50);
    for (int i = 0; i < read.view_count; i++) {
        const View *view = &read.views[i];
        assert_int_equal(view->camera.width, 400);
        assert_int_equal(view->camera.height, 400);
        assert_int_equal(view->channels, 4);
        support_near(view->camera.fx, 200 / tan(0.6911112070083618 / 2), 1e-9, "focal length");
        double x, y, depth; // all look at the middle of the scene from a distance of 4.03
        assert_true(camera_project(&view->camera, vec3(0, 0, 0), &x, &y, &depth));
        support_near(x, 200, 0.1, "x");
        support_near(y, 200, 0.1, "y");
        support_near(depth, 4.031, 0.01, "depth");
    }
    assert_true(read.init_half_width == 1.3);
    dataset_destroy(&read);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_blender_set_brings_its_own_split),
        cmocka_unit_test(opengl_axes_become_opencv_axes),
        cmocka_unit_test(without_a_test_file_the_val_file_or_every_8th_is_held_out),
        cmocka_unit_test(a_nerfstudio_scene_is_read),
        cmocka_unit_test(without_points_the_cube_is_round_the_cameras),
        cmocka_unit_test(what_was_written_is_read_back),
        cmocka_unit_test(what_is_wrong_is_named),
        cmocka_unit_test(a_broken_image_or_cloud_is_named),
        cmocka_unit_test(the_chair_is_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
