// cmd_fit2d.c - `splatlab fit2d`: a photograph in, blobs out; with progress, a film, and a Ctrl-C that saves.
#include "lab/app/commands.h"
#include "lab/app/fit2d_folder.h"
#include "lab/app/fit_film.h"
#include "lab/app/fit_photo.h"
#include "lab/base/clock.h"
#include "lab/base/fail.h"
#include "lab/base/interrupt.h"
#include "lab/base/log.h"
#include "lab/base/progress.h"
#include "lab/io/json_io.h"
#include "splat2d/fit2d.h"

#include <stdio.h>

typedef struct {
    Fit2dOptions fit;
    char output[OPTION_TEXT_BYTES];
    int downscale;
    int size[2]; // px, 0 0: as it is
    bool gif;
    bool quiet, json;
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
};

enum {
    COMMAND_FIELD_COUNT = sizeof COMMAND_FIELDS / sizeof COMMAND_FIELDS[0],
    FIELDS_MAX = 32,
    SCORE_EVERY = 20 // steps between two scores on the progress line
};

// All that a fit holds on to; job_close() accepts it half-built.
typedef struct {
    Options options;
    Fit2dFolder folder;
    ImageF photo, picture;
    Fit2d *fit;
    Scene2d scene;
    FitFilm film;
    double seconds; // of the steps
} Job;

static void job_close(Job *job) {
    fit_film_destroy(&job->film);
    scene2d_destroy(&job->scene);
    fit2d_destroy(job->fit);
    imagef_destroy(&job->picture);
    imagef_destroy(&job->photo);
    fit2d_folder_forget(&job->folder);
}

// The fit's own fields at their place inside Options, then the command's.
static OptionTable make_table(const Options *defaults, OptionField fields[FIELDS_MAX]) {
    int count = 0;
    for (int i = 0; i < FIT2D_OPTIONS.count; i++) {
        fields[count] = FIT2D_OPTIONS.fields[i];
        fields[count++].offset += offsetof(Options, fit);
    }
    for (int i = 0; i < COMMAND_FIELD_COUNT; i++) fields[count++] = COMMAND_FIELDS[i];
    return (OptionTable){fields, count, defaults};
}

static bool job_open(Job *job, const char *path) {
    const Options *o = &job->options;
    if (!path) return fail_usage("fit2d: which photograph? splatlab fit2d PHOTO -o OUT");
    if ((o->size[0] == 0) != (o->size[1] == 0))
        return fail_usage("fit2d: --size %dx%d: want two numbers above 0, or 0x0", o->size[0], o->size[1]);
    if (!fit_photo_load(path, o->downscale, o->size[0], o->size[1], &job->photo)) return false;
    if (!fit2d_folder_begin(o->output, &job->folder)) return fail_context("fit2d");
    job->picture = imagef_create(job->photo.width, job->photo.height, 3);
    job->film = fit_film_begin(o->fit.iterations);
    job->fit = fit2d_create(&job->photo, &o->fit);
    log_info("%s: %d x %d px, %d %s blobs, %d steps", path, job->photo.width, job->photo.height, o->fit.gaussians,
             o->fit.isotropic ? "round" : "stretched", o->fit.iterations);
    return true;
}

static void keep_frame(Job *job) {
    if (!job->options.gif || !fit_film_wants(&job->film, fit2d_steps_done(job->fit))) return;
    fit2d_picture(job->fit, &job->picture);
    fit_film_add(&job->film, &job->picture);
}

// Until the last step or Ctrl-C.
static void descend(Job *job) {
    int total = job->options.fit.iterations;
    double began_s = clock_seconds();
    char note[128] = "";
    Progress progress = progress_begin("fit", 0, total);
    keep_frame(job);
    while (fit2d_steps_done(job->fit) < total && !interrupt_requested()) {
        Loss loss = fit2d_step(job->fit);
        int done = fit2d_steps_done(job->fit);
        if (done % SCORE_EVERY == 1 && !job->options.quiet) {
            fit2d_picture(job->fit, &job->picture);
            snprintf(note, sizeof note, "loss %.4f  PSNR %.2f dB  %d blobs", loss.total,
                     metric_psnr(&job->picture, &job->photo), fit2d_count(job->fit));
        }
        progress_update(&progress, done, note);
        keep_frame(job);
    }
    job->seconds = clock_seconds() - began_s;
    progress_end(&progress, NULL);
}

static void print_result(const Job *job, bool interrupted) {
    const Fit2dOptions *o = &job->options.fit;
    double psnr = metric_psnr(&job->picture, &job->photo), ssim = metric_ssim(&job->picture, &job->photo);
    int steps = fit2d_steps_done(job->fit);
    double ms = steps > 0 ? 1e3 * job->seconds / steps : 0;
    if (job->options.json) {
        json_t *root =
            json_pack("{sf sf si sf sf si si si sb sb sb ss ss}", "psnr", psnr, "ssim", ssim, "gaussians",
                      job->scene.count, "seconds", job->seconds, "ms_per_iteration", ms, "iterations", steps, "width",
                      job->photo.width, "height", job->photo.height, "isotropic", o->isotropic, "grow", o->grow,
                      "interrupted", interrupted, "picture", job->folder.picture, "scene", job->folder.scene);
        json_print(root);
        json_decref(root);
        return;
    }
    printf("%s: %d blobs, %d steps, PSNR %.2f dB, SSIM %.4f, %.1f s (%.1f ms a step)\n", job->folder.picture,
           job->scene.count, steps, psnr, ssim, job->seconds, ms);
}

static bool run_fit2d(Job *job, const char *path) {
    if (!job_open(job, path)) return false;
    interrupt_install();
    descend(job);
    bool interrupted = fit2d_steps_done(job->fit) < job->options.fit.iterations;
    job->scene = fit2d_scene(job->fit);
    fit2d_picture(job->fit, &job->picture);
    if (!fit2d_folder_save(&job->folder, &job->photo, &job->picture, &job->scene)) return false;
    if (job->options.gif && !fit_film_save(&job->film, job->folder.film)) return false;
    if (interrupted) log_warn("stopped behind step %d; what there is is saved", fit2d_steps_done(job->fit));
    print_result(job, interrupted);
    return true;
}

static int cmd_fit2d(int argc, char **argv) {
    Options defaults = {.fit = fit2d_options_default(), .downscale = 1};
    Job job = {.options = defaults};
    OptionField fields[FIELDS_MAX];
    OptionTable table = make_table(&defaults, fields);
    const char *path = NULL;
    int count, exit_code;
    if (!command_line_parse(&CMD_FIT2D, &table, argc, argv, &job.options, &path, 1, &count, &exit_code))
        return exit_code;
    log_set_quiet(job.options.quiet);
    bool good = run_fit2d(&job, path);
    job_close(&job);
    return good ? 0 : command_failed();
}

const Command CMD_FIT2D = {
    .name = "fit2d",
    .arguments = "PHOTO -o OUT",
    .summary = "fit a picture with 2-D Gaussians by gradient descent",
    .details = "PHOTO is any picture; what is transparent becomes white. Ctrl-C stops and saves what there is.\n\n"
               "  splatlab fit2d photo.jpg -n 500 -o out\n"
               "  splatlab fit2d photo.jpg -n 2000 --size 640x640 --grow --gif -o out\n"
               "  splatlab fit2d photo.jpg -n 500 --isotropic -o out && splatlab widget out/fit.json",
    .run = cmd_fit2d,
};
