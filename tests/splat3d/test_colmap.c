// test_colmap.c - COLMAP models in both forms, in every place where they may stand, and broken in many ways.
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/base/rng.h"
#include "lab/io/file.h"
#include "tests/support/scene_files.h"
#include "tests/support/support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void near_camera(const Camera *a, const Camera *b) {
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    support_near(a->fx, b->fx, 1e-9, "fx");
    support_near(a->fy, b->fy, 1e-9, "fy");
    support_near(a->cx, b->cx, 1e-9, "cx");
    support_near(a->cy, b->cy, 1e-9, "cy");
    for (int i = 0; i < 9; i++) support_near(a->rotation.m[i], b->rotation.m[i], 1e-12, "rotation");
    support_near(a->translation.x, b->translation.x, 1e-12, "tx");
    support_near(a->translation.y, b->translation.y, 1e-12, "ty");
    support_near(a->translation.z, b->translation.z, 1e-12, "tz");
}

static void near_scene(const Dataset *a, const Dataset *b) {
    assert_int_equal(a->view_count, b->view_count);
    for (int i = 0; i < a->view_count; i++) {
        assert_string_equal(a->views[i].name, b->views[i].name);
        assert_int_equal(a->views[i].held_out, i % 8 == 0);
        near_camera(&a->views[i].camera, &b->views[i].camera);
    }
    assert_int_equal(a->points.count, b->points.count);
    assert_memory_equal(a->points.xyz, b->points.xyz, (size_t)b->points.count * 3 * sizeof(double));
    assert_memory_equal(a->points.rgb, b->points.rgb, (size_t)b->points.count * 3);
}

static void a_binary_model_comes_back(void **state) {
    (void)state;
    const char *folder = scene_folder("binary");
    Dataset made = scene_make(folder, 10, 12, 9);
    made.views[3].camera.fx += 1; // a second camera
    assert_true(colmap_write(folder, &made));
    Dataset read = scene_open(folder, 1);
    assert_string_equal(read.kind, "COLMAP binary");
    near_scene(&read, &made);
    dataset_destroy(&read);
    dataset_destroy(&made);
}

// ---- text ----

static const char CAMERAS[] = "# Camera list with one line of data per camera:\n# Number of cameras: 2\n"
                              "1 PINHOLE 24 18 20 21 12.25 9\n7 SIMPLE_PINHOLE 12 9 10.5 6 4.5\n";
static const char IMAGES[] = "# Image list with two lines of data per image:\n"
                             "# Number of images: 3, mean observations per image: 1.5\n"
                             "2 1 0 0 0 0.5 -1 2 7 b c.png\n\n"
                             "1 0 1 0 0 0 0 0 1 a.png\n1.5 2.5 -1 3 4 11\n"
                             "9 0.5 0.5 0.5 0.5 1 2 3 7 B.png\n\n";
static const char POINTS[] = "# Number of points: 2, mean track length: 3.5\n"
                             "11 1 2.5 -3e-1 0 128 255 0.7 2 1 1 0\n5 4 5 6 9 8 7 0.1\n";

// A good scene in folder/sparse/0 as text.
static const char *text_scene(const char *name) {
    const char *folder = scene_folder(name);
    scene_write_text(folder, "sparse/0/cameras.txt", CAMERAS);
    scene_write_text(folder, "sparse/0/images.txt", IMAGES);
    scene_write_text(folder, "sparse/0/points3D.txt", POINTS);
    scene_write_image(folder, "images/a.png", 24, 18, 3);
    scene_write_image(folder, "images/b c.png", 12, 9, 3);
    scene_write_image(folder, "images/B.png", 12, 9, 4);
    return folder;
}

static void a_text_model_is_read(void **state) {
    (void)state;
    Dataset read = scene_open(text_scene("text"), 1);
    assert_string_equal(read.kind, "COLMAP text");
    assert_int_equal(read.view_count, 3);
    const char *names[] = {"B.png", "a.png", "b c.png"}; // sorted by bytes
    for (int i = 0; i < 3; i++) {
        assert_string_equal(read.views[i].name, names[i]);
        assert_int_equal(read.views[i].held_out, i == 0);
    }
    assert_int_equal(read.views[0].channels, 4);
    assert_int_equal(read.views[1].channels, 3);
    const Camera *a = &read.views[1].camera, *b = &read.views[2].camera;
    assert_true(a->fx == 20 && a->fy == 21 && a->cx == 12.25 && a->cy == 9);
    assert_true(b->fx == 10.5 && b->fy == 10.5 && b->cx == 6 && b->cy == 4.5);
    assert_true(b->translation.x == 0.5 && b->translation.y == -1 && b->translation.z == 2);
    assert_true(a->rotation.m[0] == 1 && a->rotation.m[4] == -1 && a->rotation.m[8] == -1); // half a turn about x
    assert_int_equal(read.points.count, 2);
    assert_true(read.points.xyz[2] == -0.3 && read.points.xyz[3] == 4);
    assert_int_equal(read.points.rgb[2], 255);
    dataset_destroy(&read);
}

static void the_model_may_stand_in_three_places(void **state) {
    (void)state;
    const char *folder = text_scene("places");
    char *old = file_join(folder, "sparse/0"), *sparse = file_join(folder, "sparse");
    Dataset read = scene_open(old, 1); // the model's own folder is given: the photos are two folders up
    assert_int_equal(read.view_count, 3);
    dataset_destroy(&read);
    const char *files[] = {"cameras.txt", "images.txt", "points3D.txt"};
    const char *places[] = {"sparse", "."};
    const char *from = old;
    for (int place = 0; place < 2; place++) {
        char *to = file_join(folder, places[place]);
        for (int i = 0; i < 3; i++)
            assert_int_equal(rename(support_path(from, files[i]), support_path(to, files[i])), 0);
        read = scene_open(folder, 1);
        assert_int_equal(read.view_count, 3);
        dataset_destroy(&read);
        from = sparse;
        mem_free(to);
    }
    mem_free(old);
    mem_free(sparse);
}

static void reduced_images_scale_the_intrinsics(void **state) {
    (void)state;
    const char *folder = text_scene("reduced");
    char *images = file_join(folder, "images");
    for (int i = 0; i < 3; i++)
        assert_int_equal(unlink(support_path(images, (const char *[]){"a.png", "b c.png", "B.png"}[i])), 0);
    mem_free(images);
    scene_write_image(folder, "images_8/b c.png", 2, 1, 3); // the larger pictures are taken
    scene_write_image(folder, "images_4/a.png", 6, 5, 3);   // 18 / 4 = 4.5 was rounded up
    scene_write_image(folder, "images_4/b c.png", 3, 2, 3);
    scene_write_image(folder, "images_4/B.png", 3, 2, 3);
    Dataset read = scene_open(folder, 1);
    const Camera *a = &dataset_find_view(&read, "a.png")->camera;
    assert_int_equal(a->width, 6);
    assert_int_equal(a->height, 5);
    support_near(a->fx, 20 * 6 / 24.0, 1e-12, "fx");
    support_near(a->fy, 21 * 5 / 18.0, 1e-12, "fy"); // by the true ratio
    support_near(a->cx, 12.25 / 4, 1e-12, "cx");
    dataset_destroy(&read);
}

static void a_model_without_points_is_read(void **state) {
    (void)state;
    const char *folder = text_scene("pointless");
    assert_int_equal(unlink(support_path(folder, "sparse/0/points3D.txt")), 0);
    Dataset read = scene_open(folder, 1);
    assert_int_equal(read.points.count, 0);
    assert_true(read.init_half_width == read.extent);
    assert_memory_equal(&read.init_centre, &read.centre, sizeof(Vec3));
    dataset_destroy(&read);
}

static void what_is_wrong_in_a_text_model_is_named(void **state) {
    (void)state;
    const struct {
        const char *file, *good, *find, *by, *reason;
    } cases[] = {
        {"cameras.txt", CAMERAS, "1 PINHOLE", "1 SIMPLE_RADIAL", "image_undistorter"},
        {"cameras.txt", CAMERAS, "1 PINHOLE", "1 OPENCV_FISHEYE", "OPENCV_FISHEYE is not supported"},
        {"cameras.txt", CAMERAS, "1 PINHOLE", "1 BANANA", "unknown camera model \"BANANA\""},
        {"cameras.txt", CAMERAS, "1 PINHOLE", "x PINHOLE", "line 3"},
        {"cameras.txt", CAMERAS, "24 18 20", "0 18 20", "WIDTH"},
        {"cameras.txt", CAMERAS, "24 18 20", "24 1e9 20", "HEIGHT"},
        {"cameras.txt", CAMERAS, "24 18 20", "24 18 -20", "focal"},
        {"cameras.txt", CAMERAS, "24 18 20", "24 18 nan", "focal"},
        {"cameras.txt", CAMERAS, "12.25 9\n", "12.25\n", "PARAMS"},
        {"cameras.txt", CAMERAS, "12.25 9\n", "inf 9\n", "principal point"},
        {"cameras.txt", CAMERAS, "12.25 9\n", "12.25 9 1\n", "more than the 4"},
        {"cameras.txt", CAMERAS, "7 SIMPLE", "1 SIMPLE", "two cameras have the number 1"},
        {"cameras.txt", CAMERAS, "7 SIMPLE", "8 SIMPLE", "camera 7, which is not among"},
        {"cameras.txt", CAMERAS, "7 SIMPLE_PINHOLE 12 9 10.5 6 4.5\n", "", "comment says 2 cameras"},
        {"cameras.txt", CAMERAS, "24 18", "24 24", "another shape"},
        {"cameras.txt", CAMERAS, "24 18", "18 24", "turned"},
        {"images.txt", IMAGES, "2 1 0 0 0", "2 0 0 0 0", "quaternion"},
        {"images.txt", IMAGES, "2 1 0 0 0", "2 nan 0 0 0", "line 3"},
        {"images.txt", IMAGES, "0.5 -1 2", "0.5 inf 2", "translation"},
        {"images.txt", IMAGES, "0.5 -1 2", "0.5 -1", "CAMERA_ID"},
        {"images.txt", IMAGES, "7 b c.png", "7", "no name"},
        {"images.txt", IMAGES, "b c.png", "a.png", "two views have the name a.png"},
        {"images.txt", IMAGES, "b c.png", "gone.png", "gone.png"},
        {"images.txt", IMAGES, "7 b c.png\n", "7 b c.png", "triples"}, // the empty line is lost
        {"images.txt", IMAGES, "9 0.5 0.5 0.5 0.5 1 2 3 7 B.png\n\n", "", "comment says 3 images"},
        {"images.txt", IMAGES, "9 0.5 0.5 0.5 0.5 1 2 3 7 B.png\n\n", "9 0.5 0.5", "line 7"},
        {"images.txt", IMAGES, IMAGES, "# nothing\n", "no images"},
        {"images.txt", IMAGES, IMAGES, "", "no images"},
        {"points3D.txt", POINTS, "1 2.5 -3e-1", "1 nan -3e-1", "not finite"},
        {"points3D.txt", POINTS, "1 2.5 -3e-1", "1 1e39 -3e-1", "not finite"}, // too large for a float
        {"points3D.txt", POINTS, "1 2.5 -3e-1", "1 x -3e-1", "line 2"},
        {"points3D.txt", POINTS, "0 128 255", "0 128 256", "0 to 255"},
        {"points3D.txt", POINTS, "0 128 255", "0 128 -1", "0 to 255"},
        {"points3D.txt", POINTS, "7 0.1\n", "7", "ERROR"},
        {"points3D.txt", POINTS, "5 4 5 6 9 8 7 0.1\n", "", "comment says 2 points"},
    };
    const char *folder = text_scene("bad text");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *at = strstr(cases[i].good, cases[i].find);
        assert_non_null(at);
        char *name = mem_format("sparse/0/%s", cases[i].file);
        char *text =
            mem_format("%.*s%s%s", (int)(at - cases[i].good), cases[i].good, cases[i].by, at + strlen(cases[i].find));
        scene_write_text(folder, name, text);
        scene_refuses(folder, cases[i].by, cases[i].reason, "bad text");
        scene_write_text(folder, name, cases[i].good);
        mem_free(text);
        mem_free(name);
    }
    Dataset read = scene_open(folder, 1); // and without the changes it is good
    dataset_destroy(&read);
}

// ---- binary, broken ----

static char *read_whole(const char *folder, const char *name, size_t *size) {
    char *path = file_join(folder, name), *data;
    assert_true(file_read(path, &data, size));
    mem_free(path);
    return data;
}

static const char *const BINARY[] = {"sparse/0/cameras.bin", "sparse/0/images.bin", "sparse/0/points3D.bin"};

static void every_cut_of_a_binary_model_is_noticed(void **state) {
    (void)state;
    const char *folder = scene_folder("cut");
    Dataset made = scene_make(folder, 3, 12, 9);
    assert_true(colmap_write(folder, &made));
    for (int i = 0; i < 3; i++) {
        size_t size;
        char *data = read_whole(folder, BINARY[i], &size);
        for (size_t cut = 0; cut < size; cut++) {
            scene_write(folder, BINARY[i], data, cut);
            scene_refuses(folder, BINARY[i], BINARY[i], "is it complete");
        }
        char *longer = mem_alloc(size + 1, 1);
        memcpy(longer, data, size);
        scene_write(folder, BINARY[i], longer, size + 1);
        scene_refuses(folder, "one byte more", BINARY[i], "1 bytes are left");
        scene_write(folder, BINARY[i], data, size);
        mem_free(longer);
        mem_free(data);
    }
    dataset_destroy(&made);
}

static void random_damage_does_no_harm(void **state) {
    (void)state;
    const char *folder = scene_folder("damage");
    Dataset made = scene_make(folder, 3, 12, 9), read;
    assert_true(colmap_write(folder, &made));
    Rng rng = rng_at(9, RNG_TEST, 0, 0);
    int refused = 0;
    for (int i = 0; i < 3; i++) {
        size_t size;
        char *data = read_whole(folder, BINARY[i], &size);
        for (int k = 0; k < 300; k++) {
            size_t at = rng_below(&rng, (uint32_t)size);
            char old = data[at];
            data[at] = (char)rng_below(&rng, 256);
            scene_write(folder, BINARY[i], data, size);
            if (dataset_open(folder, 1, &read))
                dataset_destroy(&read);
            else
                refused++;
            data[at] = old;
        }
        scene_write(folder, BINARY[i], data, size);
        mem_free(data);
    }
    assert_true(refused > 100);
    dataset_destroy(&made);
}

static void what_is_wrong_in_a_binary_model_is_named(void **state) {
    (void)state;
    const double nan_value = __builtin_nan("");
    const uint64_t many = 1ull << 60;
    const struct {
        int file;
        size_t at; // byte; a record begins at 8
        const void *bytes;
        size_t size;
        const char *reason;
    } cases[] = {
        {0, 0, &many, 8, "cannot hold them"},
        {1, 0, &many, 8, "cannot hold them"},
        {2, 0, &many, 8, "cannot hold them"},
        {0, 12, "\2\0\0\0", 4, "SIMPLE_RADIAL is not supported"},
        {0, 12, "\x63\0\0\0", 4, "unknown camera model 99"},
        {0, 16, "\0\0\0\0\0\0\0\0", 8, "0 x 9 px"},
        {0, 16, &many, 8, "px"},
        {0, 32, &nan_value, 8, "focal"},
        {1, 12, &nan_value, 8, "image 1 of 3"},
        {1, 44, &nan_value, 8, "translation"},
        {1, 68, "\x2a\0\0\0", 4, "camera 42"},
        {1, 72, "", 1, "image 1 of 3: the file ends"},
        {2, 16, &nan_value, 8, "point 1 of 3"},
        {2, 51, &many, 8, "point 1 of 3"},
    };
    const char *folder = scene_folder("bad binary");
    Dataset made = scene_make(folder, 3, 12, 9);
    assert_true(colmap_write(folder, &made));
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        size_t size;
        const char *name = BINARY[cases[i].file];
        char *good = read_whole(folder, name, &size), *bad = mem_alloc(size, 1);
        memcpy(bad, good, size);
        memcpy(bad + cases[i].at, cases[i].bytes, cases[i].size);
        scene_write(folder, name, bad, size);
        scene_refuses(folder, cases[i].reason, cases[i].reason, "bad binary");
        scene_write(folder, name, good, size);
        mem_free(good);
        mem_free(bad);
    }
    dataset_destroy(&made);
}

static void a_missing_or_broken_file_is_named(void **state) {
    (void)state;
    const char *folder = text_scene("missing");
    char *image = file_join(folder, "images/a.png"), *images = file_join(folder, "sparse/0/images.txt");
    scene_write(folder, "images/a.png", "text", 4);
    scene_refuses(folder, "text as image", image, "cannot read image");
    assert_int_equal(unlink(image), 0);
    scene_refuses(folder, "missing image", image, "no such file");
    assert_int_equal(unlink(images), 0);
    scene_refuses(folder, "missing list of images", images, "No such file");
    mem_free(images);
    mem_free(image);
}

// ---- real ones ----

static void the_bananas_are_read(void **state) {
    (void)state;
    Dataset read = scene_open(support_data("banana"), 1);
    assert_string_equal(read.kind, "COLMAP binary");
    assert_int_equal(read.view_count, 15);
    assert_int_equal(read.points.count, 7237);
    assert_int_equal(dataset_train_count(&read), 13);
    assert_true(dataset_find_view(&read, "DSC_0423.JPG")->held_out);
    assert_true(dataset_find_view(&read, "DSC_0431")->held_out);
    // The points of a good reconstruction fall into the pictures.
    long inside = 0;
    for (int i = 0; i < read.view_count; i++) {
        const Camera *camera = &read.views[i].camera;
        assert_int_equal(camera->width, 640);
        assert_int_equal(camera->height, 426);
        for (int k = 0; k < read.points.count; k++) {
            const double *p = read.points.xyz + 3 * k;
            double x, y, depth;
            if (camera_project(camera, vec3(p[0], p[1], p[2]), &x, &y, &depth))
                inside += x >= 0 && x < 640 && y >= 0 && y < 426;
        }
    }
    assert_true((double)inside > 0.5 * 15 * 7237);
    dataset_destroy(&read);
}

static void the_distorted_door_is_refused_with_advice(void **state) {
    (void)state;
    const char *folder = support_data("door");
    scene_refuses(folder, "door", "SIMPLE_RADIAL is not supported", "image_undistorter");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_binary_model_comes_back),
        cmocka_unit_test(a_text_model_is_read),
        cmocka_unit_test(the_model_may_stand_in_three_places),
        cmocka_unit_test(reduced_images_scale_the_intrinsics),
        cmocka_unit_test(a_model_without_points_is_read),
        cmocka_unit_test(what_is_wrong_in_a_text_model_is_named),
        cmocka_unit_test(every_cut_of_a_binary_model_is_noticed),
        cmocka_unit_test(random_damage_does_no_harm),
        cmocka_unit_test(what_is_wrong_in_a_binary_model_is_named),
        cmocka_unit_test(a_missing_or_broken_file_is_named),
        cmocka_unit_test(the_bananas_are_read),
        cmocka_unit_test(the_distorted_door_is_refused_with_advice),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
