// camera.c - the pinhole camera: projection, poses in the axes of others, and its file.
#include "splat3d/camera.h"

#include "lab/base/fail.h"
#include "lab/io/json_io.h"

#include <assert.h>
#include <float.h>
#include <math.h>
#include <stddef.h>

static const double ROTATION_TOLERANCE = 1e-3; // of R^T R against the identity; files hold single precision or less

Vec3 camera_position(const Camera *camera) {
    Mat3 to_world = mat3_transpose(&camera->rotation);
    return vec3_scale(mat3_apply(&to_world, camera->translation), -1);
}

Vec3 camera_point(const Camera *camera, Vec3 point_world) {
    return vec3_add(mat3_apply(&camera->rotation, point_world), camera->translation);
}

bool camera_project(const Camera *camera, Vec3 point_world, double *x_px, double *y_px, double *depth) {
    Vec3 p = camera_point(camera, point_world);
    if (!(p.z > 0)) return false;
    *x_px = camera->fx * p.x / p.z + camera->cx;
    *y_px = camera->fy * p.y / p.z + camera->cy;
    *depth = p.z;
    return true;
}

Vec3 camera_ray(const Camera *camera, double x_px, double y_px) {
    Vec3 direction = vec3((x_px - camera->cx) / camera->fx, (y_px - camera->cy) / camera->fy, 1);
    Mat3 to_world = mat3_transpose(&camera->rotation);
    return vec3_normalize(mat3_apply(&to_world, direction));
}

Camera camera_look_at(Vec3 eye, Vec3 target, Vec3 up, double fov_x_rad, int width, int height) {
    Vec3 z = vec3_normalize(vec3_sub(target, eye));
    if (vec3_length(z) == 0) z = vec3(0, 0, 1);
    Vec3 x = vec3_cross(z, up);
    if (!(vec3_length(x) > 1e-9 * vec3_length(up))) // looking along `up`: any other direction serves
        x = vec3_cross(z, fabs(z.x) < 0.5 ? vec3(1, 0, 0) : vec3(0, 1, 0));
    x = vec3_normalize(x);
    Vec3 y = vec3_cross(z, x);
    Camera camera = {.width = width, .height = height};
    camera.fx = camera.fy = 0.5 * width / tan(0.5 * fov_x_rad);
    camera.cx = 0.5 * width;
    camera.cy = 0.5 * height;
    camera.rotation = (Mat3){{x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z}};
    camera.translation = vec3_scale(mat3_apply(&camera.rotation, eye), -1);
    return camera;
}

Camera camera_resized(const Camera *camera, int width, int height) {
    Camera out = *camera;
    double scale_x = (double)width / camera->width, scale_y = (double)height / camera->height;
    out.width = width;
    out.height = height;
    out.fx *= scale_x;
    out.cx *= scale_x;
    out.fy *= scale_y;
    out.cy *= scale_y;
    return out;
}

// What k pixels do not fill is cut off right and below: the principal point stays where it is, and then all intrinsics shrink
// by exactly k.
Camera camera_shrunk(const Camera *camera, int k) {
    Camera cut = *camera;
    int width = camera->width / k, height = camera->height / k;
    assert(k >= 1 && width >= 1 && height >= 1);
    cut.width = width * k;
    cut.height = height * k;
    return camera_resized(&cut, width, height);
}

// ---- poses ----

static double determinant(const Mat3 *a) {
    const double *m = a->m;
    return vec3_dot(vec3(m[0], m[1], m[2]), vec3_cross(vec3(m[3], m[4], m[5]), vec3(m[6], m[7], m[8])));
}

static bool check_rotation(const Mat3 *r, const char *where) {
    Mat3 transposed = mat3_transpose(r), product = mat3_multiply(&transposed, r);
    double worst = 0;
    for (int i = 0; i < 9; i++) {
        double error = fabs(product.m[i] - (i % 4 == 0));
        if (!(error <= worst)) worst = error; // NaN too
    }
    if (!(worst <= ROTATION_TOLERANCE))
        return fail("%s: the 3x3 part of the pose is no rotation (R^T R is off the identity by %.3g); "
                    "was the file edited, or is it of another kind?",
                    where, worst);
    if (determinant(r) < 0)
        return fail("%s: the 3x3 part of the pose is a mirror image (determinant -1), not a rotation; "
                    "are its axes those of this file format?",
                    where);
    return true;
}

bool camera_pose_from_opengl(const double m[16], Camera *camera, const char *where) {
    if (fabs(m[12]) + fabs(m[13]) + fabs(m[14]) + fabs(m[15] - 1) > 1e-6)
        return fail("%s: the last row of the camera-to-world matrix is %g %g %g %g, want 0 0 0 1; is it transposed?",
                    where, m[12], m[13], m[14], m[15]);
    Mat3 axes = {{m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]}};
    double scale = cbrt(fabs(determinant(&axes)));
    if (scale > 0)
        for (int i = 0; i < 9; i++) axes.m[i] /= scale;
    if (!check_rotation(&axes, where)) return false;

    // y up, z back -> y down, z forward: the rows of the inverse change sign.
    Mat3 rotation = mat3_transpose(&axes);
    for (int i = 3; i < 9; i++) rotation.m[i] = -rotation.m[i];
    double wxyz[4]; // by way of the quaternion it becomes an exact rotation
    camera_quaternion_from_rotation(&rotation, wxyz);
    camera->rotation = camera_rotation_from_quaternion(wxyz);
    camera->translation = vec3_scale(mat3_apply(&camera->rotation, vec3(m[3], m[7], m[11])), -1);
    return true;
}

void camera_pose_to_opengl(const Camera *camera, double m[16]) {
    Vec3 eye = camera_position(camera);
    const double position[3] = {eye.x, eye.y, eye.z};
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++)
            m[4 * row + column] = (column == 0 ? 1 : -1) * camera->rotation.m[3 * column + row];
        m[4 * row + 3] = position[row];
    }
    m[12] = m[13] = m[14] = 0;
    m[15] = 1;
}

Mat3 camera_rotation_from_quaternion(const double q[4]) {
    double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    double w = q[0] / length, x = q[1] / length, y = q[2] / length, z = q[3] / length;
    return (Mat3){{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), //
                   2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), //
                   2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
}

// Shepperd, "Quaternion from rotation matrix" (1978): the largest of w x y z is taken from the diagonal, so that nothing
// is divided by a small number.
void camera_quaternion_from_rotation(const Mat3 *rotation, double q[4]) {
    const double *m = rotation->m;
    double trace = m[0] + m[4] + m[8];
    const double square[4] = {trace, m[0], m[4], m[8]}; // 4 q_i^2 - 1 = 2 square_i - trace, and 4 w^2 - 1 = trace
    int largest = 0;
    for (int i = 1; i < 4; i++)
        if (square[i] > square[largest]) largest = i;
    switch (largest) {
    case 0:
        q[0] = 1 + trace, q[1] = m[7] - m[5], q[2] = m[2] - m[6], q[3] = m[3] - m[1];
        break;
    case 1:
        q[0] = m[7] - m[5], q[1] = 1 + 2 * m[0] - trace, q[2] = m[1] + m[3], q[3] = m[2] + m[6];
        break;
    case 2:
        q[0] = m[2] - m[6], q[1] = m[1] + m[3], q[2] = 1 + 2 * m[4] - trace, q[3] = m[5] + m[7];
        break;
    default:
        q[0] = m[3] - m[1], q[1] = m[2] + m[6], q[2] = m[5] + m[7], q[3] = 1 + 2 * m[8] - trace;
        break;
    }
    double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    double sign = q[0] < 0 ? -1 : 1;
    for (int i = 0; i < 4; i++) q[i] *= sign / length;
}

// ---- files ----

bool camera_check(const Camera *c, const char *where) {
    if (c->width < 1 || c->height < 1 || c->width > CAMERA_SIDE_MAX || c->height > CAMERA_SIDE_MAX)
        return fail("%s: a picture of %d x %d px, want sides of 1 to %d", where, c->width, c->height, CAMERA_SIDE_MAX);
    if (!(c->fx > 0 && c->fx <= DBL_MAX && c->fy > 0 && c->fy <= DBL_MAX))
        return fail("%s: focal lengths %g and %g px, want numbers above 0", where, c->fx, c->fy);
    if (!isfinite(c->cx) || !isfinite(c->cy))
        return fail("%s: principal point (%g, %g) is not finite", where, c->cx, c->cy);
    if (!isfinite(c->translation.x) || !isfinite(c->translation.y) || !isfinite(c->translation.z))
        return fail("%s: translation (%g, %g, %g) is not finite", where, c->translation.x, c->translation.y,
                    c->translation.z);
    return check_rotation(&c->rotation, where);
}

static bool from_json(const json_t *root, const char *path, Camera *camera) {
    double width, height, m[16];
    if (!json_get_number(root, "width", path, &width) || !json_get_number(root, "height", path, &height) ||
        !json_get_number(root, "fx", path, &camera->fx) || !json_get_number(root, "fy", path, &camera->fy) ||
        !json_get_number(root, "cx", path, &camera->cx) || !json_get_number(root, "cy", path, &camera->cy) ||
        !json_get_matrix4(root, "world_to_camera", path, m))
        return false;
    if (width != floor(width) || height != floor(height) || fabs(width) > CAMERA_SIDE_MAX ||
        fabs(height) > CAMERA_SIDE_MAX)
        return fail("%s: a picture of %g x %g px, want whole numbers of 1 to %d", path, width, height, CAMERA_SIDE_MAX);
    if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1)
        return fail("%s: the last row of \"world_to_camera\" is %g %g %g %g, want 0 0 0 1; is it transposed?", path,
                    m[12], m[13], m[14], m[15]);
    camera->width = (int)width;
    camera->height = (int)height;
    camera->rotation = (Mat3){{m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]}};
    camera->translation = vec3(m[3], m[7], m[11]);
    return camera_check(camera, path);
}

bool camera_load_json(const char *path, Camera *camera) {
    json_t *root;
    *camera = (Camera){0};
    if (!json_read(path, &root)) return false;
    bool ok = from_json(root, path, camera);
    json_decref(root);
    return ok;
}

bool camera_save_json(const char *path, const Camera *camera) {
    const double *r = camera->rotation.m;
    Vec3 t = camera->translation;
    json_t *root = json_pack("{s:i, s:i, s:f, s:f, s:f, s:f, s:[f,f,f,f, f,f,f,f, f,f,f,f, f,f,f,f]}",             //
                             "width", camera->width, "height", camera->height, "fx", camera->fx, "fy", camera->fy, //
                             "cx", camera->cx, "cy", camera->cy, "world_to_camera",                                //
                             r[0], r[1], r[2], t.x, r[3], r[4], r[5], t.y, r[6], r[7], r[8], t.z, 0.0, 0.0, 0.0, 1.0);
    if (!root) return fail("cannot write %s: the camera has numbers that are not finite", path);
    bool ok = json_write(path, root);
    json_decref(root);
    return ok;
}
