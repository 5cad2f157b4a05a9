// test_dataset.c - what all scenes have in common: the choice of reader, the split, sizes, images, extent.
#include "lab/base/fail.h"
#include "lab/base/log.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "lab/io/image_io.h"
#include "tests/support/scene_files.h"
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *colmap_scene(const char *name, int views, int width, int height) {
    const char *folder = scene_folder(name);
    Dataset made = scene_make(folder, views, width, height);
    assert_true(colmap_write(folder, &made));
    dataset_destroy(&made);
    return folder;
}

static void what_is_no_scene_is_said_to_be_none(void **state) {
    (void)state;
    const char *folder = scene_folder("none");
    scene_refuses("no/such/folder", "no folder", "no/such/folder", "no such folder");
    scene_refuses(folder, "empty folder", "the folder is empty", "transforms_train.json");
    scene_write_text(folder, "notes.txt", "hello");
    scene_refuses(folder, "folder without cameras", "it holds no cameras", "sparse/0");
    char *file = file_join(folder, "notes.txt");
    scene_refuses(file, "text file", "a folder is wanted", folder);
    mem_free(file);
    scene_write_text(folder, "model.ply", "ply\n");
    file = file_join(folder, "model.ply");
    scene_refuses(file, "PLY file", "it is a PLY file", "the folder of a scene is wanted");
    mem_free(file);
}

static void every_8th_of_the_sorted_names_is_held_out(void **state) {
    (void)state;
    Dataset read = scene_open(colmap_scene("split", 18, 4, 4), 1);
    for (int i = 0; i < 18; i++) assert_int_equal(read.views[i].held_out, i == 0 || i == 8 || i == 16);
    assert_int_equal(dataset_held_out_count(&read), 3);
    assert_int_equal(dataset_train_count(&read), 15);
    dataset_destroy(&read);
    read = scene_open(colmap_scene("single", 1, 4, 4), 1);
    assert_int_equal(dataset_train_count(&read), 1);
    assert_true(read.extent == 1);
    dataset_destroy(&read);
}

static void the_extent_is_that_of_the_training_cameras(void **state) {
    (void)state;
    const char *folder = scene_folder("extent");
    Dataset made = scene_make(folder, 9, 4, 4);
    for (int i = 0; i < 9; i++) { // held out: 0 and 8, far away; the others from -3 to 3 on x
        double x = i % 8 == 0 ? 1000 : i - 4;
        made.views[i].camera = camera_look_at(vec3(x, 2, 0), vec3(x, 2, 5), vec3(0, -1, 0), 1, 4, 4);
    }
    assert_true(colmap_write(folder, &made));
    Dataset read = scene_open(folder, 1);
    support_near(read.centre.x, 0, 1e-9, "centre x");
    support_near(read.centre.y, 2, 1e-9, "centre y");
    support_near(read.extent, 3.3, 1e-9, "extent");
    dataset_destroy(&read);
    dataset_destroy(&made);
}

// 13 x 9 at a third: 4 x 3 blocks of 3 x 3 pixels, the last column is cut off. All lengths shrink by exactly 3.
static void downscaling_keeps_rays_and_pixels_together(void **state) {
    (void)state;
    const char *folder = colmap_scene("downscale", 3, 13, 9);
    Dataset full = scene_open(folder, 1), small = scene_open(folder, 3);
    assert_int_equal(small.downscale, 3);
    for (int i = 0; i < 3; i++) {
        const Camera *a = &full.views[i].camera, *b = &small.views[i].camera;
        assert_int_equal(b->width, 4);
        assert_int_equal(b->height, 3);
        Vec3 ray = camera_ray(a, 6, 3), same = camera_ray(b, 2, 1);
        support_near(vec3_length(vec3_sub(ray, same)), 0, 1e-14, "direction");
    }
    log_set_quiet(true);
    assert_true(dataset_load_images(&small));
    for (int i = 0; i < 3; i++) {
        assert_int_equal(small.views[i].image.width, 4);
        assert_int_equal(small.views[i].image.height, 3);
        assert_int_equal(small.views[i].image.bytes[0], 100);
    }
    assert_int_equal(dataset_image_bytes(&small), 3 * 4 * 3 * 3);
    dataset_destroy(&small);
    dataset_destroy(&full);
    small = scene_open(folder, 9);
    assert_int_equal(small.views[0].camera.width, 1);
    dataset_destroy(&small);
    Dataset none;
    assert_false(dataset_open(folder, 10, &none));
    assert_non_null(strstr(fail_text(), "13 x 9 px"));
}

static void images_are_the_same_with_one_thread_or_many(void **state) {
    (void)state;
    const char *folder = colmap_scene("threads", 5, 16, 16);
    for (int i = 0; i < 5; i++) {
        Image8 image = image8_create(16, 16, 3);
        for (int k = 0; k < 16 * 16 * 3; k++) image.bytes[k] = (uint8_t)(k * (i + 3));
        char *path = mem_format("%s/images/v%02d.png", folder, i);
        assert_true(image_save8(path, &image));
        mem_free(path);
        image8_destroy(&image);
    }
    log_set_quiet(true);
    Dataset read[2];
    for (int k = 0; k < 2; k++) {
        setenv("SPLATLAB_THREADS", k ? "4" : "1", 1);
        read[k] = scene_open(folder, 2);
        if (!dataset_load_images(&read[k])) fail_msg("%s", fail_text());
    }
    unsetenv("SPLATLAB_THREADS");
    for (int i = 0; i < 5; i++) {
        assert_memory_equal(read[0].views[i].image.bytes, read[1].views[i].image.bytes, 8 * 8 * 3);
        assert_memory_equal(&read[0].views[i].camera, &read[1].views[i].camera, sizeof(Camera));
    }
    for (int k = 0; k < 2; k++) dataset_destroy(&read[k]);
}

static void the_first_broken_image_is_named(void **state) {
    (void)state;
    const char *folder = colmap_scene("broken", 9, 16, 16);
    Dataset read = scene_open(folder, 1);
    scene_write_text(folder, "images/v05.png", "text");
    scene_write_text(folder, "images/v03.png", "text");
    log_set_quiet(true);
    assert_false(dataset_load_images(&read));
    assert_non_null(strstr(fail_text(), "images/v03.png"));
    scene_write_image(folder, "images/v03.png", 17, 16, 3);
    assert_false(dataset_load_images(&read));
    assert_non_null(strstr(fail_text(), "v03.png changed since"));
    dataset_destroy(&read);
    scene_write_image(folder, "images/v05.png", 16, 16, 3);
    scene_refuses(folder, "other shape", "v03.png has 17 x 16 px", "another shape");
}

static void views_are_found_with_and_without_ending(void **state) {
    (void)state;
    Dataset read = scene_open(colmap_scene("find", 3, 4, 4), 1);
    assert_ptr_equal(dataset_find_view(&read, "v01.png"), &read.views[1]);
    assert_ptr_equal(dataset_find_view(&read, "v01"), &read.views[1]);
    assert_null(dataset_find_view(&read, "v01.jpg"));
    assert_null(dataset_find_view(&read, "v0"));
    assert_null(dataset_find_view(&read, ""));
    dataset_destroy(&read);
    dataset_destroy(&read);
}

static void the_fingerprint_tells_a_changed_scene(void **state) {
    (void)state;
    const char *folder = colmap_scene("fingerprint", 3, 8, 8);
    Dataset a = scene_open(folder, 1), b = scene_open(folder, 1), half = scene_open(folder, 2);
    uint64_t before = dataset_fingerprint(&a);
    assert_true(dataset_fingerprint(&b) == before);
    assert_true(dataset_fingerprint(&half) != before);
    b.views[2].camera.translation.z += 1e-9;
    assert_true(dataset_fingerprint(&b) != before);
    a.points.rgb[4] ^= 1;
    assert_true(dataset_fingerprint(&a) != before);
    dataset_destroy(&a);
    dataset_destroy(&b);
    dataset_destroy(&half);
}

// COLMAP measures the pixels as they stand in the file; the orientation that a camera noted is nothing to it.
static void exif_orientation_does_not_turn_the_pictures_of_colmap(void **state) {
    (void)state;
    const char *folder = colmap_scene("orientation", 2, 6, 4);
    char *command = mem_format("command -v oiiotool > /dev/null && cd '%s/images' && "
                               "oiiotool --pattern constant:color=1,0,0 6x4 3 -d uint8 --orientation 6 -o v00.jpg && "
                               "mv v00.jpg v00.png",
                               folder);
    bool made = system(command) == 0;
    mem_free(command);
    if (!made) {
        print_message("skipped: no oiiotool (Debian: openimageio-tools)\n");
        skip();
    }
    Dataset read = scene_open(folder, 1);
    log_set_quiet(true);
    assert_true(dataset_load_images(&read));
    assert_int_equal(read.views[0].image.width, 6);
    dataset_destroy(&read);
}

static void real_photographs_are_loaded_downscaled(void **state) {
    (void)state;
    Dataset read = scene_open(support_data("banana"), 4);
    assert_int_equal(read.views[0].camera.width, 160);
    assert_int_equal(read.views[0].camera.height, 106);
    log_set_quiet(true);
    if (!dataset_load_images(&read)) fail_msg("%s", fail_text());
    assert_int_equal(read.views[14].image.height, 106);
    dataset_destroy(&read);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_no_scene_is_said_to_be_none),
        cmocka_unit_test(every_8th_of_the_sorted_names_is_held_out),
        cmocka_unit_test(the_extent_is_that_of_the_training_cameras),
        cmocka_unit_test(downscaling_keeps_rays_and_pixels_together),
        cmocka_unit_test(images_are_the_same_with_one_thread_or_many),
        cmocka_unit_test(the_first_broken_image_is_named),
        cmocka_unit_test(views_are_found_with_and_without_ending),
        cmocka_unit_test(the_fingerprint_tells_a_changed_scene),
        cmocka_unit_test(exif_orientation_does_not_turn_the_pictures_of_colmap),
        cmocka_unit_test(real_photographs_are_loaded_downscaled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
