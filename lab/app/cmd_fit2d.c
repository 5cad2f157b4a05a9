// cmd_fit2d.c - `splatlab fit2d`: a photograph in, blobs out; with progress or in a window, a film, and a Ctrl-C that saves.
#include "lab/app/commands.h"
#include "lab/app/fit_job.h"
#include "lab/app/fit_live.h"
#include "lab/app/fit_photo.h"
#include "lab/app/window_options.h"
#include "lab/base/fail.h"
#include "lab/base/interrupt.h"
#include "lab/base/log.h"
#include "lab/base/progress.h"
#include "lab/io/json_io.h"

#include <stdio.h>
#include <string.h>

typedef struct {
    Fit2dOptions fit;
    char output[OPTION_TEXT_BYTES];
    int downscale;
    int size[2]; // px, 0 0: as it is
    bool gif;
    bool live;
    bool quiet, json;
    WindowOptions window;
} Options;

static const OptionField COMMAND_FIELDS[] = {
    {.name = "output",
     .letter = 'o',
     .type = OPTION_TEXT,
     .offset = offsetof(Options, output),
     .help = "folder for fit.png, fit.json (a scene for `splatlab widget`) and comparison.png",
     .section = "Photograph and output"},
    {.name = "gif",
     .type = OPTION_FLAG,
     .offset = offsetof(Options, gif),
     .help = "also fit.gif: how the picture came about"},
    {.name = "downscale",
     .type = OPTION_INT,
     .offset = offsetof(Options, downscale),
     .low = 1,
     .high = 64,
     .unit = "times",
     .help = "fit the photograph at 1/K of its size"},
    {.name = "size",
     .type = OPTION_SIZE,
     .offset = offsetof(Options, size),
     .low = 0,
     .high = SCENE2D_SIDE_MAX,
     .unit = "px",
     .help = "make the photograph smaller until it fits into WxH; 0x0: as it is"},
    {OPTION_JSON_OF(Options, "the result")},
    {OPTION_QUIET_OF(Options)},
    {.name = "live",
     .type = OPTION_FLAG,
     .offset = offsetof(Options, live),
     .help = "watch it in a window; closing it early saves what there is",
     .section = "Window"},
};

enum {
    COMMAND_FIELD_COUNT = sizeof COMMAND_FIELDS / sizeof COMMAND_FIELDS[0],
    FIELDS_MAX = 32,
    SCORE_EVERY = 20 // steps between two scores on the progress line
};

// The fit's own fields at their place inside Options, then the command's, then those of a window.
static OptionTable make_table(const Options *defaults, OptionField fields[FIELDS_MAX]) {
    int count = 0;
    for (int i = 0; i < FIT2D_OPTIONS.count; i++) {
        fields[count] = FIT2D_OPTIONS.fields[i];
        fields[count++].offset += offsetof(Options, fit);
    }
    for (int i = 0; i < COMMAND_FIELD_COUNT; i++) fields[count++] = COMMAND_FIELDS[i];
    window_options_fields(offsetof(Options, window), fields + count);
    for (int i = 0; i < WINDOW_OPTION_COUNT; i++, count++) {
        if (strcmp(fields[count].name, "size") == 0) fields[count].name = "window-size"; // --size is the photograph's
        if (strcmp(fields[count].name, "state-file") == 0)
            fields[count].help = "a .json file: step, loss, PSNR and number of blobs, written after each frame";
    }
    return (OptionTable){fields, count, defaults};
}

static bool open_job(const Options *o, const char *path, FitJob *job) {
    ImageF photo;
    if (!path) return fail_usage("fit2d: which photograph? splatlab fit2d PHOTO -o OUT");
    if ((o->size[0] == 0) != (o->size[1] == 0))
        return fail_usage("fit2d: --size %dx%d: want two numbers above 0, or 0x0", o->size[0], o->size[1]);
    const WindowOptions *w = &o->window;
    bool any = w->size[0] || w->ui_scale > 0 || w->frames || w->screenshot[0] || w->state_file[0] || w->places_file[0];
    if (any && !o->live) return fail_usage("fit2d: the options of a window go with --live");
    if (!window_options_check(&o->window, "fit2d")) return false;
    if (!fit_photo_load(path, o->downscale, o->size[0], o->size[1], &photo)) return false;
    int width = photo.width, height = photo.height;
    if (!fit_job_open(job, photo, &o->fit, o->output, o->gif)) return false;
    log_info("%s: %d x %d px, %d %s blobs, %d steps", path, width, height, o->fit.gaussians,
             o->fit.isotropic ? "round" : "stretched", o->fit.iterations);
    return true;
}

// Until the last step or Ctrl-C.
static void descend(FitJob *job, bool quiet) {
    char note[128] = "";
    Progress progress = progress_begin("fit", 0, job->options.iterations);
    while (!fit_job_is_done(job) && !interrupt_requested()) {
        fit_job_step(job);
        int done = fit2d_steps_done(job->fit);
        if (done % SCORE_EVERY == 1 && !quiet)
            snprintf(note, sizeof note, "loss %.4f  PSNR %.2f dB  %d blobs", job->loss.total, fit_job_score(job),
                     fit2d_count(job->fit));
        progress_update(&progress, done, note);
    }
    progress_end(&progress, NULL);
}

static void print_result(const FitJob *job, bool as_json) {
    const Fit2dOptions *o = &job->options;
    double psnr = metric_psnr(&job->picture, &job->photo), ssim = metric_ssim(&job->picture, &job->photo);
    int steps = fit2d_steps_done(job->fit);
    double ms = steps > 0 ? 1e3 * job->seconds / steps : 0;
    if (as_json) {
        json_t *root =
            json_pack("{sf sf si sf sf si si si sb sb sb ss ss}", "psnr", psnr, "ssim", ssim, "gaussians",
                      job->scene.count, "seconds", job->seconds, "ms_per_iteration", ms, "iterations", steps, "width",
                      job->photo.width, "height", job->photo.height, "isotropic", o->isotropic, "grow", o->grow,
                      "interrupted", !fit_job_is_done(job), "picture", job->folder.picture, "scene", job->folder.scene);
        json_print(root);
        json_decref(root);
        return;
    }
    printf("%s: %d blobs, %d steps, PSNR %.2f dB, SSIM %.4f, %.1f s (%.1f ms a step)\n", job->folder.picture,
           job->scene.count, steps, psnr, ssim, job->seconds, ms);
}

static bool run_fit2d(const Options *o, const char *path, FitJob *job) {
    if (!open_job(o, path, job)) return false;
    if (o->live) {
        if (!fit_live(job, &o->window)) return false;
    } else {
        interrupt_install();
        descend(job, o->quiet);
        if (!fit_job_save(job)) return false;
    }
    if (!fit_job_is_done(job)) log_warn("stopped behind step %d; what there is is saved", fit2d_steps_done(job->fit));
    print_result(job, o->json);
    return true;
}

static int cmd_fit2d(int argc, char **argv) {
    Options defaults = {.fit = fit2d_options_default(), .downscale = 1};
    Options options = defaults;
    FitJob job = {0};
    OptionField fields[FIELDS_MAX];
    OptionTable table = make_table(&defaults, fields);
    const char *path = NULL;
    int count, exit_code;
    if (!command_line_parse(&CMD_FIT2D, &table, argc, argv, &options, &path, 1, &count, &exit_code)) return exit_code;
    log_set_quiet(options.quiet);
    bool good = run_fit2d(&options, path, &job);
    fit_job_close(&job);
    return good ? 0 : command_failed();
}

const Command CMD_FIT2D = {
    .name = "fit2d",
    .arguments = "PHOTO -o OUT",
    .summary = "fit a picture with 2-D Gaussians by gradient descent",
    .details = "PHOTO is any picture; what is transparent becomes white. Ctrl-C stops and saves what there is.\n"
               "With --live it is shown as it happens, and gives the same files; F1 in the window helps.\n\n"
               "  splatlab fit2d photo.jpg -n 500 -o out\n"
               "  splatlab fit2d photo.jpg -n 500 -o out --live\n"
               "  splatlab fit2d photo.jpg -n 2000 --size 640x640 --grow --gif -o out\n"
               "  splatlab fit2d photo.jpg -n 500 --isotropic -o out && splatlab widget out/fit.json",
    .run = cmd_fit2d,
};
