// test_camera.c - projection, poses, sizes, and the camera's file.
#include "lab/base/fail.h"
#include "lab/base/rng.h"
#include "lab/io/file.h"
#include "splat3d/camera.h"
#include "tests/support/support.h"

#include <math.h>
#include <string.h>

static Camera some_camera(void) {
    return camera_look_at(vec3(3, -2, 5), vec3(0.5, 0, -1), vec3(0, 1, 0), 0.9, 640, 480);
}

static void near_vec3(Vec3 actual, Vec3 expected, double tolerance, const char *what) {
    support_near(actual.x, expected.x, tolerance, what);
    support_near(actual.y, expected.y, tolerance, what);
    support_near(actual.z, expected.z, tolerance, what);
}

static void the_target_falls_on_the_middle_of_the_picture(void **state) {
    (void)state;
    Camera camera = some_camera();
    double x, y, depth;
    assert_true(camera_project(&camera, vec3(0.5, 0, -1), &x, &y, &depth));
    support_near(x, 320, 1e-9, "x");
    support_near(y, 240, 1e-9, "y");
    support_near(depth, sqrt(2.5 * 2.5 + 4 + 36), 1e-12, "depth");
    near_vec3(camera_position(&camera), vec3(3, -2, 5), 1e-12, "position");
    assert_true(camera_check(&camera, "look at"));
}

static void what_is_up_in_the_world_is_up_in_the_picture(void **state) {
    (void)state;
    Camera camera = some_camera();
    double x, y, depth;
    assert_true(camera_project(&camera, vec3(0.5, 0.3, -1), &x, &y, &depth));
    assert_true(y < 240); // pixel rows count downwards
    support_near(x, 320, 1e-9, "x");
    // Looking along -z with y up, x is to the right.
    camera = camera_look_at(vec3(0, 0, 5), vec3(0, 0, 0), vec3(0, 1, 0), 1, 100, 100);
    assert_true(camera_project(&camera, vec3(1, 0, 0), &x, &y, &depth));
    assert_true(x > 50);
}

static void looking_along_up_is_still_a_camera(void **state) {
    (void)state;
    Camera camera = camera_look_at(vec3(0, 5, 0), vec3(0, 0, 0), vec3(0, 1, 0), 1, 100, 80);
    assert_true(camera_check(&camera, "from above"));
    camera = camera_look_at(vec3(1, 1, 1), vec3(1, 1, 1), vec3(0, 1, 0), 1, 100, 80);
    assert_true(camera_check(&camera, "from within"));
}

static void the_field_of_view_reaches_the_edges(void **state) {
    (void)state;
    Camera camera = camera_look_at(vec3(0, 0, 0), vec3(0, 0, 1), vec3(0, -1, 0), 1.2, 640, 480);
    double x, y, depth;
    assert_true(camera_project(&camera, vec3(tan(0.6), 0, 1), &x, &y, &depth));
    support_near(x, 640, 1e-9, "right edge");
}

static void a_ray_goes_through_what_is_projected_to_its_pixel(void **state) {
    (void)state;
    Camera camera = some_camera();
    Rng rng = rng_at(7, RNG_TEST, 0, 0);
    for (int i = 0; i < 100; i++) {
        double x = rng_range(&rng, 0, 640), y = rng_range(&rng, 0, 480), u, v, depth;
        Vec3 ray = camera_ray(&camera, x, y);
        support_near(vec3_length(ray), 1, 1e-12, "length");
        Vec3 point = vec3_add(camera_position(&camera), vec3_scale(ray, rng_range(&rng, 0.1, 100)));
        assert_true(camera_project(&camera, point, &u, &v, &depth));
        support_near(u, x, 1e-8, "x");
        support_near(v, y, 1e-8, "y");
        assert_false(camera_project(&camera, vec3_sub(camera_position(&camera), ray), &u, &v, &depth));
    }
}

static void a_smaller_picture_shows_the_same_part_of_the_world(void **state) {
    (void)state;
    Camera camera = some_camera(), small = camera_resized(&camera, 160, 240);
    double x, y, u, v, depth;
    camera_project(&camera, vec3(0.2, 0.3, 0.4), &x, &y, &depth);
    camera_project(&small, vec3(0.2, 0.3, 0.4), &u, &v, &depth);
    support_near(u, x / 4, 1e-10, "x");
    support_near(v, y / 2, 1e-10, "y");
}

static void a_shrunk_picture_cuts_off_what_does_not_fill_a_pixel(void **state) {
    (void)state;
    Camera camera = some_camera();
    camera.width = 641;
    camera.height = 482;
    Camera small = camera_shrunk(&camera, 4);
    assert_int_equal(small.width, 160);
    assert_int_equal(small.height, 120);
    double x, y, u, v, depth;
    camera_project(&camera, vec3(0.2, 0.3, 0.4), &x, &y, &depth);
    camera_project(&small, vec3(0.2, 0.3, 0.4), &u, &v, &depth);
    support_near(u, x / 4, 1e-10, "x"); // by exactly 4, not by 641 / 160
    support_near(v, y / 4, 1e-10, "y");
}

static void quaternions_and_rotations_turn_into_each_other(void **state) {
    (void)state;
    Rng rng = rng_at(3, RNG_TEST, 0, 0);
    for (int i = 0; i < 1000; i++) {
        double q[4], back[4];
        double length = 0;
        for (int k = 0; k < 4; k++) {
            q[k] = rng_normal(&rng) * ((i >> k & 1) ? 1 : 1e-3); // also near each axis, where one part alone is large
            length += q[k] * q[k];
        }
        Mat3 rotation = camera_rotation_from_quaternion(q);
        camera_quaternion_from_rotation(&rotation, back);
        assert_true(back[0] >= 0);
        double sign = q[0] < 0 ? -1 : 1;
        for (int k = 0; k < 4; k++) support_near(back[k], sign * q[k] / sqrt(length), 1e-12, "quaternion");
    }
    // 90 degrees about z, w x y z: x goes to y.
    const double quarter[4] = {1, 0, 0, 1};
    Mat3 rotation = camera_rotation_from_quaternion(quarter);
    near_vec3(mat3_apply(&rotation, vec3(1, 0, 0)), vec3(0, 1, 0), 1e-15, "x axis");
}

static void an_opengl_pose_comes_back(void **state) {
    (void)state;
    Camera camera = some_camera(), copy = camera;
    double matrix[16];
    camera_pose_to_opengl(&camera, matrix);
    // Its columns: right, up and back as directions in the world, and the position.
    near_vec3(vec3(matrix[3], matrix[7], matrix[11]), vec3(3, -2, 5), 1e-12, "position");
    Vec3 back = vec3(matrix[2], matrix[6], matrix[10]);
    near_vec3(back, vec3_normalize(vec3_sub(vec3(3, -2, 5), vec3(0.5, 0, -1))), 1e-12, "back");
    assert_true(matrix[5] > 0); // up in the picture is up in the world
    for (int i = 0; i < 12; i++)
        if (i % 4 != 3) matrix[i] *= 2.5; // a uniform scale says nothing of the direction
    copy.rotation = (Mat3){{0}};
    copy.translation = vec3(0, 0, 0);
    if (!camera_pose_from_opengl(matrix, &copy, "test")) fail_msg("%s", fail_text());
    for (int i = 0; i < 9; i++) support_near(copy.rotation.m[i], camera.rotation.m[i], 1e-12, "rotation");
    near_vec3(copy.translation, camera.translation, 1e-12, "translation");
}

static void what_is_no_rotation_is_refused(void **state) {
    (void)state;
    Camera camera = some_camera();
    double good[16], bad[16];
    camera_pose_to_opengl(&camera, good);
    for (int kind = 0; kind < 6; kind++) {
        memcpy(bad, good, sizeof bad);
        switch (kind) {
        case 0: // a mirror
            for (int i = 0; i < 3; i++) bad[4 * i] = -bad[4 * i];
            break;
        case 1: // sheared
            bad[1] += 0.1;
            break;
        case 2: // flat
            for (int i = 0; i < 3; i++) bad[4 * i] = 0;
            break;
        case 3:
            bad[6] = NAN;
            break;
        case 4: // transposed
            bad[12] = bad[3];
            bad[3] = 0;
            break;
        default: // one axis longer
            for (int i = 0; i < 3; i++) bad[4 * i] *= 1.1;
        }
        if (camera_pose_from_opengl(bad, &camera, "frame 7")) fail_msg("kind %d was taken", kind);
        assert_non_null(strstr(fail_text(), "frame 7"));
    }
}

static void a_camera_comes_back_from_its_file_to_the_bit(void **state) {
    (void)state;
    Camera camera = some_camera(), copy;
    const char *path = support_path(support_scratch(), "camera.json");
    assert_true(camera_save_json(path, &camera));
    if (!camera_load_json(path, &copy)) fail_msg("%s", fail_text());
    assert_int_equal(copy.width, 640);
    assert_true(copy.fx == camera.fx && copy.fy == camera.fy && copy.cx == camera.cx && copy.cy == camera.cy);
    assert_memory_equal(&copy.rotation, &camera.rotation, sizeof copy.rotation);
    assert_memory_equal(&copy.translation, &camera.translation, sizeof copy.translation);
}

static void a_camera_file_that_makes_no_sense_is_refused(void **state) {
    (void)state;
    static const char *const m = "[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]";
    const struct {
        const char *width, *fx, *cx, *matrix, *reason;
    } cases[] = {
        {"0", "500", "1", m, "0 x 480"},
        {"-640", "500", "1", m, "-640"},
        {"640.5", "500", "1", m, "640.5"},
        {"1e9", "500", "1", m, "1e+09"},
        {"640", "0", "1", m, "focal"},
        {"640", "-5", "1", m, "focal"},
        {"640", "\"5\"", "1", m, "fx"},
        {"640", "500", "null", m, "cx"},
        {"640", "500", "NaN", m, "only finite"},
        {"640", "500", "1", "[1,0,0]", "world_to_camera"},
        {"640", "500", "1", "[2,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]", "no rotation"},
        {"640", "500", "1", "[1,0,0,0, 0,1,0,0, 0,0,-1,0, 0,0,0,1]", "mirror"},
        {"640", "500", "1", "[1,0,0,0, 0,1,0,0, 0,0,1,0, 1,2,3,1]", "transposed"},
    };
    const char *path = support_path(support_scratch(), "bad.json");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[1000];
        snprintf(text, sizeof text,
                 "{\"width\": %s, \"height\": 480, \"fx\": %s, \"fy\": 500, \"cx\": %s, \"cy\": 2, "
                 "\"world_to_camera\": %s}",
                 cases[i].width, cases[i].fx, cases[i].cx, cases[i].matrix);
        assert_true(file_write(path, text, strlen(text)));
        Camera camera;
        if (camera_load_json(path, &camera)) fail_msg("was read: %s", text);
        if (!strstr(fail_text(), cases[i].reason) || !strstr(fail_text(), "bad.json"))
            fail_msg("case %zu: %s", i, fail_text());
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_target_falls_on_the_middle_of_the_picture),
        cmocka_unit_test(what_is_up_in_the_world_is_up_in_the_picture),
        cmocka_unit_test(looking_along_up_is_still_a_camera),
        cmocka_unit_test(the_field_of_view_reaches_the_edges),
        cmocka_unit_test(a_ray_goes_through_what_is_projected_to_its_pixel),
        cmocka_unit_test(a_smaller_picture_shows_the_same_part_of_the_world),
        cmocka_unit_test(a_shrunk_picture_cuts_off_what_does_not_fill_a_pixel),
        cmocka_unit_test(quaternions_and_rotations_turn_into_each_other),
        cmocka_unit_test(an_opengl_pose_comes_back),
        cmocka_unit_test(what_is_no_rotation_is_refused),
        cmocka_unit_test(a_camera_comes_back_from_its_file_to_the_bit),
        cmocka_unit_test(a_camera_file_that_makes_no_sense_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
