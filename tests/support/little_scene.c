#include "tests/support/little_scene.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/base/rng.h"
#include "lab/io/file.h"
#include "lab/io/image_io.h"
#include "splat3d/dataset.h"
#include "splat3d/reference.h"
#include "tests/support/support.h"

#include <math.h>

enum { SPLATS = 24, SEED = 5 };

Gaussians little_scene_model(void) {
    Gaussians model = gaussians_create(SPLATS, 1);
    for (int i = 0; i < SPLATS; i++) {
        Rng rng = rng_at(SEED, RNG_TEST, 0, (uint32_t)i);
        for (int k = 0; k < 3; k++) {
            gaussians_at(&model, FIELD_MEAN, i)[k] = (float)rng_range(&rng, -0.7, 0.7);
            gaussians_at(&model, FIELD_LOG_SCALE, i)[k] = (float)rng_range(&rng, -2.5, -1.2);
            gaussians_at(&model, FIELD_SH0, i)[k] = (float)rng_range(&rng, -1.2, 1.2);
        }
        for (int k = 0; k < 4; k++) gaussians_at(&model, FIELD_QUAT, i)[k] = (float)rng_normal(&rng);
        for (int k = 0; k < 9; k++) gaussians_at(&model, FIELD_SH1, i)[k] = (float)rng_range(&rng, -0.1, 0.1);
        gaussians_at(&model, FIELD_OPACITY_LOGIT, i)[0] = (float)rng_range(&rng, 0, 3);
    }
    return model;
}

Camera little_scene_camera(int view) {
    double angle_rad = 2 * M_PI * view / LITTLE_VIEWS;
    Vec3 eye = vec3(4 * cos(angle_rad), 1.2, 4 * sin(angle_rad));
    return camera_look_at(eye, vec3(0, 0, 0), vec3(0, 1, 0), 0.6, LITTLE_WIDTH, LITTLE_HEIGHT);
}

static void write_view(const Gaussians *model, const Camera *camera, const char *path) {
    Rasterizer *reference = reference_rasterizer_create();
    RenderSettings settings = render_settings_default();
    Picture picture;
    assert_true(rasterizer_render(reference, model, camera, &settings, &picture));
    if (!image_savef(path, &picture.rgb)) fail_msg("%s", fail_text());
    picture_destroy(&picture);
    rasterizer_destroy(reference);
}

void little_scene_write(const char *folder) {
    Gaussians model = little_scene_model();
    Dataset dataset = {.view_count = LITTLE_VIEWS, .downscale = 1};
    dataset.views = mem_alloc(LITTLE_VIEWS, sizeof *dataset.views);
    dataset.points = points_create(SPLATS);
    for (int i = 0; i < 3 * SPLATS; i++) dataset.points.xyz[i] = model.field[FIELD_MEAN][i];
    char *images = file_join(folder, "images");
    assert_true(file_make_folder(images));
    for (int v = 0; v < LITTLE_VIEWS; v++) {
        char *name = mem_format("view_%d.png", v);
        char *path = file_join(images, name);
        dataset.views[v] = (View){.name = name, .path = path, .camera = little_scene_camera(v), .channels = 3};
        write_view(&model, &dataset.views[v].camera, path);
    }
    if (!colmap_write(folder, &dataset)) fail_msg("%s", fail_text());
    dataset_destroy(&dataset);
    gaussians_destroy(&model);
    mem_free(images);
}
