// colmap_write.c - a COLMAP model in its binary form, for programs of others; without 2-D points and tracks.
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "splat3d/dataset.h"

#include <string.h>

enum { PINHOLE = 1 }; // COLMAP's number of the model fx fy cx cy

static void put_bytes(FILE *stream, uint64_t value, int bytes) {
    for (int i = 0; i < bytes; i++) fputc((int)(value >> (8 * i) & 255), stream);
}

static void put_double(FILE *stream, double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    put_bytes(stream, bits, 8);
}

static bool same_intrinsics(const Camera *a, const Camera *b) {
    return a->width == b->width && a->height == b->height && a->fx == b->fx && a->fy == b->fy && a->cx == b->cx &&
           a->cy == b->cy;
}

// The first view with the same intrinsics: its index + 1 is the number of the camera in the file.
static int camera_of(const Dataset *dataset, int view) {
    int first = 0;
    while (!same_intrinsics(&dataset->views[first].camera, &dataset->views[view].camera)) first++;
    return first;
}

static void write_cameras(FILE *stream, const Dataset *dataset) {
    uint64_t count = 0;
    for (int i = 0; i < dataset->view_count; i++) count += camera_of(dataset, i) == i;
    put_bytes(stream, count, 8);
    for (int i = 0; i < dataset->view_count; i++) {
        const Camera *camera = &dataset->views[i].camera;
        if (camera_of(dataset, i) != i) continue;
        put_bytes(stream, (uint64_t)i + 1, 4);
        put_bytes(stream, PINHOLE, 4);
        put_bytes(stream, (uint64_t)camera->width, 8);
        put_bytes(stream, (uint64_t)camera->height, 8);
        put_double(stream, camera->fx);
        put_double(stream, camera->fy);
        put_double(stream, camera->cx);
        put_double(stream, camera->cy);
    }
}

static void write_images(FILE *stream, const Dataset *dataset) {
    put_bytes(stream, (uint64_t)dataset->view_count, 8);
    for (int i = 0; i < dataset->view_count; i++) {
        const View *view = &dataset->views[i];
        double quaternion[4];
        camera_quaternion_from_rotation(&view->camera.rotation, quaternion);
        put_bytes(stream, (uint64_t)i + 1, 4);
        for (int k = 0; k < 4; k++) put_double(stream, quaternion[k]);
        put_double(stream, view->camera.translation.x);
        put_double(stream, view->camera.translation.y);
        put_double(stream, view->camera.translation.z);
        put_bytes(stream, (uint64_t)camera_of(dataset, i) + 1, 4);
        fwrite(view->name, 1, strlen(view->name) + 1, stream);
        put_bytes(stream, 0, 8); // 2-D points
    }
}

static void write_points(FILE *stream, const Dataset *dataset) {
    const Points *points = &dataset->points;
    put_bytes(stream, (uint64_t)points->count, 8);
    for (size_t i = 0; i < (size_t)points->count; i++) {
        put_bytes(stream, i + 1, 8);
        for (size_t k = 0; k < 3; k++) put_double(stream, points->xyz[3 * i + k]);
        for (size_t k = 0; k < 3; k++) put_bytes(stream, points->rgb[3 * i + k], 1);
        put_double(stream, 0);   // reprojection error: not known
        put_bytes(stream, 0, 8); // track
    }
}

static bool write_file(const char *folder, const char *name, void (*write)(FILE *, const Dataset *),
                       const Dataset *dataset) {
    FileWriter writer;
    char *path = file_join(folder, name);
    bool ok = file_begin(&writer, path);
    mem_free(path);
    if (!ok) return false;
    write(writer.stream, dataset);
    return file_commit(&writer);
}

bool colmap_write(const char *folder, const Dataset *dataset) {
    char *model = file_join(folder, "sparse/0");
    bool ok = file_make_folder(model) && write_file(model, "cameras.bin", write_cameras, dataset) &&
              write_file(model, "images.bin", write_images, dataset) &&
              write_file(model, "points3D.bin", write_points, dataset);
    mem_free(model);
    return ok;
}
