// cmd_render.c - `splatlab render`: pictures of a model, from a view of its scene, a camera file, or all round.
#include "exercises/harness/mine_rasterizer.h"
#include "lab/app/commands.h"
#include "lab/app/frame.h"
#include "lab/app/model_source.h"
#include "lab/app/orbit.h"
#include "lab/app/output_path.h"
#include "lab/app/renderer.h"
#include "lab/base/fail.h"
#include "lab/base/interrupt.h"
#include "lab/base/log.h"
#include "lab/base/mem.h"
#include "lab/base/nearest.h"
#include "lab/base/progress.h"
#include "lab/io/file.h"
#include "lab/io/image_io.h"
#include "lab/io/json_io.h"
#include "splat3d/background.h"
#include "splat3d/ply.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct {
    char output[OPTION_TEXT_BYTES];
    char scene[OPTION_TEXT_BYTES];
    char view[OPTION_TEXT_BYTES];
    char camera[OPTION_TEXT_BYTES];
    int orbit; // frames
    int downscale;
    char background[OPTION_TEXT_BYTES];
    bool depth, alpha;
    bool reference, mine;
    double alpha_max;
    int stop; // StopRule
    char device[OPTION_TEXT_BYTES];
    char kernels[OPTION_TEXT_BYTES];
    bool quiet, json;
} Options;

static const char *const STOPS[] = {"after", "before", NULL}; // in StopRule's order

static const OptionField FIELDS[] = {
    {.name = "output",
     .letter = 'o',
     .type = OPTION_TEXT,
     .offset = offsetof(Options, output),
     .help = ".png or .jpg (8 bit) or .exr (float); an orbit adds numbers: out.png, out_0000.png, ...",
     .section = "Output"},
    {.name = "depth",
     .type = OPTION_FLAG,
     .offset = offsetof(Options, depth),
     .help = "depth instead of colour: world units in .exr (0: nothing there), nearer is brighter in .png"},
    {.name = "alpha",
     .type = OPTION_FLAG,
     .offset = offsetof(Options, alpha),
     .help = "alpha as fourth channel, and no background"},
    {.name = "background",
     .type = OPTION_TEXT,
     .offset = offsetof(Options, background),
     .help = "white, black or r,g,b in 0..1; a run brings its own"},
    {OPTION_JSON_OF(Options, "the list of files")},
    {OPTION_QUIET_OF(Options)},
    {.name = "scene",
     .type = OPTION_TEXT,
     .offset = offsetof(Options, scene),
     .help = "folder of the scene, for --view and --orbit; a run knows its own",
     .section = "From where (one of --view, --camera, --orbit)"},
    {.name = "view",
     .type = OPTION_TEXT,
     .offset = offsetof(Options, view),
     .help = "name of a view of the scene, with or without its ending"},
    {.name = "camera",
     .type = OPTION_TEXT,
     .offset = offsetof(Options, camera),
     .help =
         "a .json file: width height fx fy cx cy world_to_camera (16 numbers, row-major; x right, y down, z forward)"},
    {.name = "orbit",
     .type = OPTION_INT,
     .offset = offsetof(Options, orbit),
     .low = 0,
     .high = 100000,
     .unit = "frames",
     .help = "one turn round what the scene's cameras look at"},
    {.name = "downscale",
     .type = OPTION_INT,
     .offset = offsetof(Options, downscale),
     .low = 1,
     .high = 64,
     .unit = "times",
     .help = "pictures at 1/K of the camera's size; a run brings its own for its scene"},
    {.name = "reference",
     .type = OPTION_FLAG,
     .offset = offsetof(Options, reference),
     .help = "the double-precision C reference: slow, needs no device",
     .section = "How to render"},
    {.name = "mine",
     .type = OPTION_FLAG,
     .offset = offsetof(Options, mine),
     .help = "by your own functions, those of the exercises that pass, and the C reference: slow, needs no device"},
    {.name = "alpha-max",
     .type = OPTION_DOUBLE,
     .offset = offsetof(Options, alpha_max),
     .low = 0.5,
     .high = 1,
     .help = "a splat's alpha is clamped to this; others' programs use 0.999"},
    {.name = "stop",
     .type = OPTION_CHOICE,
     .offset = offsetof(Options, stop),
     .choices = STOPS,
     .help =
         "is the splat that makes a pixel opaque still blended: after it (ours), or stopped before it (the original "
         "program's rule; only with --reference)"},
    {OPTION_DEVICE_OF(Options)},
    {OPTION_KERNELS_OF(Options)},
};

static const char *const ENDINGS[] = {".png", ".exr", ".jpg", NULL};

// All that rendering holds on to; job_close() accepts it half-built.
typedef struct {
    Options options;
    ModelSource source;
    Dataset dataset; // with --view and --orbit
    Gaussians model;
    Mine *mine; // with --mine
    Renderer renderer;
    RenderSettings settings;
    Camera camera; // of the single picture
    Orbit orbit;
    json_t *files; // written so far
} Job;

static void job_close(Job *job) {
    json_decref(job->files);
    renderer_close(&job->renderer);
    mine_close(job->mine);
    gaussians_destroy(&job->model);
    dataset_destroy(&job->dataset);
    model_source_forget(&job->source);
}

// ---- what is asked for ----

static bool check_usage(const Options *o) {
    int places = (o->view[0] != 0) + (o->camera[0] != 0) + (o->orbit > 0);
    if (places != 1)
        return fail_usage("render: from where? give one of --view NAME, --camera CAM.json and --orbit N%s",
                          places ? ", not several" : "");
    if (!o->camera[0] && !o->scene[0])
        return fail_usage("render: %s needs the scene's folder: --scene SCENE", o->orbit ? "--orbit" : "--view");
    if (!o->output[0]) return fail_usage("render: where to? -o OUT.png");
    if (o->mine && (o->depth || o->alpha))
        return fail_usage("render: --mine makes colour pictures; leave --depth and --alpha away");
    if (o->mine && o->reference) return fail_usage("render: --mine or --reference, not both");
    if (o->depth && o->alpha) return fail_usage("render: --depth and --alpha are two pictures; ask for one at a time");
    if (o->alpha && file_has_ending(o->output, ".jpg"))
        return fail_usage("render: --output %s: a JPEG has no alpha; want .png or .exr", o->output);
    if (o->stop == STOP_BEFORE_BLEND && !o->reference)
        return fail_usage("render: --stop before is known to the C reference only; add --reference");
    return true;
}

static bool fail_no_view(const Dataset *dataset, const char *name) {
    enum { NEAREST_MAX = 3 };
    const char **names = mem_alloc((size_t)dataset->view_count, sizeof *names);
    int best[NEAREST_MAX];
    char near[512] = "";
    for (int i = 0; i < dataset->view_count; i++) names[i] = dataset->views[i].name;
    int found = nearest_find(name, names, dataset->view_count, best, NEAREST_MAX);
    for (int i = 0; i < found; i++) {
        size_t length = strlen(near);
        snprintf(near + length, sizeof near - length, "%s%s", i ? ", " : "", names[best[i]]);
    }
    if (found)
        fail("%s has no view '%s'; nearest: %s", dataset->path, name, near);
    else
        fail("%s has no view '%s'; its %d views go from %s to %s", dataset->path, name, dataset->view_count, names[0],
             names[dataset->view_count - 1]);
    mem_free(names);
    return false;
}

static bool find_camera(Job *job) {
    const Options *o = &job->options;
    if (o->camera[0]) {
        if (!camera_load_json(o->camera, &job->camera)) return false;
        int width = job->camera.width / o->downscale, height = job->camera.height / o->downscale;
        if (width < 1 || height < 1)
            return fail("%s: %dx%d px leave nothing at --downscale %d", o->camera, job->camera.width,
                        job->camera.height, o->downscale);
        job->camera = camera_resized(&job->camera, width, height);
        return true;
    }
    if (!dataset_open(o->scene, o->downscale, &job->dataset)) return false;
    if (o->orbit) {
        job->orbit = orbit_of_scene(&job->dataset);
        return true;
    }
    const View *view = dataset_find_view(&job->dataset, o->view);
    if (!view) return fail_no_view(&job->dataset, o->view);
    job->camera = view->camera;
    return true;
}

// Says whose function each stage is.
static bool open_mine(Job *job) {
    job->mine = mine_open();
    if (!job->mine) return false;
    for (MinePart part = MINE_CONIC; part < MINE_COUNT; part++) {
        char text[MINE_STATE_BYTES];
        mine_state(job->mine, part, text);
        log_info("%s", text);
    }
    job->renderer.rasterizer = mine_rasterizer_create(job->mine);
    return true;
}

// Everything that can be refused is refused before the first picture.
static bool job_open(Job *job) {
    const Options *o = &job->options;
    bool is_random;
    job->settings = render_settings_default();
    job->settings.alpha_max = (float)o->alpha_max;
    job->settings.stop_rule = (StopRule)o->stop;
    if (!check_usage(o) || !background_parse(o->background, job->settings.background, &is_random)) return false;
    if (!output_path_check("output", o->output, ENDINGS)) return false;
    if (!find_camera(job)) return false;
    if (!ply_load(job->source.path, &job->model)) return false;
    if (o->mine) return open_mine(job);
    return renderer_open(o->reference, o->device, o->kernels, &job->renderer);
}

// ---- pictures ----

static bool write_picture(Job *job, const Camera *camera, const char *path) {
    const Options *o = &job->options;
    FrameKind kind = o->depth ? FRAME_DEPTH : o->alpha ? FRAME_ALPHA : FRAME_COLOUR;
    ImageF image;
    if (!frame_render(job->renderer.rasterizer, &job->model, camera, &job->settings, kind, &image)) return false;
    if (kind == FRAME_DEPTH && !file_has_ending(path, ".exr")) frame_normalise_depth(&image);
    bool good = image_savef(path, &image);
    imagef_destroy(&image);
    if (good) json_array_append_new(job->files, json_text(path));
    if (good && !o->json) printf("%s\n", path);
    return good;
}

static bool write_orbit(Job *job) {
    int frames = job->options.orbit;
    interrupt_install();
    Progress progress = progress_begin("render", 0, frames);
    bool good = true;
    for (int i = 0; i < frames && good; i++) {
        if (interrupt_requested()) {
            good = fail("stopped after %d of %d frames; those are written", i, frames);
            break;
        }
        Camera camera = orbit_camera(&job->orbit, i, frames);
        char *path = output_path_numbered(job->options.output, i);
        good = write_picture(job, &camera, path);
        mem_free(path);
        progress_update(&progress, i + 1, NULL);
    }
    progress_end(&progress, NULL);
    return good;
}

static bool run_render(Job *job) {
    if (!job_open(job)) return false;
    job->files = json_array();
    bool good = job->options.orbit ? write_orbit(job) : write_picture(job, &job->camera, job->options.output);
    if (!good || !job->options.json) return good;
    const Camera camera = job->options.orbit ? orbit_camera(&job->orbit, 0, 1) : job->camera;
    json_t *root = json_pack("{sO si si si}", "files", job->files, "width", camera.width, "height", camera.height,
                             "splats", job->model.count);
    json_print(root);
    json_decref(root);
    return true;
}

// ---- the command ----

static Options default_options(void) {
    RenderSettings settings = render_settings_default();
    double alpha_max = round(1e6 * (double)settings.alpha_max) / 1e6; // 0.99, not the nearest float's 0.99000001
    return (Options){
        .downscale = 1, .background = "black", .device = "auto", .stop = settings.stop_rule, .alpha_max = alpha_max};
}

// What a run was trained with stands in for what the command line leaves out. A camera file has a size of its own.
static void take_run_defaults(Options *o, const Options *given, const ModelSource *source) {
    memcpy(o->background, source->options.background, sizeof o->background);
    memcpy(o->scene, source->options.scene, sizeof o->scene);
    if (!given->camera[0]) o->downscale = source->options.downscale;
}

static int cmd_render(int argc, char **argv) {
    const Options defaults = default_options();
    const OptionTable table = {FIELDS, sizeof FIELDS / sizeof FIELDS[0], &defaults};
    Job job = {.options = defaults};
    const char *path = NULL;
    int count, exit_code;
    if (!command_line_parse(&CMD_RENDER, &table, argc, argv, &job.options, &path, 1, &count, &exit_code))
        return exit_code;
    if (count == 0) {
        fail_usage("render: which model? splatlab render MODEL.ply|RUN --scene SCENE --view NAME -o OUT.png");
        return command_failed();
    }
    bool good = model_source_find(path, &job.source);
    if (good && job.source.is_run) {
        // The path decides the defaults, so the command line is read again on top of them.
        const Options given = job.options;
        job.options = defaults;
        take_run_defaults(&job.options, &given, &job.source);
        command_line_parse(&CMD_RENDER, &table, argc, argv, &job.options, &path, 1, &count, &exit_code);
    }
    log_set_quiet(job.options.quiet);
    good = good && run_render(&job);
    job_close(&job);
    return good ? 0 : command_failed();
}

const Command CMD_RENDER = {
    .name = "render",
    .arguments = "MODEL.ply|RUN (--scene SCENE --view NAME | --camera CAM.json | --scene SCENE --orbit N) -o OUT",
    .summary = "render a model: a view, a camera file, or an orbit; colour, alpha or depth",
    .details = "  splatlab render run --view DSC_0423 -o view.png\n"
               "  splatlab render model.ply --camera cam.json -o out.exr --background 1,1,1 --reference\n"
               "  splatlab render run --orbit 120 -o frames/orbit.png",
    .run = cmd_render,
};
