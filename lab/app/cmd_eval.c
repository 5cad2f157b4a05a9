// cmd_eval.c - `splatlab eval`: PSNR and SSIM of a model on the views that were held out of its training.
#include "lab/app/commands.h"
#include "lab/app/model_source.h"
#include "lab/app/output_path.h"
#include "lab/app/renderer.h"
#include "lab/base/fail.h"
#include "lab/base/log.h"
#include "lab/io/image_io.h"
#include "lab/io/json_io.h"
#include "splat3d/background.h"
#include "splat3d/evaluate.h"
#include "splat3d/ply.h"

#include <stdio.h>
#include <string.h>

typedef struct {
    char scene[OPTION_TEXT_BYTES];
    int downscale;
    char background[OPTION_TEXT_BYTES];
    char contact_sheet[OPTION_TEXT_BYTES];
    bool reference;
    char device[OPTION_TEXT_BYTES];
    char kernels[OPTION_TEXT_BYTES];
    bool quiet, json;
} Options;

static const Options DEFAULTS = {.downscale = 1, .background = "black", .device = "auto"};
static const OptionField FIELDS[] = {
    {.name = "scene",
     .type = OPTION_TEXT,
     .offset = offsetof(Options, scene),
     .help = "folder with the photographs; a run knows its own",
     .section = "What to compare with"},
    {.name = "downscale",
     .type = OPTION_INT,
     .offset = offsetof(Options, downscale),
     .low = 1,
     .high = 64,
     .unit = "times",
     .help = "compare at 1/K of the photographs' size; a run brings its own"},
    {.name = "background",
     .type = OPTION_TEXT,
     .offset = offsetof(Options, background),
     .help = "white, black or r,g,b in 0..1: behind the splats and under photographs with alpha; a run brings its own"},
    {.name = "contact-sheet",
     .type = OPTION_TEXT,
     .offset = offsetof(Options, contact_sheet),
     .help = "write a .png: rows of photograph, render and error x 4",
     .section = "Output"},
    {OPTION_JSON_OF(Options, "the figures")},
    {OPTION_QUIET_OF(Options)},
    {.name = "reference",
     .type = OPTION_FLAG,
     .offset = offsetof(Options, reference),
     .help = "render with the double-precision C reference: slow, needs no device",
     .section = "How to render"},
    {OPTION_DEVICE_OF(Options)},
    {OPTION_KERNELS_OF(Options)},
};
static const OptionTable TABLE = {FIELDS, sizeof FIELDS / sizeof FIELDS[0], &DEFAULTS};

static const char *const SHEET_ENDINGS[] = {".png", ".jpg", NULL};
enum { SHEET_ROWS = 6 };

// All that an evaluation holds on to; eval_close() accepts it half-built.
typedef struct {
    Options options;
    ModelSource source;
    Dataset dataset;
    Gaussians model;
    Renderer renderer;
    RenderSettings settings;
    Evaluation evaluation;
} Eval;

static void eval_close(Eval *eval) {
    evaluation_destroy(&eval->evaluation);
    renderer_close(&eval->renderer);
    gaussians_destroy(&eval->model);
    dataset_destroy(&eval->dataset);
    model_source_forget(&eval->source);
}

static void print_json(const Eval *eval) {
    const Evaluation *e = &eval->evaluation;
    json_t *views = json_array();
    for (int i = 0; i < e->count; i++)
        json_array_append_new(views, json_pack("{so sf sf sf}", "name", json_text(e->views[i].name), "psnr",
                                               e->views[i].psnr, "ssim", e->views[i].ssim, "psnr8", e->views[i].psnr8));
    json_t *root = json_pack("{sf sf sf si so ss}", "psnr", e->psnr, "ssim", e->ssim, "psnr8", e->psnr8, "splats",
                             eval->model.count, "views", views, "protocol", EVALUATION_PROTOCOL);
    json_print(root);
    json_decref(root);
}

static void print_table(const Evaluation *e) {
    int widest = (int)strlen("mean");
    for (int i = 0; i < e->count; i++) {
        int length = (int)strlen(e->views[i].name);
        if (length > widest) widest = length;
    }
    printf("%-*s  PSNR dB    SSIM  PSNR dB, 8 bit\n", widest, "view");
    for (int i = 0; i < e->count; i++)
        printf("%-*s  %7.3f  %.4f  %7.3f\n", widest, e->views[i].name, e->views[i].psnr, e->views[i].ssim,
               e->views[i].psnr8);
    printf("%-*s  %7.3f  %.4f  %7.3f\n", widest, "mean", e->psnr, e->ssim, e->psnr8);
    printf("protocol: %s\n", EVALUATION_PROTOCOL);
}

static bool write_sheet(const Eval *eval) {
    ImageF sheet;
    const char *path = eval->options.contact_sheet;
    if (!evaluate_contact_sheet(eval->renderer.rasterizer, &eval->model, &eval->dataset, &eval->settings, SHEET_ROWS,
                                &sheet))
        return false;
    bool good = image_savef(path, &sheet);
    imagef_destroy(&sheet);
    if (good) log_info("contact sheet (photograph, render, error x 4): %s", path);
    return good;
}

// Everything that can be refused is refused before the first picture.
static bool eval_open(Eval *eval) {
    Options *o = &eval->options;
    bool is_random;
    eval->settings = render_settings_default();
    if (!o->scene[0]) return fail_usage("eval: compared with what? give the photographs' folder: --scene SCENE");
    if (!background_parse(o->background, eval->settings.background, &is_random)) return false;
    if (is_random) log_info("trained on random backgrounds; evaluated on black");
    if (o->contact_sheet[0] && !output_path_check("contact-sheet", o->contact_sheet, SHEET_ENDINGS)) return false;
    if (!ply_load(eval->source.path, &eval->model)) return false;
    if (!dataset_open(o->scene, o->downscale, &eval->dataset)) return false;
    if (dataset_held_out_count(&eval->dataset) == 0)
        log_warn("%s holds no view out of training: all %d are compared", o->scene, eval->dataset.view_count);
    return renderer_open(o->reference, o->device, o->kernels, &eval->renderer);
}

static bool run_eval(Eval *eval) {
    if (!eval_open(eval)) return false;
    if (!evaluate_model(eval->renderer.rasterizer, &eval->model, &eval->dataset, &eval->settings, true,
                        &eval->evaluation))
        return false;
    if (eval->options.contact_sheet[0] && !write_sheet(eval)) return false;
    if (eval->options.json)
        print_json(eval);
    else
        print_table(&eval->evaluation);
    return true;
}

// What a run was trained with stands in for what the command line leaves out.
static void take_defaults(Options *o, const ModelSource *source) {
    *o = DEFAULTS;
    if (!source->is_run) return;
    memcpy(o->scene, source->options.scene, sizeof o->scene);
    memcpy(o->background, source->options.background, sizeof o->background);
    o->downscale = source->options.downscale;
}

static int cmd_eval(int argc, char **argv) {
    Eval eval = {.options = DEFAULTS};
    const char *path = NULL;
    int count, exit_code;
    if (!command_line_parse(&CMD_EVAL, &TABLE, argc, argv, &eval.options, &path, 1, &count, &exit_code))
        return exit_code;
    if (count == 0) {
        fail_usage("eval: which model? splatlab eval MODEL.ply|RUN --scene SCENE");
        return command_failed();
    }
    bool good = model_source_find(path, &eval.source);
    if (good) {
        // The path decides the defaults, so the command line is read again on top of them.
        take_defaults(&eval.options, &eval.source);
        command_line_parse(&CMD_EVAL, &TABLE, argc, argv, &eval.options, &path, 1, &count, &exit_code);
        log_set_quiet(eval.options.quiet);
        good = run_eval(&eval);
    }
    eval_close(&eval);
    return good ? 0 : command_failed();
}

const Command CMD_EVAL = {
    .name = "eval",
    .arguments = "MODEL.ply|RUN --scene SCENE",
    .summary = "score a model on the views held out of training: PSNR and SSIM",
    .details = "  splatlab eval run\n"
               "  splatlab eval model.ply --scene photos --downscale 2 --json\n"
               "  splatlab eval run --contact-sheet sheet.png",
    .run = cmd_eval,
};
