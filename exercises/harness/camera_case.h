// camera_case.h - a camera and a splat before it as the numbers of a case: for exercises that look through a camera.
#ifndef SPLATLAB_EXERCISES_HARNESS_CAMERA_CASE_H
#define SPLATLAB_EXERCISES_HARNESS_CAMERA_CASE_H

#include "lab/base/rng.h"
#include "splat3d/camera.h"
#include "splat3d/reference.h"

#include <stdbool.h>

// A case as numbers (doubles, in this order), so that each of them can be made simpler alone.
typedef struct {
    double width, height, fx, fy, cx, cy; // px
    double quat[4];                       // of the camera's rotation, w x y z, any length > 0
    double translation[3];                // of the camera
    double ratio[2];                      // x/z and y/z of the mean in the camera
    double depth;                         // its z
    double log_scale[3];                  // of the splat, ln(world units)
    double splat_quat[4];
} CameraCase;

enum { CAMERA_CASE_NUMBERS = sizeof(CameraCase) / sizeof(double), CAM_NUMBERS = 18 };

// Turned, moved and off-centre; pictures of 40..900 px that are not square; the mean falls up to `reach` half pictures from
// the picture's middle. Splats of 0.01 to 1 times their depth / 3, with aspects up to 30.
void camera_case_draw(Rng *rng, double reach, CameraCase *c);

// Sizes and focal lengths >= 1, depth > 0, quaternions that are not zero, scales within 1e-9 .. 1e9.
bool camera_case_allows(const CameraCase *c);

Camera camera_case_camera(const CameraCase *c);
Vec3 camera_case_mean(const CameraCase *c);  // in camera axes
Sym3 camera_case_shape(const CameraCase *c); // the splat's covariance, in the world

// The record Cam of exercises/exercise.h: width height fx fy cx cy R[9] t[3].
void camera_case_record(const Camera *camera, double cam[CAM_NUMBERS]);

// Sigma as a 3x3 matrix and back; a Sigma a^T.
Mat3 sym3_matrix(Sym3 s);
Sym3 sym3_turned(Sym3 s, const Mat3 *a);

#endif
