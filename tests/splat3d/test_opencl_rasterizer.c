// Pictures of both blend shapes against the double-precision reference, and what must hold of any picture.

#include "splat3d/opencl_rasterizer.h"

#include "lab/base/fail.h"
#include "splat3d/reference.h"
#include "tests/support/random_scene.h"
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// Measured: 6e-6 where no alpha lies on the cut at ALPHA_MIN; there, single pixels may differ by one skipped splat.
static const double TOLERANCE = 4e-5;
static const double SKIPPED_SPLAT = 0.03;
enum { PIXELS_PER_SKIP = 500 };

typedef struct {
    Gpu *gpu;
    OpenclRasterizer *shape[2]; // BLEND_CPU, BLEND_GPU
    Rasterizer *reference;
} Renderers;

static int create_renderers(void **state) {
    static Renderers r;
    *state = &r;
    if (!gpu_open("", &r.gpu) || !opencl_rasterizer_create(r.gpu, BLEND_CPU, &r.shape[0]) ||
        !opencl_rasterizer_create(r.gpu, BLEND_GPU, &r.shape[1])) {
        print_error("%s\n", fail_text());
        return -1;
    }
    r.reference = reference_rasterizer_create();
    return 0;
}

static int destroy_renderers(void **state) {
    Renderers *r = *state;
    opencl_rasterizer_destroy(r->shape[0]);
    opencl_rasterizer_destroy(r->shape[1]);
    rasterizer_destroy(r->reference);
    gpu_close(r->gpu);
    return 0;
}

static Picture render(Rasterizer *rasterizer, const Gaussians *model, const Camera *camera,
                      const RenderSettings *settings) {
    Picture picture;
    if (!rasterizer_render(rasterizer, model, camera, settings, &picture)) fail_msg("%s", fail_text());
    return picture;
}

static void check_image(const ImageF *actual, const ImageF *expected, double scale, const char *what) {
    const size_t pixels = (size_t)expected->width * (size_t)expected->height;
    size_t skipped = 0;
    assert_int_equal(actual->width, expected->width);
    assert_int_equal(actual->height, expected->height);
    for (size_t k = 0; k < pixels * (size_t)expected->channels; k++) {
        const double error = fabs(actual->values[k] - expected->values[k]);
        if (!(error <= SKIPPED_SPLAT * scale))
            fail_msg("%s: value %zu is %g, expected %g", what, k, actual->values[k], expected->values[k]);
        skipped += error > TOLERANCE * scale;
    }
    if (skipped > pixels / PIXELS_PER_SKIP) fail_msg("%s: %zu values of %zu pixels differ", what, skipped, pixels);
}

// Both shapes against the reference. scale: size of the values.
static void check_scene(Renderers *r, const Gaussians *model, const Camera *camera, const RenderSettings *settings,
                        double scale) {
    Picture expected = render(r->reference, model, camera, settings);
    for (int s = 0; s < 2; s++) {
        Picture actual = render(opencl_rasterizer_interface(r->shape[s]), model, camera, settings);
        check_image(&actual.rgb, &expected.rgb, scale, s ? "rgb, GPU shape" : "rgb, CPU shape");
        check_image(&actual.alpha, &expected.alpha, 1, s ? "alpha, GPU shape" : "alpha, CPU shape");
        picture_destroy(&actual);
    }
    picture_destroy(&expected);
}

static void pictures_of_any_size_and_degree_agree_with_the_reference(void **state) {
    static const int SIZES[][2] = {{64, 48}, {101, 77}, {17, 33}, {1, 1}, {16, 16}, {15, 1}, {3, 70}};
    for (uint32_t seed = 1; seed <= 7; seed++) {
        print_message("seed %u\n", seed);
        RandomScene scene = random_scene_default(seed);
        const Camera camera = random_scene_camera(seed, SIZES[seed - 1][0], SIZES[seed - 1][1]);
        RenderSettings settings = render_settings_default();
        scene.sh_degree = (int)seed % 4;
        settings.background[0] = 0.3f, settings.background[1] = 0.9f, settings.background[2] = 0.5f;
        Gaussians model = random_scene_gaussians(&scene, &camera);
        check_scene(*state, &model, &camera, &settings, 1);
        settings.what = RENDER_DEPTH;
        check_scene(*state, &model, &camera, &settings, 8);
        gaussians_destroy(&model);
    }
}

static void crowded_opaque_and_large_splats_agree_with_the_reference(void **state) {
    for (uint32_t seed = 11; seed <= 13; seed++) {
        print_message("seed %u\n", seed);
        RandomScene scene = random_scene_default(seed);
        const Camera camera = random_scene_camera(seed, 50, 60);
        const RenderSettings settings = render_settings_default();
        scene.count = 3000;
        if (seed == 11) scene.logit_high = 12; // alphas at the clamp, lists far longer than a batch
        if (seed == 12) scene.size_px = 60, scene.logit_high = -2;
        if (seed == 13) scene.spread = 2.5, scene.outside = 5; // needles, J clamped outside of the picture
        Gaussians model = random_scene_gaussians(&scene, &camera);
        check_scene(*state, &model, &camera, &settings, 1);
        gaussians_destroy(&model);
    }
}

static void settings_change_the_picture_as_they_change_the_reference(void **state) {
    const RandomScene scene = random_scene_default(21);
    const Camera camera = random_scene_camera(21, 60, 40);
    Gaussians model = random_scene_gaussians(&scene, &camera);
    RenderSettings settings = render_settings_default();
    settings.alpha_max = 0.5f;
    check_scene(*state, &model, &camera, &settings, 1);
    settings.near_depth = 3;
    check_scene(*state, &model, &camera, &settings, 1);
    settings.low_pass_px2 = 2;
    check_scene(*state, &model, &camera, &settings, 1);
    gaussians_destroy(&model);
}

static void a_lower_degree_reads_the_lower_fields_only(void **state) {
    Renderers *r = *state;
    RandomScene scene = random_scene_default(31);
    const Camera camera = random_scene_camera(31, 48, 32);
    Gaussians rich = random_scene_gaussians(&scene, &camera);
    RenderSettings settings = render_settings_default();
    settings.sh_degree = 1;
    for (int k = 0; k < rich.count * GAUSSIAN_FIELDS[FIELD_SH2].width; k++) rich.field[FIELD_SH2][k] = NAN;
    check_scene(r, &rich, &camera, &settings, 1);
    gaussians_destroy(&rich);
}

static void a_scene_without_splats_shows_the_background(void **state) {
    Renderers *r = *state;
    const Camera camera = random_scene_camera(1, 35, 20);
    RandomScene scene = random_scene_default(1);
    RenderSettings settings = render_settings_default();
    settings.background[1] = 0.25f;
    settings.near_depth = 1000; // everything is nearer
    Gaussians none = gaussians_create(0, 2), behind = random_scene_gaussians(&scene, &camera);
    const Gaussians *const models[] = {&none, &behind};
    for (int m = 0; m < 2; m++)
        for (int s = 0; s < 2; s++) {
            Picture picture = render(opencl_rasterizer_interface(r->shape[s]), models[m], &camera, &settings);
            assert_int_equal(opencl_frame_counts(r->shape[s]).visible, 0);
            assert_int_equal(opencl_frame_counts(r->shape[s]).pairs, 0);
            for (int k = 0; k < 35 * 20; k++) {
                assert_true(picture.rgb.values[3 * k] == 0 && picture.rgb.values[3 * k + 1] == 0.25f);
                assert_true(picture.alpha.values[k] == 0);
            }
            picture_destroy(&picture);
        }
    gaussians_destroy(&none);
    gaussians_destroy(&behind);
}

// Splats that no picture can show, or only just: each must leave picture and gradients finite.
static void break_splats(Gaussians *model) {
    static const float LOGITS[] = {-1000, 1000, -5.5412f, 90, -90};
    for (int i = 0; i + 9 < model->count; i += 10) {
        memset(gaussians_at(model, FIELD_QUAT, i), 0, 4 * sizeof(float));
        gaussians_at(model, FIELD_LOG_SCALE, i + 1)[i / 10 % 3] = 100;
        gaussians_at(model, FIELD_LOG_SCALE, i + 2)[i / 10 % 3] = -100;
        gaussians_at(model, FIELD_LOG_SCALE, i + 3)[0] = 12;
        *gaussians_at(model, FIELD_OPACITY_LOGIT, i + 4) = LOGITS[i / 10 % 5];
        gaussians_at(model, FIELD_QUAT, i + 5)[1] = 1e20f;
        gaussians_at(model, FIELD_MEAN, i + 6)[0] = 1e30f;
        for (int k = 0; k < 4; k++) gaussians_at(model, FIELD_QUAT, i + 7)[k] *= 1e-12f;
        gaussians_at(model, FIELD_MEAN, i + 8)[2] = NAN;
        gaussians_at(model, FIELD_LOG_SCALE, i + 9)[1] = NAN;
    }
}

static void degenerate_splats_leave_everything_finite(void **state) {
    Renderers *r = *state;
    for (uint32_t seed = 41; seed <= 43; seed++) {
        print_message("seed %u\n", seed);
        const RandomScene scene = random_scene_default(seed);
        Camera camera = random_scene_camera(seed, 40, 50);
        const RenderSettings settings = render_settings_default();
        Gaussians model = random_scene_gaussians(&scene, &camera), d_model;
        break_splats(&model);
        const Vec3 eye = camera_position(&camera);
        gaussians_at(&model, FIELD_MEAN, 3)[0] = (float)eye.x; // in the camera itself
        gaussians_at(&model, FIELD_MEAN, 3)[1] = (float)eye.y;
        gaussians_at(&model, FIELD_MEAN, 3)[2] = (float)eye.z;
        ImageF d_rgb = imagef_create(camera.width, camera.height, 3);
        random_scene_values(seed, d_rgb.values, (size_t)(camera.width * camera.height * 3));
        for (int s = 0; s < 2; s++) {
            Rasterizer *rasterizer = opencl_rasterizer_interface(r->shape[s]);
            Picture picture = render(rasterizer, &model, &camera, &settings);
            for (int k = 0; k < camera.width * camera.height * 3; k++) assert_true(isfinite(picture.rgb.values[k]));
            if (!rasterizer_backward(rasterizer, &model, &camera, &settings, &d_rgb, &d_model))
                fail_msg("%s", fail_text());
            int splat = -1;
            GaussianFieldId id = 0;
            if (!gaussians_are_finite(&d_model, &splat, &id))
                fail_msg("gradient by %s of splat %d is not finite", GAUSSIAN_FIELDS[id].name, splat);
            gaussians_destroy(&d_model);
            picture_destroy(&picture);
        }
        imagef_destroy(&d_rgb);
        gaussians_destroy(&model);
    }
}

static void unknown_settings_are_refused(void **state) {
    Renderers *r = *state;
    Gaussians model = gaussians_create(1, 0);
    const Camera camera = random_scene_camera(1, 20, 20);
    RenderSettings settings = render_settings_default();
    Picture picture;
    settings.stop_rule = STOP_BEFORE_BLEND;
    assert_false(rasterizer_render(opencl_rasterizer_interface(r->shape[0]), &model, &camera, &settings, &picture));
    assert_non_null(strstr(fail_text(), "C reference"));
    gaussians_destroy(&model);
}

static void a_held_model_is_copied_once_and_let_go(void **state) {
    Renderers *r = *state;
    const RandomScene scene = random_scene_default(61);
    const Camera camera = random_scene_camera(61, 40, 30);
    const RenderSettings settings = render_settings_default();
    const size_t bytes = 40 * 30 * 3 * sizeof(float);
    Gaussians model = random_scene_gaussians(&scene, &camera), other = gaussians_create(3, 0);
    Rasterizer *rasterizer = opencl_rasterizer_interface(r->shape[0]);
    Picture first = render(rasterizer, &model, &camera, &settings);
    assert_true(rasterizer_hold(rasterizer, &model));
    for (int i = 0; i < model.count; i++) *gaussians_at(&model, FIELD_OPACITY_LOGIT, i) = -3;
    Picture held = render(rasterizer, &model, &camera, &settings); // of the copy: the change is not seen
    assert_memory_equal(held.rgb.values, first.rgb.values, bytes);
    assert_true(rasterizer_hold(rasterizer, NULL));
    Picture fresh = render(rasterizer, &model, &camera, &settings);
    assert_memory_not_equal(fresh.rgb.values, first.rgb.values, bytes);

    // Another model in between is taken as it is, and lets go too.
    assert_true(rasterizer_hold(rasterizer, &model));
    Picture none = render(rasterizer, &other, &camera, &settings);
    Picture again = render(rasterizer, &model, &camera, &settings);
    assert_memory_not_equal(none.rgb.values, fresh.rgb.values, bytes);
    assert_memory_equal(again.rgb.values, fresh.rgb.values, bytes);
    assert_true(rasterizer_hold(rasterizer, NULL) && rasterizer_hold(r->reference, &model));
    Picture *pictures[] = {&first, &held, &fresh, &none, &again};
    for (int i = 0; i < 5; i++) picture_destroy(pictures[i]);
    gaussians_destroy(&model);
    gaussians_destroy(&other);
}

// ---- the same bytes, whatever the number of threads ----

static uint64_t hash(uint64_t h, const float *values, size_t count) {
    const unsigned char *bytes = (const unsigned char *)values;
    for (size_t k = 0; k < count * sizeof(float); k++) h = (h ^ bytes[k]) * 0x100000001b3u; // FNV-1a
    return h;
}

static uint64_t hash_of_frame(OpenclRasterizer *r) {
    RandomScene scene = random_scene_default(51);
    scene.count = 20000;
    const Camera camera = random_scene_camera(51, 200, 150);
    const RenderSettings settings = render_settings_default();
    Gaussians model = random_scene_gaussians(&scene, &camera), d_model;
    ImageF d_rgb = imagef_create(200, 150, 3);
    random_scene_values(51, d_rgb.values, 200 * 150 * 3);
    Picture picture = render(opencl_rasterizer_interface(r), &model, &camera, &settings);
    assert_true(rasterizer_backward(opencl_rasterizer_interface(r), &model, &camera, &settings, &d_rgb, &d_model));
    uint64_t h = hash(0xcbf29ce484222325u, picture.rgb.values, 200 * 150 * 3);
    for (int id = 0; id < FIELD_COUNT; id++)
        h = hash(h, d_model.field[id], (size_t)scene.count * (size_t)GAUSSIAN_FIELDS[id].width);
    gaussians_destroy(&d_model);
    gaussians_destroy(&model);
    imagef_destroy(&d_rgb);
    picture_destroy(&picture);
    return h;
}

// Run as a program of its own with "hash": prints the two shapes' hashes.
static int print_hashes(void) {
    void *state;
    if (create_renderers(&state)) return 1;
    Renderers *r = state;
    printf("%016llx %016llx\n", (unsigned long long)hash_of_frame(r->shape[0]),
           (unsigned long long)hash_of_frame(r->shape[1]));
    return destroy_renderers(&state);
}

static void picture_and_gradients_are_the_same_bytes_with_one_thread_and_with_more(void **state) {
    Renderers *r = *state;
    char program[4000], expected[64], line[64] = "";
    const ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    assert_true(length > 0);
    program[length] = 0;
    snprintf(expected, sizeof expected, "%016llx %016llx\n", (unsigned long long)hash_of_frame(r->shape[0]),
             (unsigned long long)hash_of_frame(r->shape[1]));
    for (int threads = 1; threads <= 3; threads++) {
        char command[4200];
        snprintf(command, sizeof command, "POCL_MAX_PTHREAD_COUNT=%d '%s' hash", threads, program);
        FILE *pipe = popen(command, "r");
        assert_non_null(pipe);
        assert_non_null(fgets(line, sizeof line, pipe));
        assert_int_equal(pclose(pipe), 0);
        assert_string_equal(line, expected);
    }
}

int main(int argc, char **argv) {
    if (argc == 2 && !strcmp(argv[1], "hash")) return print_hashes();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_of_any_size_and_degree_agree_with_the_reference),
        cmocka_unit_test(crowded_opaque_and_large_splats_agree_with_the_reference),
        cmocka_unit_test(settings_change_the_picture_as_they_change_the_reference),
        cmocka_unit_test(a_lower_degree_reads_the_lower_fields_only),
        cmocka_unit_test(a_scene_without_splats_shows_the_background),
        cmocka_unit_test(degenerate_splats_leave_everything_finite),
        cmocka_unit_test(unknown_settings_are_refused),
        cmocka_unit_test(a_held_model_is_copied_once_and_let_go),
        cmocka_unit_test(picture_and_gradients_are_the_same_bytes_with_one_thread_and_with_more),
    };
    return cmocka_run_group_tests(tests, create_renderers, destroy_renderers);
}
