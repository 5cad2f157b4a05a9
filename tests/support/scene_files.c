#include "tests/support/scene_files.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "lab/io/image_io.h"
#include "tests/support/support.h"

#include <math.h>
#include <string.h>

const char *scene_folder(const char *name) {
    static char folders[8][4096];
    static int next;
    char *folder = folders[next++ % 8];
    snprintf(folder, sizeof folders[0], "%s/%s", support_scratch(), name);
    assert_true(file_make_folder(folder));
    return folder;
}

void scene_write(const char *folder, const char *name, const void *data, size_t size) {
    char *path = file_join(folder, name), *parent = file_folder_of(path);
    assert_true(file_make_folder(parent));
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    fclose(file);
    mem_free(parent);
    mem_free(path);
}

void scene_write_text(const char *folder, const char *name, const char *text) {
    scene_write(folder, name, text, strlen(text));
}

void scene_write_image(const char *folder, const char *name, int width, int height, int channels) {
    char *path = file_join(folder, name), *parent = file_folder_of(path);
    assert_true(file_make_folder(parent));
    Image8 image = image8_create(width, height, channels);
    memset(image.bytes, 100, (size_t)width * (size_t)height * (size_t)channels);
    if (!image_save8(path, &image)) fail_msg("%s", fail_text());
    image8_destroy(&image);
    mem_free(parent);
    mem_free(path);
}

Dataset scene_make(const char *folder, int view_count, int width, int height) {
    Dataset dataset = {.path = mem_text(folder), .kind = "test", .downscale = 1, .view_count = view_count};
    dataset.views = mem_alloc((size_t)view_count, sizeof *dataset.views);
    for (int i = 0; i < view_count; i++) {
        View *view = &dataset.views[i];
        view->name = mem_format("v%02d.png", i);
        view->path = mem_format("%s/images/%s", folder, view->name);
        view->channels = 3;
        double angle = 0.3 * i;
        view->camera = camera_look_at(vec3(4 * cos(angle), -1, 4 * sin(angle)), vec3(0, 0.1 * i, 0), vec3(0, -1, 0), 1,
                                      width, height);
        view->camera.cx += 0.25;
        scene_write_image(folder, view->path, width, height, 3);
    }
    dataset.points = points_create(3);
    for (int i = 0; i < 9; i++) {
        dataset.points.xyz[i] = i / 7.0;
        dataset.points.rgb[i] = (uint8_t)(20 * i);
    }
    return dataset;
}

Dataset scene_open(const char *folder, int downscale) {
    Dataset dataset;
    if (!dataset_open(folder, downscale, &dataset)) fail_msg("%s", fail_text());
    return dataset;
}

void scene_refuses(const char *folder, const char *what, const char *first, const char *second) {
    Dataset dataset;
    if (dataset_open(folder, 1, &dataset)) fail_msg("%s: was opened", what);
    if (!strstr(fail_text(), first) || !strstr(fail_text(), second) || strchr(fail_text(), '\n'))
        fail_msg("%s: want \"%s\" and \"%s\" in: %s", what, first, second, fail_text());
    assert_null(dataset.views);
    assert_null(dataset.path);
    assert_null(dataset.points.xyz);
}
