#include "splat3d/sample_scene.h"

#include "lab/base/fail.h"
#include "lab/base/interrupt.h"
#include "lab/base/mem.h"
#include "lab/base/progress.h"
#include "lab/io/file.h"
#include "lab/io/image_io.h"
#include "splat3d/dataset.h"
#include "splat3d/ray_light.h"
#include "splat3d/ray_tracer.h"
#include "splat3d/scene_folder.h"
#include "splat3d/scene_kinds.h"
#include "splat3d/scene_points.h"

#include <string.h>

static const SampleSceneInfo SCENES[] = {
    {"studio", "textured and glossy things on a table: colour that depends on the view"},
    {"fence", "thin tilted slats and wires in a garden: long, narrow splats"},
    {"courtyard", "a fountain, plants and houses out to the hills: an unbounded scene"},
};
static SceneBuilder *const BUILDERS[] = {scene_studio_build, scene_fence_build, scene_courtyard_build};
enum { SCENE_COUNT = sizeof SCENES / sizeof SCENES[0] };

enum { SIDE_MIN = 32, SIDE_MAX = 8192, VIEWS_MIN = 3, VIEWS_MAX = 10000 };

SampleSceneOptions sample_scene_options_default(void) {
    return (SampleSceneOptions){.size = {640, 480}, .views = 64, .seed = 1};
}

const SampleSceneInfo *sample_scene_list(int *count) {
    *count = SCENE_COUNT;
    return SCENES;
}

static bool find_scene(const char *name, int *scene) {
    for (*scene = 0; *scene < SCENE_COUNT; ++*scene)
        if (strcmp(SCENES[*scene].name, name) == 0) return true;
    char known[256] = "";
    for (int i = 0; i < SCENE_COUNT; i++) {
        strncat(known, i ? ", " : "", sizeof known - strlen(known) - 1);
        strncat(known, SCENES[i].name, sizeof known - strlen(known) - 1);
    }
    return fail_usage("there is no sample scene '%s'; there are %s", name, known);
}

static bool check_options(const SampleSceneOptions *o) {
    for (int i = 0; i < 2; i++)
        if (o->size[i] < SIDE_MIN || o->size[i] > SIDE_MAX)
            return fail_usage("sample scene: size %dx%d px; each side must be %d to %d", o->size[0], o->size[1],
                              SIDE_MIN, SIDE_MAX);
    if (o->views < VIEWS_MIN || o->views > VIEWS_MAX)
        return fail_usage("sample scene: %d views; want %d to %d", o->views, VIEWS_MIN, VIEWS_MAX);
    return true;
}

// Finer pictures get finer surfaces, textures and light.
static void build_scene(SceneBuilder *builder, const SampleSceneOptions *o, RayScene *scene, ScenePath *path) {
    SceneRequest request = {.seed = o->seed, .detail = fmin(fmax(o->size[0] / 640.0, 0.1), 1), .texture_size = 128};
    while (request.texture_size < o->size[0] && request.texture_size < 2048) request.texture_size *= 2;
    builder(&request, scene, path);
    scene->bvh = ray_bvh_build(&scene->mesh);
}

static bool save_view(View *view, const char *folder, int index, const ImageF *rgb, const ImageF *depth) {
    char *name = mem_format("view_%04d.png", index), *depth_name = mem_format("depth/view_%04d.exr", index);
    char *images = file_join(folder, "images"), *depth_path = file_join(folder, depth_name);
    view->name = name;
    view->path = file_join(images, name);
    view->channels = 3;
    view->held_out = index % HELD_OUT_EVERY == 0;
    view->image = image8_from_float(rgb);
    bool ok = image_save8(view->path, &view->image) && image_savef(depth_path, depth);
    mem_free(depth_name);
    mem_free(images);
    mem_free(depth_path);
    return ok;
}

// Renders all views into dataset->views and depth, saving each.
static bool render_views(const RayScene *scene, const ScenePath *path, const SampleSceneOptions *o, const char *folder,
                         Dataset *dataset, ImageF *depth) {
    Progress progress = progress_begin("views", 0, o->views);
    bool ok = true;
    for (int i = 0; ok && i < o->views; i++) {
        if (interrupt_requested()) {
            ok = fail("stopped after %d of %d views; the unfinished scene in %s was removed", i, o->views, folder);
            break;
        }
        View *view = &dataset->views[dataset->view_count++];
        view->camera = scene_path_camera(path, o->seed, i, o->views, o->size[0], o->size[1]);
        ImageF rgb;
        ray_tracer_picture(scene, &view->camera, o->seed, i, &rgb, &depth[i]);
        ok = save_view(view, folder, i, &rgb, &depth[i]);
        imagef_destroy(&rgb);
        progress_update(&progress, i + 1, NULL);
    }
    progress_end(&progress, NULL);
    return ok;
}

static bool write_readme(int scene, const SampleSceneOptions *o, const Dataset *dataset, const char *folder) {
    char *text = mem_format(
        "%s: %s.\n\n"
        "Made by `splatlab scene %s -o DIR --size %dx%d --views %d --seed %llu`; the same command gives the same "
        "files.\n\n"
        "- images/view_NNNN.png: %d pictures, 8-bit sRGB; every %dth (0000, 0008, ...) is meant to be held out of "
        "training\n"
        "- depth/view_NNNN.exr: true camera z at each pixel's centre, 32-bit float, 1 unit is about 1 metre; 0 is sky\n"
        "- sparse/0: cameras, poses and %d points as a COLMAP model (binary, PINHOLE, no tracks)\n"
        "- transforms.json: the same cameras for programs that read nerfstudio's format\n\n"
        "Cameras are exact. The points imitate structure from motion: corners of the pictures at their true depth, "
        "with the noise of\n"
        "triangulation and %.0f %% of outliers. The world is z up. Nothing in it is photographed; you may use it as "
        "you like.\n",
        SCENES[scene].name, SCENES[scene].shows, SCENES[scene].name, o->size[0], o->size[1], o->views,
        (unsigned long long)o->seed, o->views, HELD_OUT_EVERY, dataset->points.count, 100 * SCENE_OUTLIER_PART);
    bool ok = scene_folder_finish(folder, text);
    mem_free(text);
    return ok;
}

static bool write_models(const char *folder, const Dataset *dataset) {
    char *path = file_join(folder, "transforms.json");
    bool ok = colmap_write(folder, dataset) && transforms_write(path, dataset);
    mem_free(path);
    return ok;
}

// Everything after the folder is there.
static bool fill_folder(int scene_index, const SampleSceneOptions *o, const char *folder) {
    RayScene *scene = mem_alloc(1, sizeof *scene);
    ScenePath path;
    Dataset dataset = {.views = mem_alloc((size_t)o->views, sizeof(View))};
    ImageF *depth = mem_alloc((size_t)o->views, sizeof(ImageF));
    build_scene(BUILDERS[scene_index], o, scene, &path);
    int quality = o->size[0] >= 512 ? 8 : o->size[0] >= 256 ? 6 : o->size[0] >= 128 ? 4 : 2;
    bool ok = ray_light_store(scene, quality, o->seed) && render_views(scene, &path, o, folder, &dataset, depth);
    if (ok) {
        dataset.points = scene_points_find(dataset.views, depth, o->views, o->seed);
        ok = write_models(folder, &dataset) && write_readme(scene_index, o, &dataset, folder);
    }
    for (int i = 0; i < o->views; i++) imagef_destroy(&depth[i]);
    mem_free(depth);
    dataset_destroy(&dataset);
    ray_scene_destroy(scene);
    mem_free(scene);
    return ok;
}

bool sample_scene_write(const char *name, const SampleSceneOptions *options, const char *folder) {
    int scene;
    if (!find_scene(name, &scene) || !check_options(options) || !scene_folder_begin(folder)) return false;
    if (fill_folder(scene, options, folder)) return true;
    scene_folder_remove(folder);
    return false;
}
