// colmap_model.c - what a camera, an image or a point must be, in whichever form it was written.
#include "splat3d/colmap_model.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"

#include <math.h>
#include <string.h>

// COLMAP's camera models by number; only the first two are without distortion.
static const char *const MODELS[] = {
    "SIMPLE_PINHOLE",
    "PINHOLE",
    "SIMPLE_RADIAL",
    "RADIAL",
    "OPENCV",
    "OPENCV_FISHEYE",
    "FULL_OPENCV",
    "FOV",
    "SIMPLE_RADIAL_FISHEYE",
    "RADIAL_FISHEYE",
    "THIN_PRISM_FISHEYE",
    "RAD_TAN_THIN_PRISM_FISHEYE",
};
enum { SIMPLE_PINHOLE, PINHOLE, MODEL_COUNT = sizeof MODELS / sizeof *MODELS };

void colmap_model_destroy(ColmapModel *model) {
    for (int i = 0; i < model->image_count; i++) mem_free(model->images[i].name);
    mem_free(model->images);
    mem_free(model->cameras);
    points_destroy(&model->points);
    *model = (ColmapModel){0};
}

bool colmap_model_number(const char *name, const char *where, int *model) {
    for (int i = 0; i < MODEL_COUNT; i++)
        if (strcmp(name, MODELS[i]) == 0) {
            *model = i;
            return true;
        }
    return fail("%s: unknown camera model \"%s\"; is this a COLMAP file?", where, name);
}

bool colmap_parameter_count(int model, const char *where, int *count) {
    if (model < 0 || model >= MODEL_COUNT)
        return fail("%s: unknown camera model %d; is the file damaged?", where, model);
    if (model != SIMPLE_PINHOLE && model != PINHOLE)
        return fail("%s: camera model %s is not supported, because it distorts; COLMAP's image_undistorter makes a "
                    "PINHOLE model and its images",
                    where, MODELS[model]);
    *count = model == PINHOLE ? 4 : 3;
    return true;
}

// Room for one more; the capacity is the next power of two, so that n additions cost n copies.
static void *grown(void *array, int count, size_t size) {
    if (count > 0 && (count & (count - 1)) != 0) return array;
    return mem_resize(array, (size_t)count, count ? 2 * (size_t)count : 1, size);
}

bool colmap_model_add_camera(ColmapModel *model, uint32_t id, int kind, double width, double height, const double *p,
                             const char *where) {
    if (!(width >= 1 && width <= CAMERA_SIDE_MAX && height >= 1 && height <= CAMERA_SIDE_MAX))
        return fail("%s: a picture of %g x %g px, want sides of 1 to %d; is the file damaged?", where, width, height,
                    CAMERA_SIDE_MAX);
    bool simple = kind == SIMPLE_PINHOLE;
    Camera camera = {.width = (int)width, .height = (int)height, .fx = p[0], .fy = simple ? p[0] : p[1]};
    camera.cx = p[simple ? 1 : 2];
    camera.cy = p[simple ? 2 : 3];
    camera.rotation = (Mat3){{1, 0, 0, 0, 1, 0, 0, 0, 1}};
    if (!camera_check(&camera, where)) return false;
    model->cameras = grown(model->cameras, model->camera_count, sizeof *model->cameras);
    model->cameras[model->camera_count++] = (ColmapCamera){id, camera};
    return true;
}

bool colmap_model_add_image(ColmapModel *model, const ColmapImage *image, const char *where) {
    double length = 0;
    for (int i = 0; i < 4; i++) length += image->quaternion[i] * image->quaternion[i];
    if (!(length > 0 && isfinite(length)))
        return fail("%s: the quaternion %g %g %g %g is no rotation; is the file damaged?", where, image->quaternion[0],
                    image->quaternion[1], image->quaternion[2], image->quaternion[3]);
    for (int i = 0; i < 3; i++)
        if (!isfinite(image->translation[i])) return fail("%s: the translation is not finite", where);
    if (!image->name[0]) return fail("%s: the image has no name; is the file damaged?", where);
    model->images = grown(model->images, model->image_count, sizeof *model->images);
    ColmapImage *added = &model->images[model->image_count++];
    *added = *image;
    added->name = mem_text(image->name);
    return true;
}

bool colmap_model_set_point(ColmapModel *model, int index, const double xyz[3], const int rgb[3], const char *where) {
    for (int k = 0; k < 3; k++) {
        size_t at = 3 * (size_t)index + (size_t)k;
        if (!isfinite((float)xyz[k])) // splats are floats
            return fail("%s: position (%g, %g, %g) is not finite; is the file damaged?", where, xyz[0], xyz[1], xyz[2]);
        if (rgb[k] < 0 || rgb[k] > 255)
            return fail("%s: colour %d %d %d, want 0 to 255", where, rgb[0], rgb[1], rgb[2]);
        model->points.xyz[at] = xyz[k];
        model->points.rgb[at] = (uint8_t)rgb[k];
    }
    return true;
}
