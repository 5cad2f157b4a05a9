#include "splat3d/reference.h"

#include "lab/base/mem.h"
#include "lab/base/rng.h"
#include "splat3d/ply.h"
#include "tests/support/difference.h"
#include "tests/support/support.h"

#include <stdlib.h>

// ---- every gradient through the whole chain ----

enum { WIDTH = 22, HEIGHT = 18, SPLATS = 20, VALUES = 3 * WIDTH * HEIGHT };

typedef struct {
    GaussiansD model;
    Camera camera;
    RenderSettings settings;
    double weight[VALUES]; // the loss is weight . rgb
} Scene;

static double weighted_picture(void *context) {
    const Scene *scene = context;
    PictureD picture;
    double sum = 0;
    reference_render_forward(&scene->model, &scene->camera, &scene->settings, &picture);
    for (int k = 0; k < VALUES; k++) sum += scene->weight[k] * picture.rgb[k];
    pictured_destroy(&picture);
    return sum;
}

// Anything between inside and well outside of the picture, any shape, any turn, some solid, some with dark colours.
static void draw_splat(GaussiansD *g, int i, Rng *rng) {
    double spread = i % 4 ? 0.8 : 2.5;
    for (int k = 0; k < 3; k++) gaussiansd_at(g, FIELD_MEAN, i)[k] = spread * rng_normal(rng);
    for (int k = 0; k < 3; k++) gaussiansd_at(g, FIELD_LOG_SCALE, i)[k] = rng_range(rng, -2, 0);
    for (int k = 0; k < 4; k++) gaussiansd_at(g, FIELD_QUAT, i)[k] = rng_normal(rng);
    *gaussiansd_at(g, FIELD_OPACITY_LOGIT, i) = rng_range(rng, -2, 10);
    for (int degree = 0; degree <= SH_DEGREE_MAX; degree++)
        for (int k = 0; k < 3 * (2 * degree + 1); k++)
            gaussiansd_at(g, FIELD_SH0 + degree, i)[k] = rng_normal(rng) * (degree ? 0.3 : 1.5);
}

// What the scenes below contain, counted so that no case goes missing.
typedef struct {
    int clamped_alphas, skipped_alphas, clamped_colours, outside_frustum;
} Cases;

// Where the picture has a kink or a jump, a difference quotient says nothing. Is this splat clear of them by 0.1 %:
// alpha of ALPHA_MIN and of alpha_max at every pixel, x/z and y/z of the frustum's edges, colours of 0? (How far below
// 0 a clamped colour is cannot be seen from here; with the seeds below, far enough.) Adds what it has to *cases.
static bool is_clear_of_kinks(const Scene *scene, int i, Cases *cases) {
    const double clear = 1e-3;
    Splat2 s;
    Cases found = *cases;
    reference_project_forward(&scene->model, i, &scene->camera, &scene->settings, &s);
    if (!s.visible) return false;
    for (int pixel = 0; pixel < WIDTH * HEIGHT; pixel++) {
        double dx = pixel % WIDTH + 0.5 - s.mean_px[0], dy = pixel / WIDTH + 0.5 - s.mean_px[1];
        double alpha = s.opacity * exp(-conic_mahalanobis2(s.conic, dx, dy) / 2);
        double to_min = alpha / (double)ALPHA_MIN - 1, to_max = alpha / (double)scene->settings.alpha_max - 1;
        if (fabs(to_min) < clear || fabs(to_max) < clear) return false;
        found.skipped_alphas += to_min < 0;
        found.clamped_alphas += to_max > 0;
    }
    double edge = 1 + (double)FRUSTUM_MARGIN; // in half pictures from the middle
    double x = fabs(2 * s.mean_px[0] / WIDTH - 1), y = fabs(2 * s.mean_px[1] / HEIGHT - 1);
    if (fabs(x - edge) < clear || fabs(y - edge) < clear) return false;
    found.outside_frustum += (x > edge) + (y > edge);
    for (int c = 0; c < 3; c++) {
        if (s.rgb[c] > 0 && s.rgb[c] < clear) return false;
        found.clamped_colours += s.rgb[c] == 0;
    }
    *cases = found;
    return true;
}

static Scene scene_create(uint64_t seed, RenderWhat what, StopRule stop_rule) {
    Scene scene = {.model = gaussiansd_create(SPLATS, SH_DEGREE_MAX), .settings = render_settings_default()};
    scene.camera = camera_look_at(vec3(1, -2, -4), vec3(0.1, -0.1, 0.2), vec3(0.1, -1, 0), 0.9, WIDTH, HEIGHT);
    scene.settings.what = what;
    scene.settings.stop_rule = stop_rule;
    scene.settings.background[0] = 0.3f, scene.settings.background[2] = 0.8f;
    Rng rng = rng_at(seed, RNG_TEST, 0, 0);
    Cases cases = {0};
    for (int i = 0; i < SPLATS; i++) do {
            draw_splat(&scene.model, i, &rng);
        } while (!is_clear_of_kinks(&scene, i, &cases));
    for (int k = 0; k < VALUES; k++) scene.weight[k] = rng_normal(&rng);
    assert_true(cases.skipped_alphas > 0 && cases.clamped_alphas > 0 && cases.outside_frustum > 0);
    assert_true(cases.clamped_colours > 0);
    return scene;
}

static int opaque_pixels(const Scene *scene) {
    PictureD picture;
    reference_render_forward(&scene->model, &scene->camera, &scene->settings, &picture);
    int count = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) count += picture.transmittance[i] < 10 * (double)TRANSMITTANCE_STOP;
    pictured_destroy(&picture);
    return count;
}

static void check_every_gradient(uint64_t seed, RenderWhat what, StopRule stop_rule) {
    Scene scene = scene_create(seed, what, stop_rule);
    assert_true(opaque_pixels(&scene) > 0);
    GaussiansD d;
    reference_render_backward(&scene.model, &scene.camera, &scene.settings, scene.weight, &d);
    for (GaussianFieldId id = 0; id < FIELD_COUNT; id++) {
        int count = SPLATS * GAUSSIAN_FIELDS[id].width;
        double *expected = mem_alloc((size_t)count, sizeof(double));
        for (int k = 0; k < count; k++)
            expected[k] = difference_central(&scene.model.field[id][k], 2e-5, weighted_picture, &scene);
        char name[64];
        snprintf(name, sizeof name, "%s, seed %d", GAUSSIAN_FIELDS[id].name, (int)seed);
        difference_compare(count, d.field[id], expected, 1e-6, 1e-8, name);
        mem_free(expected);
    }
    gaussiansd_destroy(&d);
    gaussiansd_destroy(&scene.model);
}

static void every_gradient_agrees_with_central_differences(void **state) {
    (void)state;
    check_every_gradient(1, RENDER_COLOUR, STOP_AFTER_BLEND);
}

static void so_it_does_when_it_stops_before_the_blend(void **state) {
    (void)state;
    check_every_gradient(7, RENDER_COLOUR, STOP_BEFORE_BLEND);
}

static void so_it_does_for_depth(void **state) {
    (void)state;
    check_every_gradient(3, RENDER_DEPTH, STOP_AFTER_BLEND);
}

// ---- the Rasterizer table ----

static void the_result_does_not_depend_on_the_threads(void **state) {
    (void)state;
    Scene scene = scene_create(4, RENDER_COLOUR, STOP_AFTER_BLEND);
    GaussiansD d[2];
    for (int k = 0; k < 2; k++) {
        assert_int_equal(setenv("SPLATLAB_THREADS", k ? "4" : "1", 1), 0);
        reference_render_backward(&scene.model, &scene.camera, &scene.settings, scene.weight, &d[k]);
    }
    unsetenv("SPLATLAB_THREADS");
    for (GaussianFieldId id = 0; id < FIELD_COUNT; id++)
        assert_memory_equal(d[0].field[id], d[1].field[id],
                            SPLATS * (size_t)GAUSSIAN_FIELDS[id].width * sizeof(double));
    gaussiansd_destroy(&d[0]);
    gaussiansd_destroy(&d[1]);
    gaussiansd_destroy(&scene.model);
}

static void the_table_gives_the_same_in_floats(void **state) {
    (void)state;
    Scene scene = scene_create(5, RENDER_COLOUR, STOP_AFTER_BLEND);
    Gaussians model = gaussiansd_to_float(&scene.model), d_model;
    GaussiansD rounded = gaussiansd_from(&model), d;
    PictureD precise;
    reference_render_forward(&rounded, &scene.camera, &scene.settings, &precise);
    reference_render_backward(&rounded, &scene.camera, &scene.settings, scene.weight, &d);

    Rasterizer *rasterizer = reference_rasterizer_create();
    Picture picture;
    ImageF d_rgb = imagef_create(WIDTH, HEIGHT, 3);
    for (int k = 0; k < VALUES; k++) d_rgb.values[k] = (float)scene.weight[k];
    assert_true(rasterizer_render(rasterizer, &model, &scene.camera, &scene.settings, &picture));
    assert_true(rasterizer_backward(rasterizer, &model, &scene.camera, &scene.settings, &d_rgb, &d_model));
    for (int k = 0; k < VALUES; k++) support_near(picture.rgb.values[k], precise.rgb[k], 1e-6, "rgb");
    for (int k = 0; k < WIDTH * HEIGHT; k++)
        support_near(picture.alpha.values[k], 1 - precise.transmittance[k], 1e-7, "alpha");
    GaussiansD d_back = gaussiansd_from(&d_model);
    for (GaussianFieldId id = 0; id < FIELD_COUNT; id++) {
        double off = support_relative_l2(d_back.field[id], d.field[id], SPLATS * (size_t)GAUSSIAN_FIELDS[id].width);
        support_near(off, 0, 1e-6, GAUSSIAN_FIELDS[id].name);
    }
    rasterizer_destroy(rasterizer);
    picture_destroy(&picture);
    pictured_destroy(&precise);
    imagef_destroy(&d_rgb);
    gaussians_destroy(&model);
    gaussians_destroy(&d_model);
    gaussiansd_destroy(&rounded);
    gaussiansd_destroy(&d_back);
    gaussiansd_destroy(&d);
    gaussiansd_destroy(&scene.model);
}

// ---- pictures and gradients that others computed ----

static GaussiansD load_model(const char *name) {
    Gaussians g;
    assert_true(ply_load(support_data(name), &g));
    GaussiansD precise = gaussiansd_from(&g);
    gaussians_destroy(&g);
    return precise;
}

// A file of floats, row-major, top row first.
static float *load_floats(const char *name, size_t count) {
    float *values = mem_alloc(count, sizeof(float));
    FILE *file = fopen(support_data(name), "rb");
    assert_non_null(file);
    assert_int_equal(fread(values, sizeof(float), count, file), count);
    fclose(file);
    return values;
}

static const Mat3 IDENTITY = {{1, 0, 0, 0, 1, 0, 0, 0, 1}};

// How the programs that made the pictures render, where that is not our own way.
static RenderSettings settings_of_others(void) {
    RenderSettings settings = render_settings_default();
    settings.alpha_max = 0.999f;
    settings.stop_rule = STOP_BEFORE_BLEND;
    settings.near_depth = 0.01f;
    return settings;
}

static void a_picture_by_gsplat_is_reproduced(void **state) {
    (void)state;
    enum { W = 123, H = 82 };
    GaussiansD g = load_model("reference/tiny_case.ply");
    Camera camera = {.width = W, .height = H, .fx = 61.5, .fy = 61.5, .cx = 61.5, .cy = 41, .rotation = IDENTITY};
    camera.translation = vec3(-0.123, -0.456, 8);
    RenderSettings settings = settings_of_others();
    PictureD picture;
    reference_render_forward(&g, &camera, &settings, &picture);
    float *rgba = load_floats("reference/tiny_case_rgba_f32le.bin", W * H * 4);
    for (int i = 0; i < W * H; i++) {
        for (int c = 0; c < 3; c++) support_near(picture.rgb[3 * i + c], rgba[4 * i + c], 1e-5, "rgb");
        support_near(1 - picture.transmittance[i], rgba[4 * i + 3], 1e-5, "alpha");
    }
    mem_free(rgba);
    pictured_destroy(&picture);
    gaussiansd_destroy(&g);
}

// Before a camera at the origin. All means stand between it and the picture's edges, deeper than 2: near plane and
// frustum clamp have no part in these figures.
static const Camera CAMERA_5K = {
    .width = 270, .height = 480, .fx = 358, .fy = 358, .cx = 135, .cy = 240, .rotation = IDENTITY};

// Has a splat an alpha so near to ALPHA_MIN at this pixel that a program in floats may skip it, or not, where we do
// not?
static bool stands_on_alpha_min(const GaussiansD *g, const RenderSettings *settings, double x, double y) {
    for (int i = 0; i < g->count; i++) {
        Splat2 s;
        reference_project_forward(g, i, &CAMERA_5K, settings, &s);
        double m2 = conic_mahalanobis2(s.conic, x - s.mean_px[0], y - s.mean_px[1]);
        if (s.visible && fabs(s.opacity * exp(-m2 / 2) / (double)ALPHA_MIN - 1) < 1e-4) return true;
    }
    return false;
}

static void a_picture_of_5000_splats_is_reproduced(void **state) {
    (void)state;
    GaussiansD g = load_model("reference/random_5k.ply");
    RenderSettings settings = settings_of_others();
    PictureD picture;
    reference_render_forward(&g, &CAMERA_5K, &settings, &picture);
    size_t pixels = (size_t)picture.width * (size_t)picture.height;
    float *rgb = load_floats("reference/random_5k_270x480_rgb.f32", 3 * pixels);
    double sum = 0;
    int on_alpha_min = 0;
    for (size_t i = 0; i < pixels; i++) {
        double off = 0;
        for (size_t c = 0; c < 3; c++) {
            off = fmax(off, fabs(picture.rgb[3 * i + c] - (double)rgb[3 * i + c]));
            sum += picture.rgb[3 * i + c];
        }
        if (off <= 1e-4) continue;
        size_t column = i % (size_t)picture.width, row = i / (size_t)picture.width;
        support_near(off, 0, (double)ALPHA_MIN, "a splat skipped by one of the two");
        assert_true(stands_on_alpha_min(&g, &settings, (double)column + 0.5, (double)row + 0.5));
        on_alpha_min++;
    }
    assert_in_range(on_alpha_min, 0, 5); // of 129,600
    support_near(sum / (double)(3 * pixels), 0.292749, 5e-7, "mean");
    mem_free(rgb);
    pictured_destroy(&picture);
    gaussiansd_destroy(&g);
}

static double norm_of(const GaussiansD *d, GaussianFieldId first, GaussianFieldId last) {
    double squares = 0;
    for (GaussianFieldId id = first; id <= last; id++)
        for (int k = 0; k < d->count * GAUSSIAN_FIELDS[id].width; k++) squares += d->field[id][k] * d->field[id][k];
    return sqrt(squares);
}

// Gradients of mean(rgb^2) as gsplat's automatic differentiation gives them, to the four digits that were written down.
// There the viewing direction of the spherical harmonics is held fixed, so the mean's gradient lacks that way through.
// To compare, it is computed alone, into `turning`, and taken out.
static void gradients_by_gsplat_are_reproduced(void **state) {
    (void)state;
    GaussiansD g = load_model("reference/random_5k.ply"), d;
    RenderSettings settings = settings_of_others();
    PictureD picture;
    reference_render_forward(&g, &CAMERA_5K, &settings, &picture);
    int values = 3 * picture.width * picture.height;
    double *d_rgb = mem_alloc((size_t)values, sizeof(double));
    for (int k = 0; k < values; k++) d_rgb[k] = 2 * picture.rgb[k] / values;
    reference_render_backward(&g, &CAMERA_5K, &settings, d_rgb, &d);

    GaussiansD turning = gaussiansd_create(g.count, g.sh_degree);
    Splat2 *splats = mem_alloc((size_t)g.count, sizeof(Splat2));
    Splat2Gradient *d_splats = mem_alloc((size_t)g.count, sizeof(Splat2Gradient));
    for (int i = 0; i < g.count; i++) reference_project_forward(&g, i, &CAMERA_5K, &settings, &splats[i]);
    reference_blend_backward(splats, g.count, &settings, picture.width, picture.height, d_rgb, d_splats);
    for (int i = 0; i < g.count; i++)
        reference_colour_backward(&g, i, &CAMERA_5K, &settings, d_splats[i].rgb, &turning);
    assert_true(norm_of(&turning, FIELD_MEAN, FIELD_MEAN) > 1e-5);
    for (int k = 0; k < 3 * g.count; k++) d.field[FIELD_MEAN][k] -= turning.field[FIELD_MEAN][k];

    support_near(norm_of(&d, FIELD_MEAN, FIELD_MEAN), 0.01988, 5e-6, "mean");
    support_near(norm_of(&d, FIELD_LOG_SCALE, FIELD_LOG_SCALE), 0.003338, 5e-7, "log-scale");
    support_near(norm_of(&d, FIELD_QUAT, FIELD_QUAT), 0.003575, 5e-7, "quaternion");
    support_near(norm_of(&d, FIELD_OPACITY_LOGIT, FIELD_OPACITY_LOGIT), 0.001042, 5e-7, "opacity logit");
    support_near(norm_of(&d, FIELD_SH0, FIELD_SH3), 0.005844, 5e-7, "spherical harmonics");
    mem_free(d_rgb);
    mem_free(splats);
    mem_free(d_splats);
    pictured_destroy(&picture);
    gaussiansd_destroy(&turning);
    gaussiansd_destroy(&d);
    gaussiansd_destroy(&g);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_gradient_agrees_with_central_differences),
        cmocka_unit_test(so_it_does_when_it_stops_before_the_blend),
        cmocka_unit_test(so_it_does_for_depth),
        cmocka_unit_test(the_result_does_not_depend_on_the_threads),
        cmocka_unit_test(the_table_gives_the_same_in_floats),
        cmocka_unit_test(a_picture_by_gsplat_is_reproduced),
        cmocka_unit_test(a_picture_of_5000_splats_is_reproduced),
        cmocka_unit_test(gradients_by_gsplat_are_reproduced),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
