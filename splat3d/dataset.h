// dataset.h - a scene to train on: photographs with their cameras, and the points to start from.
//
// Read from a COLMAP model (colmap.c) or a transforms.json (transforms.c). Views are sorted by name; every 8th is held
// out of training (Blender scenes bring their own test split).
#ifndef SPLATLAB_SPLAT3D_DATASET_H
#define SPLATLAB_SPLAT3D_DATASET_H

#include "lab/base/image.h"
#include "splat3d/camera.h"
#include "splat3d/points.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { HELD_OUT_EVERY = 8 }; // index mod 8 = 0 of the sorted names; a single view is trained on

typedef struct {
    char *name;     // as the scene names it: "DSC_0423.JPG", "train/r_0"
    char *path;     // of the image file
    Camera camera;  // of the picture after downscaling
    int channels;   // 3, or 4 with alpha
    bool as_stored; // EXIF orientation is not applied: the camera belongs to the pixels as they stand in the file
    bool held_out;  // for evaluation only
    Image8 image;   // empty until dataset_load_images()
} View;

typedef struct {
    char *path;       // the folder that was opened
    const char *kind; // "COLMAP binary", "COLMAP text", "Blender transforms.json", "nerfstudio transforms.json"
    int downscale;    // >= 1
    View *views;      // sorted by name: training and held-out together
    int view_count;
    Points points;          // none: count 0
    double init_half_width; // no points: random ones fill the cube of this half width round init_centre
    Vec3 init_centre;
    double extent; // 1.1 x the largest distance of a training camera's centre from their mean (1 if 0); world units
    Vec3 centre;   // mean of the training cameras' centres
} Dataset;

// Reads cameras and points and checks that every image is there and has the size its camera says (after a
// common factor: intrinsics are scaled to the image that stands on disk). Decodes no pixels. downscale >= 1.
bool dataset_open(const char *path, int downscale, Dataset *dataset);

// Decodes all images, in parallel, as 8-bit, downscaled; shows progress. Fails with the first broken image by name.
bool dataset_load_images(Dataset *dataset);

// One photograph as dataset_load_images() would hold it, read from its file; owned by the caller.
bool dataset_read_image(const Dataset *dataset, const View *view, Image8 *image);

void dataset_destroy(Dataset *dataset); // accepts a zeroed or half-built one

int dataset_train_count(const Dataset *dataset);
int dataset_held_out_count(const Dataset *dataset);
const View *dataset_find_view(const Dataset *dataset,
                              const char *name);    // exact, or without its ending; NULL if there is none
size_t dataset_image_bytes(const Dataset *dataset); // what dataset_load_images() holds

// A number that tells whether the scene is what it was: it follows from the views (names, cameras, sizes, which are held out), the
// points and downscaling. Pixels are not looked at.
uint64_t dataset_fingerprint(const Dataset *dataset);

// ---- the readers that dataset_open() chooses from ----
// Each fills everything but downscaling, images, extent and centre; *dataset is to be destroyed also after a failure.

bool colmap_is_scene(const char *path); // PATH/sparse/0, PATH/sparse or PATH itself holds cameras.bin or .txt
bool colmap_open(const char *path, Dataset *dataset); // photos in PATH/images, PATH/images_N or PATH

bool transforms_is_scene(const char *path);               // PATH holds transforms.json or transforms_train.json
bool transforms_open(const char *path, Dataset *dataset); // a Blender set has transforms_test.json (or _val) besides

// What both do at their end: order by name (fails for two of the same name); look at each image, fill in `channels` and scale the
// intrinsics to its size (fails when it is missing, broken or of another shape); mark every 8th view as held out.
bool dataset_sort_views(Dataset *dataset);
bool dataset_fit_images(Dataset *dataset);
void dataset_hold_out(Dataset *dataset);

// Writers, for sample scenes: sparse/0/{cameras,images,points3D}.bin. Each view's camera must be PINHOLE.
bool colmap_write(const char *folder, const Dataset *dataset);
bool transforms_write(const char *path, const Dataset *dataset); // nerfstudio style, OpenGL camera-to-world

#endif
