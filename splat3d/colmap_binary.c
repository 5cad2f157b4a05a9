// colmap_binary.c - cameras.bin, images.bin, points3D.bin: little-endian, a count of 8 bytes, then the records.
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "splat3d/colmap_model.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

// The least bytes of a record: an image with a name of one letter and no 2-D points, a point with an empty track.
enum { CAMERA_BYTES = 24 + 3 * 8, IMAGE_BYTES = 4 + 7 * 8 + 4 + 2 + 8, POINT_BYTES = 8 + 3 * 8 + 3 + 8 + 8 };
enum { POINT2D_BYTES = 24, TRACK_BYTES = 8 };

// A file in memory and how far it was read. When it ends too early, reads give zeros and `cut` is set.
typedef struct {
    char *path, *data;
    size_t size, at;
    bool cut;
    char where[1200]; // "PATH, camera 1 of 2": for messages
} Reader;

static bool take(Reader *r, void *out, size_t bytes) {
    if (r->cut || r->size - r->at < bytes) {
        r->cut = true;
        memset(out, 0, bytes);
        return false;
    }
    memcpy(out, r->data + r->at, bytes);
    r->at += bytes;
    return true;
}

static uint64_t take_u64(Reader *r) {
    unsigned char b[8];
    take(r, b, 8);
    uint64_t value = 0;
    for (int i = 0; i < 8; i++) value |= (uint64_t)b[i] << (8 * i);
    return value;
}

static uint32_t take_u32(Reader *r) {
    unsigned char b[4];
    take(r, b, 4);
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

static double take_double(Reader *r) {
    uint64_t bits = take_u64(r);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static bool fail_cut(const Reader *r) {
    return fail("cannot read %s: the file ends there, after %zu bytes; is it complete?", r->where, r->size);
}

// Passes over count records of that size.
static void skip(Reader *r, uint64_t count, size_t bytes) {
    if (count > (r->size - r->at) / bytes)
        r->cut = true;
    else
        r->at += (size_t)count * bytes;
}

static bool open_reader(const char *folder, const char *name, Reader *r) {
    *r = (Reader){.path = file_join(folder, name)};
    return file_read(r->path, &r->data, &r->size);
}

static void close_reader(Reader *r) {
    mem_free(r->path);
    mem_free(r->data);
}

// The number of records, believed only if the file can hold them.
static bool take_count(Reader *r, const char *what, size_t record_bytes, int *count) {
    snprintf(r->where, sizeof r->where, "%s, number of %ss", r->path, what);
    uint64_t wanted = take_u64(r);
    if (r->cut) return fail_cut(r);
    if (wanted > INT_MAX || wanted > (r->size - r->at) / record_bytes)
        return fail(
            "cannot read %s: it says %llu %ss, but its %zu bytes cannot hold them; is it complete, and a COLMAP "
            "file?",
            r->path, (unsigned long long)wanted, what, r->size);
    *count = (int)wanted;
    return true;
}

static void set_where(Reader *r, const char *what, int index, int count) {
    snprintf(r->where, sizeof r->where, "%s, %s %d of %d", r->path, what, index + 1, count);
}

static bool check_end(const Reader *r) {
    if (r->at == r->size) return true;
    return fail("cannot read %s: %zu bytes are left after the last record; is the file damaged?", r->path,
                r->size - r->at);
}

static bool read_camera(Reader *r, ColmapModel *model) {
    uint32_t id = take_u32(r);
    int kind = (int)take_u32(r), parameter_count;
    double width = (double)take_u64(r), height = (double)take_u64(r);
    if (r->cut) return fail_cut(r);
    if (!colmap_parameter_count(kind, r->where, &parameter_count)) return false;
    double parameters[COLMAP_PARAMETERS_MAX];
    for (int k = 0; k < parameter_count; k++) parameters[k] = take_double(r);
    if (r->cut) return fail_cut(r);
    return colmap_model_add_camera(model, id, kind, width, height, parameters, r->where);
}

static bool read_image(Reader *r, ColmapModel *model) {
    ColmapImage image;
    take_u32(r); // its number; views are known by name
    for (int k = 0; k < 4; k++) image.quaternion[k] = take_double(r);
    for (int k = 0; k < 3; k++) image.translation[k] = take_double(r);
    image.camera_id = take_u32(r);
    image.name = r->data + r->at;
    size_t length = strnlen(image.name, r->size - r->at);
    if (r->at + length == r->size) r->cut = true; // no zero byte ends the name
    if (r->cut) return fail_cut(r);
    r->at += length + 1;
    skip(r, take_u64(r), POINT2D_BYTES);
    if (r->cut) return fail_cut(r);
    return colmap_model_add_image(model, &image, r->where);
}

static bool read_point(Reader *r, int index, ColmapModel *model) {
    double xyz[3];
    int rgb[3];
    take_u64(r); // its number
    for (int k = 0; k < 3; k++) xyz[k] = take_double(r);
    for (int k = 0; k < 3; k++) {
        unsigned char byte;
        take(r, &byte, 1);
        rgb[k] = byte;
    }
    take_double(r); // reprojection error
    skip(r, take_u64(r), TRACK_BYTES);
    if (r->cut) return fail_cut(r);
    return colmap_model_set_point(model, index, xyz, rgb, r->where);
}

static bool read_cameras(Reader *r, ColmapModel *model) {
    int count;
    if (!take_count(r, "camera", CAMERA_BYTES, &count)) return false;
    for (int i = 0; i < count; i++) {
        set_where(r, "camera", i, count);
        if (!read_camera(r, model)) return false;
    }
    return check_end(r);
}

static bool read_images(Reader *r, ColmapModel *model) {
    int count;
    if (!take_count(r, "image", IMAGE_BYTES, &count)) return false;
    for (int i = 0; i < count; i++) {
        set_where(r, "image", i, count);
        if (!read_image(r, model)) return false;
    }
    return check_end(r);
}

static bool read_points(Reader *r, ColmapModel *model) {
    int count;
    if (!take_count(r, "point", POINT_BYTES, &count)) return false;
    model->points = points_create(count);
    for (int i = 0; i < count; i++) {
        set_where(r, "point", i, count);
        if (!read_point(r, i, model)) return false;
    }
    return check_end(r);
}

static bool read_file(const char *folder, const char *name, bool (*read)(Reader *, ColmapModel *), ColmapModel *model) {
    Reader r;
    bool ok = open_reader(folder, name, &r) && read(&r, model);
    close_reader(&r);
    return ok;
}

bool colmap_binary_read(const char *folder, bool has_points, ColmapModel *model) {
    return read_file(folder, "cameras.bin", read_cameras, model) &&
           read_file(folder, "images.bin", read_images, model) &&
           (!has_points || read_file(folder, "points3D.bin", read_points, model));
}
