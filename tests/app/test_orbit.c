#include "lab/app/orbit.h"
#include "lab/base/mem.h"
#include "tests/support/support.h"

#include <math.h>

enum { VIEWS = 12 };

static Dataset dataset_of(Camera (*camera_of)(int)) {
    Dataset d = {.view_count = VIEWS, .downscale = 1, .extent = 2};
    d.views = mem_alloc(VIEWS, sizeof *d.views);
    for (int v = 0; v < VIEWS; v++) {
        d.views[v].camera = camera_of(v);
        d.centre = vec3_add(d.centre, vec3_scale(camera_position(&d.views[v].camera), 1.0 / VIEWS));
    }
    return d;
}

// A circle of radius 3, 1.5 above the point (1, 2, 3) that it looks at; up is +y.
static Camera ring_camera(int v) {
    double angle_rad = 2 * M_PI * v / VIEWS;
    Vec3 target = vec3(1, 2, 3);
    Vec3 eye = vec3_add(target, vec3(3 * cos(angle_rad), 1.5, 3 * sin(angle_rad)));
    return camera_look_at(eye, target, vec3(0, 1, 0), 0.8, 64, 48);
}

// Side by side, all looking along +z.
static Camera row_camera(int v) {
    Vec3 eye = vec3(0.1 * v, 0, 0);
    return camera_look_at(eye, vec3_add(eye, vec3(0, 0, 1)), vec3(0, 1, 0), 0.8, 64, 48);
}

static void near_vec(Vec3 actual, Vec3 expected, const char *what) {
    support_near(vec3_length(vec3_sub(actual, expected)), 0, 1e-9, what);
}

static void a_ring_of_cameras_is_found_again(void **state) {
    (void)state;
    Dataset d = dataset_of(ring_camera);
    Orbit orbit = orbit_of_scene(&d);
    near_vec(orbit.focus, vec3(1, 2, 3), "focus");
    near_vec(orbit.up, vec3(0, 1, 0), "up");
    support_near(orbit.radius, 3, 1e-9, "radius");
    support_near(orbit.height, 1.5, 1e-9, "height");
    support_near(orbit.fov_x_rad, 0.8, 1e-9, "field of view");
    Camera first = orbit_camera(&orbit, 0, 8);
    near_vec(camera_position(&first), camera_position(&d.views[0].camera), "first frame");
    assert_int_equal(first.width, 64);
    assert_int_equal(first.height, 48);
    mem_free(d.views);
}

static void every_frame_looks_at_the_focus_from_the_circle(void **state) {
    (void)state;
    Dataset d = dataset_of(ring_camera);
    Orbit orbit = orbit_of_scene(&d);
    for (int frame = 0; frame < 7; frame++) {
        Camera camera = orbit_camera(&orbit, frame, 7);
        double x, y, depth;
        assert_true(camera_project(&camera, orbit.focus, &x, &y, &depth));
        support_near(x, 32, 1e-6, "x of the focus");
        support_near(y, 24, 1e-6, "y of the focus");
        support_near(depth, hypot(3, 1.5), 1e-9, "distance");
    }
    mem_free(d.views);
}

static void parallel_cameras_still_give_an_orbit(void **state) {
    (void)state;
    Dataset d = dataset_of(row_camera);
    Orbit orbit = orbit_of_scene(&d);
    near_vec(orbit.focus, vec3_add(d.centre, vec3(0, 0, 2)), "focus: in front, as far as the extent");
    Camera camera = orbit_camera(&orbit, 3, 8);
    assert_true(isfinite(camera.translation.x) && isfinite(camera.rotation.m[0]));
    mem_free(d.views);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ring_of_cameras_is_found_again),
        cmocka_unit_test(every_frame_looks_at_the_focus_from_the_circle),
        cmocka_unit_test(parallel_cameras_still_give_an_orbit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
