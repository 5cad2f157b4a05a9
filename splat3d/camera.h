// camera.h - a pinhole camera: OpenCV axes (x right, y down, z forward), world-to-camera rotation and translation.
//
// A world point p is R p + t in the camera, and falls on pixel coordinates (fx x/z + cx, fy y/z + cy); pixel (i, j) covers
// [i, i+1) x [j, j+1), its centre is (i + 0.5, j + 0.5).
#ifndef SPLATLAB_SPLAT3D_CAMERA_H
#define SPLATLAB_SPLAT3D_CAMERA_H

#include "lab/base/vec.h"

#include <stdbool.h>

typedef struct {
    int width, height; // px
    double fx, fy;     // focal lengths, px, > 0
    double cx, cy;     // principal point, px
    Mat3 rotation;     // world to camera
    Vec3 translation;  // world to camera: p_cam = rotation p + translation
} Camera;

Vec3 camera_position(const Camera *camera);                // of the centre, in the world
Vec3 camera_point(const Camera *camera, Vec3 point_world); // in camera axes

// False when the point is not in front of the camera (z <= 0).
bool camera_project(const Camera *camera, Vec3 point_world, double *x_px, double *y_px, double *depth);

// Unit direction in the world of the ray through pixel coordinates (x, y).
Vec3 camera_ray(const Camera *camera, double x_px, double y_px);

// At `eye`, looking at `target`, with the picture's up as near to `up` as that allows. fov_x_rad: full horizontal angle.
Camera camera_look_at(Vec3 eye, Vec3 target, Vec3 up, double fov_x_rad, int width, int height);

// The same camera with pictures of another size: intrinsics scaled by width / old width and height / old height.
Camera camera_resized(const Camera *camera, int width, int height);

// The same camera with pictures of 1/k of the size, width / k and height / k rounded down (neither to 0): the camera of what
// image8_downscale() makes.
Camera camera_shrunk(const Camera *camera, int k);

// Sets the pose from a camera-to-world matrix (row-major 4x4) in OpenGL axes (x right, y up, z back), as Blender and nerfstudio
// write it, and back. Fails when its 3x3 part is no rotation (a uniform scale is divided out); `where` names the object.
bool camera_pose_from_opengl(const double camera_to_world[16], Camera *camera, const char *where);
void camera_pose_to_opengl(const Camera *camera, double camera_to_world[16]);

enum { CAMERA_SIDE_MAX = 65535 }; // px

// For what a file says: sides of 1..CAMERA_SIDE_MAX px, focal lengths > 0, everything finite, rotation a rotation.
bool camera_check(const Camera *camera, const char *where);

// width height fx fy cx cy world_to_camera (16 numbers, row-major, OpenCV axes).
bool camera_load_json(const char *path, Camera *camera);
bool camera_save_json(const char *path, const Camera *camera);

// Rotation from a quaternion w x y z of any length > 0, and back (w >= 0).
Mat3 camera_rotation_from_quaternion(const double wxyz[4]);
void camera_quaternion_from_rotation(const Mat3 *rotation, double wxyz[4]);

#endif
