// camera_case.c - random cameras and splats, and the records that an answer sees of them.
#include "exercises/harness/camera_case.h"

#include <math.h>
#include <string.h>

static const double ASPECT_MAX = 30, SCALE_MIN = 1e-9, SCALE_MAX = 1e9;

void camera_case_draw(Rng *rng, double reach, CameraCase *c) {
    c->width = 40 + rng_below(rng, 861);
    c->height = 40 + rng_below(rng, 861);
    c->fx = c->width * exp(rng_range(rng, log(0.4), log(3)));
    c->fy = c->fx * rng_range(rng, 0.7, 1.4);
    c->cx = c->width * rng_range(rng, 0.3, 0.7);
    c->cy = c->height * rng_range(rng, 0.3, 0.7);
    for (int i = 0; i < 4; i++) c->quat[i] = rng_normal(rng);
    for (int i = 0; i < 3; i++) c->translation[i] = rng_range(rng, -5, 5);
    c->ratio[0] = (c->width * (1 + rng_range(rng, -reach, reach)) / 2 - c->cx) / c->fx;
    c->ratio[1] = (c->height * (1 + rng_range(rng, -reach, reach)) / 2 - c->cy) / c->fy;
    c->depth = exp(rng_range(rng, log(0.5), log(50)));
    double largest = c->depth / 3 * exp(rng_range(rng, log(0.01), 0));
    uint32_t which = rng_below(rng, 3);
    for (uint32_t i = 0; i < 3; i++)
        c->log_scale[i] = log(largest) - (i == which ? 0 : rng_range(rng, 0, log(ASPECT_MAX)));
    for (int i = 0; i < 4; i++) c->splat_quat[i] = rng_normal(rng);
}

static double length4(const double q[4]) { return sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]); }

bool camera_case_allows(const CameraCase *c) {
    for (int i = 0; i < 3; i++)
        if (c->log_scale[i] < log(SCALE_MIN) || c->log_scale[i] > log(SCALE_MAX)) return false;
    return c->width >= 1 && c->height >= 1 && c->fx >= 1 && c->fy >= 1 && c->depth > 0 && length4(c->quat) > 0 &&
           length4(c->splat_quat) > 0;
}

Camera camera_case_camera(const CameraCase *c) {
    Camera camera = {
        .width = (int)c->width, .height = (int)c->height, .fx = c->fx, .fy = c->fy, .cx = c->cx, .cy = c->cy};
    camera.rotation = camera_rotation_from_quaternion(c->quat);
    camera.translation = vec3(c->translation[0], c->translation[1], c->translation[2]);
    return camera;
}

Vec3 camera_case_mean(const CameraCase *c) { return vec3(c->ratio[0] * c->depth, c->ratio[1] * c->depth, c->depth); }

Sym3 camera_case_shape(const CameraCase *c) { return reference_covariance_forward(c->log_scale, c->splat_quat); }

void camera_case_record(const Camera *camera, double cam[CAM_NUMBERS]) {
    const double head[6] = {camera->width, camera->height, camera->fx, camera->fy, camera->cx, camera->cy};
    const double tail[3] = {camera->translation.x, camera->translation.y, camera->translation.z};
    memcpy(cam, head, sizeof head);
    memcpy(cam + 6, camera->rotation.m, sizeof camera->rotation.m);
    memcpy(cam + 15, tail, sizeof tail);
}

Mat3 sym3_matrix(Sym3 s) { return (Mat3){{s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz}}; }

Sym3 sym3_turned(Sym3 s, const Mat3 *a) {
    Mat3 matrix = sym3_matrix(s), transposed = mat3_transpose(a), left = mat3_multiply(a, &matrix);
    const double *m = (matrix = mat3_multiply(&left, &transposed)).m;
    return (Sym3){.xx = m[0], .xy = m[1], .xz = m[2], .yy = m[4], .yz = m[5], .zz = m[8]};
}
