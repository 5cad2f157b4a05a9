// dataset.c - which reader a folder is for, and what all scenes have in common.
#include "splat3d/dataset.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/base/parallel.h"
#include "lab/base/progress.h"
#include "lab/io/file.h"
#include "lab/io/image_io.h"

#include <assert.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

static const double EXTENT_FACTOR = 1.1; // Kerbl et al. 2023 widen the cameras' radius by a tenth

// ---- what the readers do at their end ----

static int compare_views(const void *a, const void *b) {
    return strcmp(((const View *)a)->name, ((const View *)b)->name);
}

bool dataset_sort_views(Dataset *dataset) {
    if (dataset->view_count > 0) qsort(dataset->views, (size_t)dataset->view_count, sizeof(View), compare_views);
    for (int i = 1; i < dataset->view_count; i++)
        if (strcmp(dataset->views[i].name, dataset->views[i - 1].name) == 0)
            return fail("cannot read %s: two views have the name %s; remove one of them", dataset->path,
                        dataset->views[i].name);
    return true;
}

void dataset_hold_out(Dataset *dataset) {
    for (int i = 0; i < dataset->view_count; i++)
        dataset->views[i].held_out = dataset->view_count > 1 && i % HELD_OUT_EVERY == 0;
}

// Is there a scale s, 1 or another, with |width - s camera_width| < 1 and the same for the height? (Who made the picture
// smaller rounded somehow; one side of the full length means that nothing was made smaller.)
static bool same_shape(int width, int height, int camera_width, int camera_height) {
    if (width == camera_width || height == camera_height) return width == camera_width && height == camera_height;
    double low_x = (width - 1.0) / camera_width, high_x = (width + 1.0) / camera_width;
    double low_y = (height - 1.0) / camera_height, high_y = (height + 1.0) / camera_height;
    return low_x < high_y && low_y < high_x;
}

static bool fit_image(void *context, int index) {
    Dataset *dataset = context;
    View *view = &dataset->views[index];
    Camera *camera = &view->camera;
    int width, height;
    bool ok = view->as_stored ? image_probe_stored(view->path, &width, &height, &view->channels)
                              : image_probe(view->path, &width, &height, &view->channels);
    if (!ok) return fail_context("view %s", view->name);
    if (!same_shape(width, height, camera->width, camera->height)) {
        bool turned = same_shape(height, width, camera->width, camera->height);
        return fail("image %s has %d x %d px, but its camera in %s has %d x %d px, which is of another shape; %s",
                    view->path, width, height, dataset->path, camera->width, camera->height,
                    turned ? "was the picture turned afterwards?"
                           : "are these the pictures that the cameras belong to?");
    }
    *camera = camera_resized(camera, width, height);
    return true;
}

bool dataset_fit_images(Dataset *dataset) { return parallel_try(dataset->view_count, fit_image, dataset); }

// ---- opening ----

static bool fail_file(const char *path) {
    if (file_has_ending(path, ".ply"))
        return fail("cannot open %s as a scene: it is a PLY file, and the folder of a scene is wanted (photos with a "
                    "COLMAP model or transforms.json)",
                    path);
    char *folder = file_folder_of(path);
    fail("cannot open %s as a scene: it is a file, and a folder is wanted (photos with a COLMAP model or "
         "transforms.json); did you mean %s?",
         path, folder);
    mem_free(folder);
    return false;
}

static bool fail_unknown(const char *path) {
    char **names;
    int count;
    if (!file_list(path, &names, &count)) return fail_context("cannot open %s as a scene", path);
    file_list_free(names, count);
    return fail("cannot open %s as a scene: %s; looked for a COLMAP model (cameras.bin or .txt in "
                "sparse/0, sparse or the folder itself), transforms.json and transforms_train.json",
                path, count == 0 ? "the folder is empty" : "it holds no cameras");
}

static bool read_scene(const char *path, Dataset *dataset) {
    if (!file_exists(path)) return fail("cannot open %s as a scene: no such folder; is the path right?", path);
    if (!file_is_folder(path)) return fail_file(path);
    if (colmap_is_scene(path)) return colmap_open(path, dataset);
    if (transforms_is_scene(path)) return transforms_open(path, dataset);
    return fail_unknown(path);
}

static bool downscale(Dataset *dataset, int k) {
    dataset->downscale = k;
    for (int i = 0; i < dataset->view_count; i++) {
        Camera *camera = &dataset->views[i].camera;
        if (camera->width < k || camera->height < k)
            return fail("cannot downscale %s by %d: it has only %d x %d px; choose a smaller number",
                        dataset->views[i].path, k, camera->width, camera->height);
        *camera = camera_shrunk(camera, k);
    }
    return true;
}

static void measure_extent(Dataset *dataset) {
    int count = dataset_train_count(dataset);
    Vec3 sum = {0};
    for (int i = 0; i < dataset->view_count; i++)
        if (!dataset->views[i].held_out) sum = vec3_add(sum, camera_position(&dataset->views[i].camera));
    dataset->centre = vec3_scale(sum, 1.0 / count);
    double radius = 0;
    for (int i = 0; i < dataset->view_count; i++) {
        Vec3 offset = vec3_sub(camera_position(&dataset->views[i].camera), dataset->centre);
        if (!dataset->views[i].held_out) radius = fmax(radius, vec3_length(offset));
    }
    dataset->extent = radius > 0 ? EXTENT_FACTOR * radius : 1;
}

bool dataset_open(const char *path, int k, Dataset *dataset) {
    assert(k >= 1);
    *dataset = (Dataset){0};
    bool ok = read_scene(path, dataset) && downscale(dataset, k);
    if (ok && dataset_train_count(dataset) == 0)
        ok = fail("cannot train on %s: it has no views to train on (%d held out)", path, dataset->view_count);
    if (!ok) {
        dataset_destroy(dataset);
        return false;
    }
    measure_extent(dataset);
    if (dataset->points.count == 0 && dataset->init_half_width == 0) {
        dataset->init_centre = dataset->centre;
        dataset->init_half_width = dataset->extent;
    }
    return true;
}

void dataset_destroy(Dataset *dataset) {
    for (int i = 0; i < dataset->view_count; i++) {
        mem_free(dataset->views[i].name);
        mem_free(dataset->views[i].path);
        image8_destroy(&dataset->views[i].image);
    }
    mem_free(dataset->views);
    mem_free(dataset->path);
    points_destroy(&dataset->points);
    *dataset = (Dataset){0};
}

// ---- images ----

bool dataset_read_image(const Dataset *dataset, const View *view, Image8 *image) {
    bool ok = view->as_stored ? image_load8_stored(view->path, image) : image_load8(view->path, image);
    if (!ok) return fail_context("view %s", view->name);
    if (dataset->downscale > 1) {
        Image8 small = image8_downscale(image, dataset->downscale);
        image8_destroy(image);
        *image = small;
    }
    const Camera *camera = &view->camera;
    if (image->width == camera->width && image->height == camera->height && image->channels == view->channels)
        return true;
    fail("image %s changed since the scene was opened: it has %dx%d px and %d channels, the scene says %dx%d and %d; "
         "begin again",
         view->path, image->width, image->height, image->channels, camera->width, camera->height, view->channels);
    image8_destroy(image);
    return false;
}

typedef struct {
    Dataset *dataset;
    Progress progress;
    int done;
    pthread_mutex_t lock; // guards the two above
} Loading;

static bool load_image(void *context, int index) {
    Loading *loading = context;
    View *view = &loading->dataset->views[index];
    Image8 image;
    if (!dataset_read_image(loading->dataset, view, &image)) return false;
    image8_destroy(&view->image);
    view->image = image;

    pthread_mutex_lock(&loading->lock);
    progress_update(&loading->progress, ++loading->done, NULL);
    pthread_mutex_unlock(&loading->lock);
    return true;
}

bool dataset_load_images(Dataset *dataset) {
    Loading loading = {.dataset = dataset, .progress = progress_begin("load images", 0, dataset->view_count)};
    pthread_mutex_init(&loading.lock, NULL);
    bool ok = parallel_try(dataset->view_count, load_image, &loading);
    pthread_mutex_destroy(&loading.lock);
    progress_end(&loading.progress, NULL);
    return ok;
}

// ---- questions ----

int dataset_held_out_count(const Dataset *dataset) {
    int count = 0;
    for (int i = 0; i < dataset->view_count; i++) count += dataset->views[i].held_out;
    return count;
}

int dataset_train_count(const Dataset *dataset) { return dataset->view_count - dataset_held_out_count(dataset); }

// Length of a name without its ending: "a.b/c.png" -> 5, "a.b/c" -> 5.
static size_t stem_length(const char *name) {
    const char *slash = strrchr(name, '/'), *dot = strrchr(name, '.');
    return dot && (!slash || dot > slash) ? (size_t)(dot - name) : strlen(name);
}

const View *dataset_find_view(const Dataset *dataset, const char *name) {
    for (int i = 0; i < dataset->view_count; i++)
        if (strcmp(dataset->views[i].name, name) == 0) return &dataset->views[i];
    for (int i = 0; i < dataset->view_count; i++) {
        size_t stem = stem_length(dataset->views[i].name);
        if (strlen(name) == stem && strncmp(dataset->views[i].name, name, stem) == 0) return &dataset->views[i];
    }
    return NULL;
}

size_t dataset_image_bytes(const Dataset *dataset) {
    size_t bytes = 0;
    for (int i = 0; i < dataset->view_count; i++) {
        const View *view = &dataset->views[i];
        bytes += (size_t)view->camera.width * (size_t)view->camera.height * (size_t)view->channels;
    }
    return bytes;
}

// FNV-1a of 64 bits (Fowler, Noll and Vo 1991).
static uint64_t mix(uint64_t hash, const void *data, size_t bytes) {
    const unsigned char *byte = data;
    for (size_t i = 0; i < bytes; i++) hash = (hash ^ byte[i]) * 0x100000001b3u;
    return hash;
}

_Static_assert(sizeof(Camera) == 2 * sizeof(int) + 16 * sizeof(double), "a camera with gaps cannot be hashed as bytes");

uint64_t dataset_fingerprint(const Dataset *dataset) {
    uint64_t hash = 0xcbf29ce484222325u;
    for (int i = 0; i < dataset->view_count; i++) {
        const View *view = &dataset->views[i];
        hash = mix(hash, view->name, strlen(view->name) + 1);
        hash = mix(hash, &view->camera, sizeof view->camera);
        hash = mix(hash, &view->channels, sizeof view->channels);
        hash = mix(hash, &view->held_out, sizeof view->held_out);
    }
    size_t numbers = 3 * (size_t)dataset->points.count;
    hash = mix(hash, dataset->points.xyz, numbers * sizeof *dataset->points.xyz);
    return mix(hash, dataset->points.rgb, numbers * sizeof *dataset->points.rgb);
}
