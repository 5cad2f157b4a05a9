// orbit.c - the circle that fits the cameras of a scene.
#include "lab/app/orbit.h"

#include <math.h>

static Vec3 row(const Mat3 *m, int i) { return vec3(m->m[3 * i], m->m[3 * i + 1], m->m[3 * i + 2]); }

// Camera axes in the world are the rows of the world-to-camera rotation: x right, y down, z forward.
static Vec3 forward(const Camera *camera) { return row(&camera->rotation, 2); }
static Vec3 upward(const Camera *camera) { return vec3_scale(row(&camera->rotation, 1), -1); }

static double determinant(const Mat3 *a) { return vec3_dot(row(a, 0), vec3_cross(row(a, 1), row(a, 2))); }

// Solves a x = b by Cramer's rule on a symmetric matrix, whose rows are its columns.
static Vec3 solve_symmetric(const Mat3 *a, Vec3 b) {
    Vec3 r0 = row(a, 0), r1 = row(a, 1), r2 = row(a, 2);
    double d = determinant(a);
    return vec3(vec3_dot(b, vec3_cross(r1, r2)) / d, vec3_dot(r0, vec3_cross(b, r2)) / d,
                vec3_dot(r0, vec3_cross(r1, b)) / d);
}

// The point with the least sum of squared distances to all optical axes: sum (I - f f^T) (x - c) = 0. Where the axes are
// nearly parallel there is none; then a point as far in front of the cameras as the scene is wide.
static Vec3 find_focus(const Dataset *dataset) {
    Mat3 a = {{0}};
    Vec3 b = vec3(0, 0, 0), mean_forward = vec3(0, 0, 0);
    for (int v = 0; v < dataset->view_count; v++) {
        const Camera *camera = &dataset->views[v].camera;
        Vec3 f = forward(camera), c = camera_position(camera);
        double fs[3] = {f.x, f.y, f.z};
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) a.m[3 * i + j] += (i == j) - fs[i] * fs[j];
        b = vec3_add(b, vec3_sub(c, vec3_scale(f, vec3_dot(f, c))));
        mean_forward = vec3_add(mean_forward, f);
    }
    // The determinant of the mean is 1 for axes from everywhere and 0 for parallel ones; 1e-4 is a spread of about 1 degree.
    double n = dataset->view_count;
    if (determinant(&a) / (n * n * n) > 1e-4) return solve_symmetric(&a, b);
    return vec3_add(dataset->centre, vec3_scale(vec3_normalize(mean_forward), fmax(dataset->extent, 1e-3)));
}

static Vec3 any_perpendicular(Vec3 up) {
    Vec3 other = fabs(up.x) < 0.9 ? vec3(1, 0, 0) : vec3(0, 1, 0);
    return vec3_normalize(vec3_cross(up, other));
}

Orbit orbit_of_scene(const Dataset *dataset) {
    const Camera *first = &dataset->views[0].camera;
    Orbit orbit = {.focus = find_focus(dataset),
                   .fov_x_rad = 2 * atan(first->width / (2 * first->fx)),
                   .width = first->width,
                   .height_px = first->height};
    Vec3 up = vec3(0, 0, 0);
    for (int v = 0; v < dataset->view_count; v++) up = vec3_add(up, upward(&dataset->views[v].camera));
    orbit.up = vec3_length(up) > 1e-9 ? vec3_normalize(up) : upward(first);
    for (int v = 0; v < dataset->view_count; v++) {
        Vec3 from_focus = vec3_sub(camera_position(&dataset->views[v].camera), orbit.focus);
        double height = vec3_dot(from_focus, orbit.up);
        orbit.height += height / dataset->view_count;
        orbit.radius += vec3_length(vec3_sub(from_focus, vec3_scale(orbit.up, height))) / dataset->view_count;
    }
    // The first frame stands where the first camera does.
    Vec3 to_first = vec3_sub(camera_position(first), orbit.focus);
    Vec3 flat = vec3_sub(to_first, vec3_scale(orbit.up, vec3_dot(to_first, orbit.up)));
    orbit.along = vec3_length(flat) > 1e-9 ? vec3_normalize(flat) : any_perpendicular(orbit.up);
    orbit.across = vec3_cross(orbit.up, orbit.along);
    return orbit;
}

Camera orbit_camera(const Orbit *orbit, int frame, int frames) {
    double angle_rad = 2 * M_PI * frame / frames;
    Vec3 on_circle = vec3_add(vec3_scale(orbit->along, orbit->radius * cos(angle_rad)),
                              vec3_scale(orbit->across, orbit->radius * sin(angle_rad)));
    Vec3 eye = vec3_add(orbit->focus, vec3_add(on_circle, vec3_scale(orbit->up, orbit->height)));
    return camera_look_at(eye, orbit->focus, orbit->up, orbit->fov_x_rad, orbit->width, orbit->height_px);
}
