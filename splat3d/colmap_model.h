// colmap_model.h - a COLMAP model in memory, as its three files say it: cameras, images, points.
//
// Format: COLMAP documentation, "Output Format" (https://colmap.github.io/format.html). The axes and the pixel centre (0.5, 0.5) are ours.
#ifndef SPLATLAB_SPLAT3D_COLMAP_MODEL_H
#define SPLATLAB_SPLAT3D_COLMAP_MODEL_H

#include "splat3d/camera.h"
#include "splat3d/points.h"

#include <stddef.h>
#include <stdint.h>

typedef struct {
    uint32_t id;
    Camera intrinsics; // without a pose
} ColmapCamera;

typedef struct {
    char *name; // as the model says it: "DSC_0423.JPG", "left/0001.png"
    uint32_t camera_id;
    double quaternion[4];  // w x y z, world to camera
    double translation[3]; // world to camera
} ColmapImage;

typedef struct {
    ColmapCamera *cameras;
    int camera_count;
    ColmapImage *images;
    int image_count;
    Points points;
} ColmapModel;

void colmap_model_destroy(ColmapModel *model); // accepts a zeroed or half-built one

// The two forms of the files; *model holds what was read, also after a failure. has_points: is there a file points3D?
bool colmap_binary_read(const char *folder, bool has_points, ColmapModel *model);
bool colmap_text_read(const char *folder, bool has_points, ColmapModel *model);

// ---- for these two ----

enum { COLMAP_PARAMETERS_MAX = 16 };

// How many parameters a camera model has, by its number or name. Fails for models other than PINHOLE and SIMPLE_PINHOLE.
bool colmap_parameter_count(int model, const char *where, int *count);
bool colmap_model_number(const char *name, const char *where, int *model);

// Adds after checking; `where` names file and place. colmap_model_add_image takes its own copy of the name.
bool colmap_model_add_camera(ColmapModel *model, uint32_t id, int kind, double width, double height,
                             const double *parameters, const char *where);
bool colmap_model_add_image(ColmapModel *model, const ColmapImage *image, const char *where);
bool colmap_model_set_point(ColmapModel *model, int index, const double xyz[3], const int rgb[3], const char *where);

#endif
