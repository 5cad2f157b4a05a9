#include "splat3d/reference.h"

#include "lab/base/rng.h"
#include "tests/support/difference.h"
#include "tests/support/support.h"

#include <string.h>

enum { SEEDS = 60, WIDTH = 64, HEIGHT = 40 };

// One splat before one camera. The loss is a weighted sum of all that the projection gives.
typedef struct {
    char seed[32];
    GaussiansD model;
    Camera camera;
    RenderSettings settings;
    Splat2Gradient weight;
} Scene;

// The mean at camera point (ratio_x z, ratio_y z, z).
static void place(Scene *scene, double ratio_x, double ratio_y, double z) {
    Mat3 to_world = mat3_transpose(&scene->camera.rotation);
    Vec3 in_camera = vec3(ratio_x * z, ratio_y * z, z);
    Vec3 mean = mat3_apply(&to_world, vec3_sub(in_camera, scene->camera.translation));
    double *numbers = gaussiansd_at(&scene->model, FIELD_MEAN, 0);
    numbers[0] = mean.x, numbers[1] = mean.y, numbers[2] = mean.z;
}

static Scene scene_create(uint32_t seed) {
    Scene scene = {.model = gaussiansd_create(1, SH_DEGREE_MAX), .settings = render_settings_default()};
    snprintf(scene.seed, sizeof scene.seed, "seed %u", seed);
    Rng rng = rng_at(seed, RNG_TEST, 0, 0);
    Vec3 eye = vec3(rng_range(&rng, -9, 9), rng_range(&rng, -9, 9), rng_range(&rng, -9, 9));
    scene.camera = camera_look_at(eye, vec3(0.1, 0.2, 0.3), vec3(0, -1, 0), 1.2, WIDTH, HEIGHT);
    scene.camera.fy *= 1.1; // no square pixels, and the centre off the middle
    scene.camera.cx += 4, scene.camera.cy -= 3;
    place(&scene, rng_range(&rng, -0.5, 0.5), rng_range(&rng, -0.3, 0.3), rng_range(&rng, 1, 8));
    for (int k = 0; k < 3; k++) gaussiansd_at(&scene.model, FIELD_LOG_SCALE, 0)[k] = rng_range(&rng, -2, 0);
    for (int k = 0; k < 4; k++) gaussiansd_at(&scene.model, FIELD_QUAT, 0)[k] = rng_normal(&rng);
    *gaussiansd_at(&scene.model, FIELD_OPACITY_LOGIT, 0) = rng_range(&rng, -1, 4);
    for (int l = 0; l <= SH_DEGREE_MAX; l++)
        for (int k = 0; k < 3 * (2 * l + 1); k++)
            gaussiansd_at(&scene.model, FIELD_SH0 + l, 0)[k] = rng_range(&rng, -0.15, 0.15);
    double *weight = &scene.weight.mean_px[0];
    for (size_t k = 0; k < sizeof scene.weight / sizeof *weight; k++) weight[k] = rng_normal(&rng);
    return scene;
}

static Splat2 project(const Scene *scene) {
    Splat2 splat;
    reference_project_forward(&scene->model, 0, &scene->camera, &scene->settings, &splat);
    return splat;
}

static void for_each_scene(void (*check)(Scene *scene)) {
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        Scene scene = scene_create(seed);
        check(&scene);
        gaussiansd_destroy(&scene.model);
    }
}

// ---- forward ----

static void check_mean(Scene *scene) {
    double x, y, depth, *mean = gaussiansd_at(&scene->model, FIELD_MEAN, 0);
    assert_true(camera_project(&scene->camera, vec3(mean[0], mean[1], mean[2]), &x, &y, &depth));
    Splat2 splat = project(scene);
    assert_true(splat.visible);
    support_near(splat.mean_px[0], x, 1e-11, scene->seed);
    support_near(splat.mean_px[1], y, 1e-11, scene->seed);
    support_near(splat.depth, depth, 1e-13, scene->seed);
}

static void the_mean_falls_where_the_camera_projects_it(void **state) {
    (void)state;
    for_each_scene(check_mean);
}

static void check_low_pass(Scene *scene) {
    for (int k = 0; k < 3; k++) gaussiansd_at(&scene->model, FIELD_LOG_SCALE, 0)[k] -= 4;
    Splat2 splat = project(scene);
    support_near(fmin(0, sym2_eigen(splat.covariance).minor - (double)LOW_PASS_PX2), 0, 1e-12, scene->seed);
    support_near(sym2_determinant(splat.covariance) * sym2_determinant(splat.conic), 1, 1e-12, scene->seed);
}

static void no_splat_is_thinner_than_the_low_pass(void **state) {
    (void)state;
    for_each_scene(check_low_pass);
}

// A small splat's true picture: many points of it, each projected by itself.
static void check_against_points(Scene *scene) {
    enum { POINTS = 40000 };
    double *log_scale = gaussiansd_at(&scene->model, FIELD_LOG_SCALE, 0);
    double *mean = gaussiansd_at(&scene->model, FIELD_MEAN, 0);
    for (int k = 0; k < 3; k++) log_scale[k] -= 4;
    Mat3 rotation = reference_rotation_forward(gaussiansd_at(&scene->model, FIELD_QUAT, 0));
    Rng rng = rng_at(1, RNG_TEST, 1, 0);
    double x, y, depth, sum_x = 0, sum_y = 0, xx = 0, xy = 0, yy = 0;
    Splat2 splat = project(scene);
    for (int n = 0; n < POINTS; n++) {
        Vec3 own = vec3(exp(log_scale[0]) * rng_normal(&rng), exp(log_scale[1]) * rng_normal(&rng),
                        exp(log_scale[2]) * rng_normal(&rng));
        Vec3 point = vec3_add(vec3(mean[0], mean[1], mean[2]), mat3_apply(&rotation, own));
        assert_true(camera_project(&scene->camera, point, &x, &y, &depth));
        x -= splat.mean_px[0], y -= splat.mean_px[1];
        sum_x += x, sum_y += y, xx += x * x, xy += x * y, yy += y * y;
    }
    Sym2 expected = {xx / POINTS, xy / POINTS, yy / POINTS};
    Sym2 ewa = sym2_add_diagonal(splat.covariance, -(double)LOW_PASS_PX2);
    double tolerance = 5 * sqrt(2.0 / POINTS) * sym2_eigen(ewa).major; // 5 standard deviations of such an estimate
    support_near(ewa.xx, expected.xx, tolerance, scene->seed);
    support_near(ewa.xy, expected.xy, tolerance, scene->seed);
    support_near(ewa.yy, expected.yy, tolerance, scene->seed);
    support_near(sum_x / POINTS, 0, 0.1 * sqrt(expected.xx), scene->seed);
    support_near(sum_y / POINTS, 0, 0.1 * sqrt(expected.yy), scene->seed);
}

static void a_small_splat_looks_like_the_cloud_of_its_points(void **state) {
    (void)state;
    for (uint32_t seed = 1; seed <= 8; seed++) {
        Scene scene = scene_create(seed);
        check_against_points(&scene);
        gaussiansd_destroy(&scene.model);
    }
}

static void a_ball_off_the_axis_is_longer_away_from_it(void **state) {
    (void)state;
    Scene scene = scene_create(1);
    scene.camera.fy = scene.camera.fx;
    double z = 3, ratio = 0.6, radius = 0.01;
    place(&scene, ratio, 0, z);
    for (int k = 0; k < 3; k++) gaussiansd_at(&scene.model, FIELD_LOG_SCALE, 0)[k] = log(radius);
    Sym2 ewa = sym2_add_diagonal(project(&scene).covariance, -(double)LOW_PASS_PX2);
    double across = scene.camera.fx * radius / z, along = across * sqrt(1 + ratio * ratio); // 1 / cos of the angle
    support_near(sqrt(ewa.xx), along, 1e-9, "away from the axis");
    support_near(sqrt(ewa.yy), across, 1e-9, "round it");
    support_near(ewa.xy, 0, 1e-9, "no tilt");
    gaussiansd_destroy(&scene.model);
}

static void check_scaling(Scene *scene) {
    Splat2 before = project(scene);
    double factor = 2.5; // the whole world, camera included, about the origin
    for (int k = 0; k < 3; k++) {
        gaussiansd_at(&scene->model, FIELD_MEAN, 0)[k] *= factor;
        gaussiansd_at(&scene->model, FIELD_LOG_SCALE, 0)[k] += log(factor);
    }
    scene->camera.translation = vec3_scale(scene->camera.translation, factor);
    Splat2 after = project(scene);
    support_near(after.mean_px[0], before.mean_px[0], 1e-10, scene->seed);
    support_near(after.covariance.xx / before.covariance.xx, 1, 1e-11, scene->seed);
    support_near(after.covariance.xy - before.covariance.xy, 0, 1e-11 * before.covariance.xx, scene->seed);
    support_near(after.depth, factor * before.depth, 1e-11, scene->seed);
    support_near(after.rgb[1], before.rgb[1], 1e-12, scene->seed);
}

static void a_larger_world_seen_from_farther_looks_the_same(void **state) {
    (void)state;
    for_each_scene(check_scaling);
}

static void check_reach(Scene *scene) {
    Splat2 s = project(scene);
    double opacity_at_edge = 0;
    for (int n = 0; n < 2000; n++) { // along the right and the lower edge of the box
        double t = (n - 1000) / 1000.0;
        double right = conic_mahalanobis2(s.conic, s.reach_px[0], t * s.reach_px[1]);
        double lower = conic_mahalanobis2(s.conic, t * s.reach_px[0], s.reach_px[1]);
        opacity_at_edge = fmax(opacity_at_edge, s.opacity * exp(-fmin(right, lower) / 2));
    }
    support_near(opacity_at_edge / (double)ALPHA_MIN, 1, 1e-4, scene->seed);
}

static void the_reach_ends_where_alpha_is_too_faint(void **state) {
    (void)state;
    for_each_scene(check_reach);
}

static void what_cannot_be_seen_is_not_visible(void **state) {
    (void)state;
    Scene scene = scene_create(2);
    double near = (double)scene.settings.near_depth;
    place(&scene, 0, 0, near * 1.001);
    assert_true(project(&scene).visible);
    place(&scene, 0, 0, near * 0.999);
    assert_false(project(&scene).visible);
    place(&scene, 0, 0, -2);
    assert_false(project(&scene).visible);
    place(&scene, 20, 0, 2); // far to the right
    assert_false(project(&scene).visible);

    place(&scene, 0, 0, 2);
    assert_true(project(&scene).visible);
    *gaussiansd_at(&scene.model, FIELD_OPACITY_LOGIT, 0) = log(1 / 254.1 / (1 - 1 / 254.1));
    assert_true(project(&scene).visible);
    *gaussiansd_at(&scene.model, FIELD_OPACITY_LOGIT, 0) = log(1 / 255.1 / (1 - 1 / 255.1));
    assert_false(project(&scene).visible);
    *gaussiansd_at(&scene.model, FIELD_OPACITY_LOGIT, 0) = 1;
    memset(gaussiansd_at(&scene.model, FIELD_QUAT, 0), 0, 4 * sizeof(double));
    assert_false(project(&scene).visible); // no rotation, no shape

    GaussiansD d = gaussiansd_create(1, SH_DEGREE_MAX); // and no gradient
    reference_project_backward(&scene.model, 0, &scene.camera, &scene.settings, &scene.weight, &d);
    for (GaussianFieldId id = 0; id < FIELD_COUNT; id++)
        for (int k = 0; k < GAUSSIAN_FIELDS[id].width; k++) support_near(d.field[id][k], 0, 0, "gradient");
    gaussiansd_destroy(&d);
    gaussiansd_destroy(&scene.model);
}

static void far_outside_the_picture_the_shape_is_that_of_the_frustum_edge(void **state) {
    (void)state;
    Scene scene = scene_create(3);
    for (int k = 0; k < 3; k++)
        gaussiansd_at(&scene.model, FIELD_LOG_SCALE, 0)[k] = 1; // a ball that reaches the picture
    double right = (WIDTH - scene.camera.cx + 0.3 * WIDTH / 2) / scene.camera.fx;
    double top = (-scene.camera.cy - 0.3 * HEIGHT / 2) / scene.camera.fy;
    place(&scene, right + 0.2, top - 0.1, 2);
    Splat2 outside = project(&scene);
    place(&scene, right, top, 2);
    Splat2 edge = project(&scene);
    assert_true(outside.visible && edge.visible);
    support_near(outside.covariance.xx, edge.covariance.xx, 1e-4, "xx"); // the margin is a float
    support_near(outside.covariance.xy, edge.covariance.xy, 1e-4, "xy");
    support_near(outside.covariance.yy, edge.covariance.yy, 1e-4, "yy");
    support_near(outside.mean_px[0] - edge.mean_px[0], 0.2 * scene.camera.fx, 1e-9, "the mean is not clamped");
    support_near(outside.mean_px[1] - edge.mean_px[1], -0.1 * scene.camera.fy, 1e-9, "the mean is not clamped");
    place(&scene, right - 0.01, top + 0.01, 2);
    assert_true(fabs(project(&scene).covariance.xx - edge.covariance.xx) > 0.1);
    gaussiansd_destroy(&scene.model);
}

// ---- backward ----

static double weighted_splat(void *context) {
    const Scene *scene = context;
    const Splat2Gradient *w = &scene->weight;
    Splat2 s = project(scene);
    assert_true(s.visible);
    return w->mean_px[0] * s.mean_px[0] + w->mean_px[1] * s.mean_px[1] + w->conic.xx * s.conic.xx +
           w->conic.xy * s.conic.xy + w->conic.yy * s.conic.yy + w->opacity * s.opacity + w->rgb[0] * s.rgb[0] +
           w->rgb[1] * s.rgb[1] + w->rgb[2] * s.rgb[2];
}

static void check_gradient(Scene *scene) {
    GaussiansD d = gaussiansd_create(1, SH_DEGREE_MAX);
    reference_project_backward(&scene->model, 0, &scene->camera, &scene->settings, &scene->weight, &d);
    for (GaussianFieldId id = 0; id < FIELD_COUNT; id++) {
        double expected[21];
        for (int k = 0; k < GAUSSIAN_FIELDS[id].width; k++)
            expected[k] = difference_central(&scene->model.field[id][k], 1e-4, weighted_splat, scene);
        char what[64];
        snprintf(what, sizeof what, "%s, %s", GAUSSIAN_FIELDS[id].name, scene->seed);
        difference_compare(GAUSSIAN_FIELDS[id].width, d.field[id], expected, 1e-6, 1e-6, what);
    }
    gaussiansd_destroy(&d);
}

// The conic is small where the splat is large: weigh it so that the way through the shape counts as much as the mean's.
static void weigh_conic(Scene *scene, double factor) {
    scene->weight.conic.xx *= factor, scene->weight.conic.xy *= factor, scene->weight.conic.yy *= factor;
}

static void check_gradient_inside(Scene *scene) {
    weigh_conic(scene, 100);
    check_gradient(scene);
}

static void every_gradient_agrees_with_central_differences(void **state) {
    (void)state;
    for_each_scene(check_gradient_inside);
}

static void check_shape_alone(Scene *scene) {
    Splat2Gradient shape = {.conic = scene->weight.conic};
    scene->weight = shape;
    check_gradient(scene);
}

static void so_does_the_way_through_the_shape_alone(void **state) {
    (void)state;
    for_each_scene(check_shape_alone);
}

// x/z and y/z each below, within and above what the clamp leaves; a large splat, so that it still reaches the picture.
static void so_does_it_where_the_frustum_clamps(void **state) {
    (void)state;
    const double ratios_x[3] = {-1.3, 0.1, 1.2}, ratios_y[3] = {-0.8, 0.2, 1.1};
    for (int nx = 0; nx < 3; nx++)
        for (int ny = 0; ny < 3; ny++) {
            Scene scene = scene_create((uint32_t)(10 + 3 * nx + ny));
            for (int k = 0; k < 3; k++) gaussiansd_at(&scene.model, FIELD_LOG_SCALE, 0)[k] += 1.2;
            place(&scene, ratios_x[nx], ratios_y[ny], 2);
            check_shape_alone(&scene);
            gaussiansd_destroy(&scene.model);
        }
}

static void check_depth_gradient(Scene *scene) {
    scene->settings.what = RENDER_DEPTH;
    Splat2 splat = project(scene);
    support_near(splat.rgb[0], splat.depth, 0, scene->seed);
    support_near(splat.rgb[1], 1, 0, scene->seed);
    support_near(splat.rgb[2], 0, 0, scene->seed);
    check_gradient_inside(scene);
}

static void so_does_the_depth_that_is_shown_as_a_colour(void **state) {
    (void)state;
    for_each_scene(check_depth_gradient);
}

// J W Sigma W^T J^T as full matrices, where the mean is well inside the picture.
static void the_shape_alone_is_the_product_of_five_matrices(void **state) {
    (void)state;
    Rng rng = rng_at(11, RNG_TEST, 0, 0);
    for (int n = 0; n < 50; n++) {
        Scene scene = scene_create((uint32_t)n + 1);
        const Camera *camera = &scene.camera;
        Vec3 c = vec3(rng_range(&rng, -0.2, 0.2), rng_range(&rng, -0.2, 0.2), rng_range(&rng, 0.8, 3));
        const double *log_scale = gaussiansd_at(&scene.model, FIELD_LOG_SCALE, 0);
        Sym3 s = reference_covariance_forward(log_scale, gaussiansd_at(&scene.model, FIELD_QUAT, 0));
        Mat3 sigma = {{s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz}};
        Mat3 j = {{camera->fx / c.z, 0, -camera->fx * c.x / (c.z * c.z), //
                   0, camera->fy / c.z, -camera->fy * c.y / (c.z * c.z), 0, 0, 0}};
        Mat3 map = mat3_multiply(&j, &camera->rotation), back = mat3_transpose(&map);
        Mat3 product = mat3_multiply(&map, &sigma);
        product = mat3_multiply(&product, &back);
        Sym2 projected = reference_ewa_forward(camera, c, s);
        double trace = projected.xx + projected.yy;
        support_near(projected.xx / trace, product.m[0] / trace, 1e-14, "xx");
        support_near(projected.xy / trace, product.m[1] / trace, 1e-14, "xy");
        support_near(projected.yy / trace, product.m[4] / trace, 1e-14, "yy");
        gaussiansd_destroy(&scene.model);
    }
}

static void gradients_of_the_shape_alone_are_added_to_what_is_there(void **state) {
    (void)state;
    Scene scene = scene_create(1);
    Vec3 c = vec3(0.1, -0.2, 2), once = {0}, twice = {0};
    Sym3 s = {.xx = 1, .xy = 0.2, .xz = -0.1, .yy = 2, .yz = 0.3, .zz = 0.5}, d_once = {0}, d_twice = {0};
    Sym2 d = {0.3, -0.7, 1.1};
    reference_ewa_backward(&scene.camera, c, s, d, &once, &d_once);
    for (int i = 0; i < 2; i++) reference_ewa_backward(&scene.camera, c, s, d, &twice, &d_twice);
    assert_true(once.x != 0 && once.y != 0 && once.z != 0 && d_once.xy != 0);
    support_near(twice.x, 2 * once.x, 0, "x");
    support_near(twice.z, 2 * once.z, 0, "z");
    support_near(d_twice.xy, 2 * d_once.xy, 0, "xy");
    support_near(d_twice.zz, 2 * d_once.zz, 0, "zz");
    gaussiansd_destroy(&scene.model);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_mean_falls_where_the_camera_projects_it),
        cmocka_unit_test(no_splat_is_thinner_than_the_low_pass),
        cmocka_unit_test(a_small_splat_looks_like_the_cloud_of_its_points),
        cmocka_unit_test(a_ball_off_the_axis_is_longer_away_from_it),
        cmocka_unit_test(a_larger_world_seen_from_farther_looks_the_same),
        cmocka_unit_test(the_reach_ends_where_alpha_is_too_faint),
        cmocka_unit_test(what_cannot_be_seen_is_not_visible),
        cmocka_unit_test(far_outside_the_picture_the_shape_is_that_of_the_frustum_edge),
        cmocka_unit_test(every_gradient_agrees_with_central_differences),
        cmocka_unit_test(so_does_the_way_through_the_shape_alone),
        cmocka_unit_test(so_does_it_where_the_frustum_clamps),
        cmocka_unit_test(so_does_the_depth_that_is_shown_as_a_colour),
        cmocka_unit_test(the_shape_alone_is_the_product_of_five_matrices),
        cmocka_unit_test(gradients_of_the_shape_alone_are_added_to_what_is_there),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
