// transforms.c - scenes described by transforms.json: Blender/NeRF-synthetic sets and nerfstudio's.
//
// Blender: camera_angle_x and frames with file_path (without ending) and transform_matrix, in transforms_train.json and
// transforms_test.json. nerfstudio: fl_x fl_y cx cy w h, for all frames or for each, and ply_file_path. Both: camera-to-world in
// OpenGL axes. (https://docs.nerf.studio/quickstart/data_conventions.html)
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "lab/io/image_io.h"
#include "lab/io/json_io.h"
#include "splat3d/dataset.h"
#include "splat3d/ply.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double BLENDER_HALF_WIDTH = 1.3; // world units: the synthetic objects stand within this cube round 0

// A frame and the file it stands in: numbers are looked for in the frame, then in the file's root.
typedef struct {
    const char *folder;
    const json_t *root, *frame;
    char where[1200]; // "PATH/transforms.json, frame 12"
} Frame;

static const json_t *holder(const Frame *f, const char *key) {
    if (json_has(f->frame, key)) return f->frame;
    return json_has(f->root, key) ? f->root : NULL;
}

// Leaves *value as it is where neither has the key.
static bool get_optional(const Frame *f, const char *key, double *value) {
    const json_t *object = holder(f, key);
    return !object || json_get_number(object, key, f->where, value);
}

// ---- what cannot be done yet ----

static bool check_undistorted(const Frame *f) {
    static const char *const coefficients[] = {"k1", "k2", "k3", "k4", "p1", "p2"};
    static const char *const models[] = {"PINHOLE",     "SIMPLE_PINHOLE", "OPENCV",
                                         "PERSPECTIVE", "SIMPLE_RADIAL",  "RADIAL"};
    for (size_t i = 0; i < sizeof coefficients / sizeof *coefficients; i++) {
        double value = 0;
        if (!get_optional(f, coefficients[i], &value)) return false;
        if (value != 0)
            return fail(
                "%s: the lens distorts (%s = %g), which is not supported; undistort the images first, as COLMAP's "
                "image_undistorter does",
                f->where, coefficients[i], value);
    }
    const json_t *object = holder(f, "camera_model");
    if (!object) return true;
    const char *model;
    if (!json_get_text(object, "camera_model", f->where, &model)) return false;
    for (size_t i = 0; i < sizeof models / sizeof *models; i++) // those with distortion are pinholes when it is zero
        if (strcmp(model, models[i]) == 0) return true;
    return fail("%s: camera model %s is not supported; undistort the images to PINHOLE first", f->where, model);
}

// ---- one frame ----

// The image file: as it is written, or with one of the usual endings. The path stays without when there is none.
static char *find_image(const char *folder, const char *name) {
    static const char *const endings[] = {"", ".png", ".jpg", ".jpeg"};
    char *path = file_join(folder, name);
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        char *with_ending = mem_format("%s%s", path, endings[i]);
        if (file_exists(with_ending) && !file_is_folder(with_ending)) {
            mem_free(path);
            return with_ending;
        }
        mem_free(with_ending);
    }
    return path;
}

// Both are given, or both are those of the image.
static bool read_size(const Frame *f, const View *view, double *width, double *height) {
    if (holder(f, "w") && holder(f, "h")) {
        if (!get_optional(f, "w", width) || !get_optional(f, "h", height)) return false;
    } else {
        int w, h, channels;
        if (!image_probe(view->path, &w, &h, &channels)) return fail_context("%s", f->where);
        *width = w;
        *height = h;
    }
    if (*width >= 1 && *width <= CAMERA_SIDE_MAX && *height >= 1 && *height <= CAMERA_SIDE_MAX &&
        *width == floor(*width) && *height == floor(*height))
        return true;
    return fail("%s: a picture of %g x %g px (\"w\", \"h\"), want whole numbers of 1 to %d", f->where, *width, *height,
                CAMERA_SIDE_MAX);
}

// From pixels (fl_x) or from the angle that the picture's side covers (camera_angle_x); 0 where neither is given.
static bool read_focal(const Frame *f, const char *key, const char *angle_key, double side_px, double *focal_px) {
    double angle_rad = 0;
    *focal_px = 0;
    if (holder(f, key)) return get_optional(f, key, focal_px);
    if (!holder(f, angle_key)) return true;
    if (!get_optional(f, angle_key, &angle_rad)) return false;
    if (!(angle_rad > 0 && angle_rad < acos(-1)))
        return fail("%s: \"%s\" is %g, want an angle between 0 and pi (radians)", f->where, angle_key, angle_rad);
    *focal_px = 0.5 * side_px / tan(0.5 * angle_rad);
    return true;
}

static bool read_camera(const Frame *f, View *view) {
    Camera *camera = &view->camera;
    double width, height, matrix[16];
    if (!check_undistorted(f) || !read_size(f, view, &width, &height)) return false;
    if (!read_focal(f, "fl_x", "camera_angle_x", width, &camera->fx) ||
        !read_focal(f, "fl_y", "camera_angle_y", height, &camera->fy))
        return false;
    if (!holder(f, "fl_x") && !holder(f, "camera_angle_x"))
        return fail("%s: neither \"fl_x\" nor \"camera_angle_x\" says the focal length; is it a file of Blender or "
                    "nerfstudio?",
                    f->where);
    if (!holder(f, "fl_y") && !holder(f, "camera_angle_y")) camera->fy = camera->fx;
    camera->width = (int)width;
    camera->height = (int)height;
    camera->cx = 0.5 * width;
    camera->cy = 0.5 * height;
    return get_optional(f, "cx", &camera->cx) && get_optional(f, "cy", &camera->cy) &&
           json_get_matrix4(f->frame, "transform_matrix", f->where, matrix) &&
           camera_pose_from_opengl(matrix, camera, f->where) && camera_check(camera, f->where);
}

static bool read_frame(const Frame *f, View *view) {
    const char *name;
    if (!json_get_text(f->frame, "file_path", f->where, &name)) return false;
    while (strncmp(name, "./", 2) == 0) name += 2;
    if (!*name) return fail("%s: \"file_path\" is empty", f->where);
    view->name = mem_text(name);
    view->path = find_image(f->folder, name);
    if (!file_exists(view->path) || file_is_folder(view->path))
        return fail("%s: there is no image %s, with or without the endings .png, .jpg, .jpeg; is it in its place?",
                    f->where, view->path);
    return read_camera(f, view);
}

// ---- one file ----

static bool read_frames(const char *path, const json_t *root, bool held_out, Dataset *dataset) {
    const json_t *frames = json_object_get(root, "frames");
    if (!json_is_array(frames))
        return fail("cannot read %s: it has no list \"frames\"; is it a transforms file?", path);
    size_t had = (size_t)dataset->view_count, count = json_array_size(frames);
    if (count == 0) return fail("cannot read %s: its list \"frames\" is empty", path);
    dataset->views = mem_resize(dataset->views, had, had + count, sizeof *dataset->views);
    for (size_t i = 0; i < count; i++) {
        Frame frame = {.folder = dataset->path, .root = root, .frame = json_array_get(frames, i)};
        snprintf(frame.where, sizeof frame.where, "%s, frame %zu of %zu", path, i + 1, count);
        View *view = &dataset->views[dataset->view_count++];
        view->held_out = held_out;
        if (!read_frame(&frame, view)) return false;
    }
    return true;
}

static bool read_points(const char *path, const json_t *root, Dataset *dataset) {
    const char *name;
    if (!json_has(root, "ply_file_path")) return true;
    if (!json_get_text(root, "ply_file_path", path, &name)) return false;
    char *ply = file_join(dataset->path, name);
    bool ok = ply_load_points(ply, &dataset->points) || fail_context("points of %s", path);
    mem_free(ply);
    return ok;
}

static bool read_file(Dataset *dataset, const char *name, bool held_out) {
    json_t *root;
    char *path = file_join(dataset->path, name);
    bool ok = json_read(path, &root);
    if (ok) {
        ok = read_frames(path, root, held_out, dataset) &&
             (dataset->points.count > 0 || read_points(path, root, dataset));
        json_decref(root);
    }
    mem_free(path);
    return ok;
}

// ---- the scene ----

static bool has_file(const char *folder, const char *name) {
    char *path = file_join(folder, name);
    bool found = file_exists(path);
    mem_free(path);
    return found;
}

bool transforms_is_scene(const char *path) {
    return has_file(path, "transforms.json") || has_file(path, "transforms_train.json");
}

static bool read_blender(Dataset *dataset) {
    static const char *const others[] = {"transforms_test.json", "transforms_val.json"};
    dataset->kind = "Blender transforms.json";
    dataset->init_half_width = BLENDER_HALF_WIDTH;
    if (!read_file(dataset, "transforms_train.json", false)) return false;
    for (int i = 0; i < 2; i++)
        if (has_file(dataset->path, others[i]))
            return read_file(dataset, others[i], true) && dataset_sort_views(dataset) && dataset_fit_images(dataset);
    if (!dataset_sort_views(dataset) || !dataset_fit_images(dataset)) return false;
    dataset_hold_out(dataset);
    return true;
}

static bool read_nerfstudio(Dataset *dataset) {
    dataset->kind = "nerfstudio transforms.json";
    if (!read_file(dataset, "transforms.json", false) || !dataset_sort_views(dataset) || !dataset_fit_images(dataset))
        return false;
    dataset_hold_out(dataset);
    return true;
}

bool transforms_open(const char *path, Dataset *dataset) {
    *dataset = (Dataset){.path = mem_text(path), .downscale = 1};
    if (has_file(path, "transforms.json")) return read_nerfstudio(dataset);
    if (has_file(path, "transforms_train.json")) return read_blender(dataset);
    return fail("cannot read %s: there is no transforms.json or transforms_train.json in it", path);
}
