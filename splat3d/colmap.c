// colmap.c - from the folder of a COLMAP model to views.
#include "lab/base/fail.h"
#include "lab/base/log.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "splat3d/colmap_model.h"
#include "splat3d/dataset.h"

#include <stdlib.h>
#include <string.h>

// ---- where the model is ----

static const char *const MODEL_FOLDERS[] = {"sparse/0", "sparse", NULL}; // NULL: the scene's folder itself

static bool has_file(const char *folder, const char *stem, const char *ending) {
    char *name = mem_format("%s%s", stem, ending);
    char *path = file_join(folder, name);
    bool found = file_exists(path);
    mem_free(path);
    mem_free(name);
    return found;
}

// The folder with the model's cameras and the ending of its files (".bin" before ".txt"); NULL when there is none.
static char *find_model(const char *path, const char **ending) {
    static const char *const endings[] = {".bin", ".txt"};
    for (size_t i = 0; i < sizeof MODEL_FOLDERS / sizeof *MODEL_FOLDERS; i++) {
        char *folder = MODEL_FOLDERS[i] ? file_join(path, MODEL_FOLDERS[i]) : mem_text(path);
        for (int k = 0; k < 2; k++)
            if (has_file(folder, "cameras", endings[k])) {
                *ending = endings[k];
                return folder;
            }
        mem_free(folder);
    }
    return NULL;
}

bool colmap_is_scene(const char *path) {
    const char *ending;
    char *folder = find_model(path, &ending);
    mem_free(folder);
    return folder != NULL;
}

static bool read_model(const char *folder, const char *ending, ColmapModel *model) {
    bool has_points = has_file(folder, "points3D", ending);
    if (!has_points) log_warn("there is no %s/points3D%s: training starts from random points", folder, ending);
    return strcmp(ending, ".bin") == 0 ? colmap_binary_read(folder, has_points, model)
                                       : colmap_text_read(folder, has_points, model);
}

// ---- where the images are ----

static bool has_image(const char *folder, const char *name) {
    char *path = file_join(folder, name);
    bool found = file_exists(path);
    mem_free(path);
    return found;
}

// "images_4" of folder `root` and the like, the largest pictures first: the lowest number. NULL when none has the image.
static char *find_reduced_images(const char *root, const char *name) {
    char **entries, *found = NULL;
    int count;
    long lowest = 0;
    if (!file_list(root, &entries, &count)) return NULL;
    for (int i = 0; i < count; i++) {
        if (strncmp(entries[i], "images_", 7) != 0) continue;
        char *end, *folder = file_join(root, entries[i]);
        long number = strtol(entries[i] + 7, &end, 10);
        if (*end == 0 && number > 0 && (!found || number < lowest) && has_image(folder, name)) {
            mem_free(found);
            found = folder;
            lowest = number;
        } else {
            mem_free(folder);
        }
    }
    file_list_free(entries, count);
    return found;
}

// The folder that holds the image of that name: images, images_N or the scene's folder itself. The scene is `path`, or one or
// two folders up where `path` is the model's own folder (sparse, sparse/0).
static char *find_images(const char *path, const char *name) {
    static const char *const roots[] = {NULL, "..", "../.."};
    for (size_t i = 0; i < sizeof roots / sizeof *roots; i++) {
        char *root = roots[i] ? file_join(path, roots[i]) : mem_text(path);
        char *images = file_join(root, "images");
        char *found = has_image(images, name) ? mem_text(images) : find_reduced_images(root, name);
        if (!found && has_image(root, name)) found = mem_text(root);
        mem_free(images);
        mem_free(root);
        if (found) return found;
    }
    return NULL;
}

// ---- views ----

static int compare_cameras(const void *a, const void *b) {
    uint32_t first = ((const ColmapCamera *)a)->id, second = ((const ColmapCamera *)b)->id;
    return (first > second) - (first < second);
}

static bool sort_cameras(ColmapModel *model, const char *folder) {
    if (model->camera_count > 0)
        qsort(model->cameras, (size_t)model->camera_count, sizeof *model->cameras, compare_cameras);
    for (int i = 1; i < model->camera_count; i++)
        if (model->cameras[i].id == model->cameras[i - 1].id)
            return fail("cannot read %s: two cameras have the number %u; is the model damaged?", folder,
                        model->cameras[i].id);
    return true;
}

static bool make_view(const ColmapModel *model, const ColmapImage *image, const char *folder, const char *images,
                      View *view) {
    ColmapCamera key = {.id = image->camera_id};
    const ColmapCamera *camera = model->camera_count == 0 ? NULL
                                                          : bsearch(&key, model->cameras, (size_t)model->camera_count,
                                                                    sizeof *model->cameras, compare_cameras);
    if (!camera)
        return fail("cannot read %s: image %s has camera %u, which is not among the %d cameras of the model", folder,
                    image->name, image->camera_id, model->camera_count);
    *view = (View){.name = mem_text(image->name), .path = file_join(images, image->name), .camera = camera->intrinsics};
    view->as_stored = true; // COLMAP passes over EXIF orientation
    view->camera.rotation = camera_rotation_from_quaternion(image->quaternion);
    view->camera.translation = vec3(image->translation[0], image->translation[1], image->translation[2]);
    return true;
}

static bool make_views(ColmapModel *model, const char *folder, Dataset *dataset) {
    if (model->image_count == 0)
        return fail("cannot train on %s: the model has no images; did COLMAP's mapper register any?", folder);
    if (!sort_cameras(model, folder)) return false;
    const char *first = model->images[0].name;
    char *images = find_images(dataset->path, first);
    if (!images)
        return fail("cannot find image %s of %s: looked in %s/images, %s/images_N and %s; put the photos there", first,
                    folder, dataset->path, dataset->path, dataset->path);
    dataset->views = mem_alloc((size_t)model->image_count, sizeof *dataset->views);
    bool ok = true;
    for (; ok && dataset->view_count < model->image_count; dataset->view_count++)
        ok =
            make_view(model, &model->images[dataset->view_count], folder, images, &dataset->views[dataset->view_count]);
    mem_free(images);
    return ok;
}

bool colmap_open(const char *path, Dataset *dataset) {
    const char *ending;
    *dataset = (Dataset){.path = mem_text(path), .downscale = 1};
    char *folder = find_model(path, &ending);
    if (!folder)
        return fail("cannot read %s: no COLMAP model (cameras.bin or .txt) in its folders sparse/0 and "
                    "sparse, nor in itself",
                    path);
    dataset->kind = strcmp(ending, ".bin") == 0 ? "COLMAP binary" : "COLMAP text";
    ColmapModel model = {0};
    bool ok = read_model(folder, ending, &model) && make_views(&model, folder, dataset);
    if (ok) {
        dataset->points = model.points;
        model.points = (Points){0};
    }
    colmap_model_destroy(&model);
    mem_free(folder);
    return ok && dataset_sort_views(dataset) && dataset_fit_images(dataset) && (dataset_hold_out(dataset), true);
}
