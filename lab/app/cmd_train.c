// cmd_train.c - `splatlab train`: photographs with known cameras in, a model out; with progress, metrics and checkpoints.

#include "lab/app/commands.h"
#include "lab/app/metrics_log.h"
#include "lab/app/run_folder.h"
#include "lab/app/run_profile.h"
#include "lab/base/clock.h"
#include "lab/base/fail.h"
#include "lab/base/interrupt.h"
#include "lab/base/log.h"
#include "lab/base/mem.h"
#include "lab/base/progress.h"
#include "lab/io/file.h"
#include "lab/io/json_io.h"
#include "splat3d/background.h"
#include "splat3d/evaluate.h"
#include "splat3d/ply.h"
#include "splat3d/trainer.h"

#include <stdio.h>
#include <string.h>

typedef struct {
    TrainOptions train;
    char run[OPTION_TEXT_BYTES];
    char resume[OPTION_TEXT_BYTES];
    bool overwrite;
    int eval_every, checkpoint_every, log_every; // steps; 0: only at the end
    char device[OPTION_TEXT_BYTES];
    char kernels[OPTION_TEXT_BYTES];
    int blend; // BlendKernels
    bool profile, quiet, json;
} Options;

static const char *const BLENDS[] = {"auto", "cpu", "gpu", NULL};

static const OptionField COMMAND_FIELDS[] = {
    {.name = "output",
     .letter = 'o',
     .type = OPTION_TEXT,
     .offset = offsetof(Options, run),
     .help = "folder for the run: model.ply, metrics.jsonl, options.json, checkpoint.bin",
     .section = "The run"},
    {.name = "resume",
     .type = OPTION_TEXT,
     .offset = offsetof(Options, resume),
     .help = "go on with the run in this folder, with its own options"},
    {.name = "overwrite",
     .type = OPTION_FLAG,
     .offset = offsetof(Options, overwrite),
     .help = "replace a run that is in the folder already"},
    {.name = "eval-every",
     .type = OPTION_INT,
     .offset = offsetof(Options, eval_every),
     .low = 0,
     .high = 1e9,
     .unit = "steps",
     .help = "score the held-out views each time; 0: only at the end"},
    {.name = "checkpoint-every",
     .type = OPTION_INT,
     .offset = offsetof(Options, checkpoint_every),
     .low = 0,
     .high = 1e9,
     .unit = "steps",
     .help = "save all state each time; 0: only at the end and at Ctrl-C"},
    {.name = "log-every",
     .type = OPTION_INT,
     .offset = offsetof(Options, log_every),
     .low = 1,
     .high = 1e9,
     .unit = "steps",
     .help = "write a line of metrics.jsonl each time"},
    {OPTION_DEVICE_OF(Options), .section = "Device and output"},
    {OPTION_KERNELS_OF(Options)},
    {.name = "blend",
     .type = OPTION_CHOICE,
     .offset = offsetof(Options, blend),
     .choices = BLENDS,
     .high = 2,
     .help = "which kernels: made for a CPU, for a GPU, or by the device; to be given again with --resume"},
    {.name = "profile",
     .type = OPTION_FLAG,
     .offset = offsetof(Options, profile),
     .help = "print where the time went at the end: milliseconds a step by stage (--json always has them)"},
    {OPTION_QUIET_OF(Options)},
    {OPTION_JSON_OF(Options, "the result")},
};

enum { COMMAND_FIELD_COUNT = sizeof COMMAND_FIELDS / sizeof COMMAND_FIELDS[0], FIELDS_MAX = 64 };

static Options default_options(void) {
    return (Options){.train = train_options_default(), .checkpoint_every = 1000, .log_every = 10, .device = "auto"};
}

// The command's own fields, then those of TrainOptions at their place inside Options.
static OptionTable make_table(const Options *defaults, OptionField fields[FIELDS_MAX]) {
    int count = 0;
    for (int i = 0; i < COMMAND_FIELD_COUNT; i++) fields[count++] = COMMAND_FIELDS[i];
    for (int i = 0; i < TRAIN_OPTIONS.count && count < FIELDS_MAX; i++) {
        fields[count] = TRAIN_OPTIONS.fields[i];
        fields[count++].offset += offsetof(Options, train);
    }
    return (OptionTable){fields, count, defaults};
}

// All that a run holds on to; run_close() accepts it half-built.
typedef struct {
    Options options;
    RunFolder folder;
    Gpu *gpu;
    Dataset dataset;
    Trainer *trainer;
    MetricsLog log;
    RunProfile profile;
    int first_step; // where this process began
    double began_s; // when its first step began
    double seconds; // spent on steps by earlier processes of this run
} Run;

static void run_close(Run *run) {
    metrics_log_close(&run->log);
    trainer_destroy(run->trainer);
    dataset_destroy(&run->dataset);
    gpu_close(run->gpu);
    run_folder_forget(&run->folder);
}

static double run_seconds(const Run *run) { return run->seconds + clock_seconds() - run->began_s; }

static bool save_model(const Run *run, const TrainingState *state) {
    return ply_save(run->folder.model, &state->model);
}

// The checkpoint and the model as it is now.
static bool save_all(const Run *run, bool with_model) {
    TrainingState state;
    if (!trainer_get_state(run->trainer, &state)) return false;
    state.seconds = run_seconds(run);
    bool done = training_state_save(&state, run->folder.checkpoint) && (!with_model || save_model(run, &state));
    training_state_destroy(&state);
    return done;
}

static bool score(const Run *run, bool show_progress, Evaluation *evaluation) {
    Gaussians model;
    if (!trainer_get_model(run->trainer, &model)) return false;
    RenderSettings settings = trainer_render_settings(run->trainer);
    bool done =
        evaluate_model(trainer_rasterizer(run->trainer), &model, &run->dataset, &settings, show_progress, evaluation);
    gaussians_destroy(&model);
    return done;
}

// Which views score() looks at: a single view is trained on, and there is no other.
static const char *scored_views(const Run *run) {
    return dataset_held_out_count(&run->dataset) ? "held-out" : "training-view";
}

// Scene and folder from the command line, or the folder of the run that is resumed.
static bool name_run(Run *run, const char *scene) {
    Options *o = &run->options;
    if (o->resume[0]) {
        if (scene) return fail_usage("--resume takes the scene from its run; leave '%s' out", scene);
        if (o->run[0]) return fail_usage("--resume writes to the folder of its run; leave --output %s out", o->run);
        if (o->overwrite) return fail_usage("--resume goes on with a run, --overwrite begins a new one; want only one");
        run->folder = run_folder_name(o->resume);
        return true;
    }
    if (!scene)
        return fail_usage("which scene? splatlab train SCENE -o RUN (a folder with images and cameras); `splatlab "
                          "scene studio -o DIR` makes one");
    if (!o->run[0]) return fail_usage("where to? splatlab train %s -o RUN (a folder for the result)", scene);
    run->folder = run_folder_name(o->run);
    return run_folder_take_scene(scene, &o->train);
}

// The options of the run that is resumed. They stand in for the defaults and the command line is read again on top of them:
// what it changes would not be the same run any more.
static bool resume_options(Run *run, int argc, char **argv) {
    Options own = run->options, asked;
    if (!run_folder_load_options(&run->folder, &own.train)) return false;
    asked = own;
    OptionField fields[FIELDS_MAX];
    OptionTable table = make_table(&own, fields);
    const char *positional[1];
    int count, exit_code;
    command_line_parse(&CMD_TRAIN, &table, argc, argv, &asked, positional, 1, &count, &exit_code);
    for (int i = 0; i < TRAIN_OPTIONS.count; i++) {
        const OptionField *field = &TRAIN_OPTIONS.fields[i];
        char has[OPTION_TEXT_BYTES], wants[OPTION_TEXT_BYTES];
        option_text(field, &own.train, has, sizeof has);
        option_text(field, &asked.train, wants, sizeof wants);
        if (strcmp(has, wants) != 0)
            return fail_usage(
                "--%s %s: the run in %s was begun with %s, and --resume keeps to that; leave it out, or begin "
                "a new run",
                field->name, wants, run->folder.folder, has);
    }
    run->options.train = own.train;
    return true;
}

static void say_scene(const Run *run) {
    const Dataset *d = &run->dataset;
    char points[64] = "no points: random ones";
    if (d->points.count) snprintf(points, sizeof points, "%d points", d->points.count);
    log_info("%s (%s): %d views to train on, %d held out, %dx%d px, %s; on %s", d->path, d->kind,
             dataset_train_count(d), dataset_held_out_count(d), d->views[0].camera.width, d->views[0].camera.height,
             points, gpu_info(run->gpu)->name);
}

static bool resume_state(Run *run) {
    if (!file_exists(run->folder.checkpoint)) {
        log_info("%s has no checkpoint yet: starting from its first step", run->folder.folder);
        return true;
    }
    TrainingState state;
    if (!training_state_load(run->folder.checkpoint, &state)) return false;
    bool done = trainer_set_state(run->trainer, &state);
    run->seconds = state.seconds;
    training_state_destroy(&state);
    if (done) log_info("%s: going on behind step %d", run->folder.folder, trainer_steps_done(run->trainer));
    return done;
}

// Everything up to the first step. What can be refused is refused before long work starts.
static bool run_open(Run *run) {
    Options *o = &run->options;
    bool is_new = !o->resume[0], is_random;
    float background[3];
    if (!background_parse(o->train.background, background, &is_random)) return false;
    if (!dataset_open(o->train.scene, o->train.downscale, &run->dataset)) return false;
    if (is_new && !run_folder_check(&run->folder, o->overwrite)) return false;
    if (o->kernels[0]) gpu_set_kernel_folder(o->kernels);
    if (!gpu_open(o->device, &run->gpu)) return false;
    say_scene(run);
    if (!dataset_load_images(&run->dataset)) return false;
    if (!trainer_create(run->gpu, (BlendKernels)o->blend, &o->train, &run->dataset, &run->trainer)) return false;
    if (!(is_new ? run_folder_begin(&run->folder, &o->train) : resume_state(run))) return false;
    run->first_step = trainer_steps_done(run->trainer);
    return metrics_log_open(run->folder.metrics, run->first_step, &run->log);
}

static bool due(int step, int every) { return every > 0 && step % every == 0; }

// What stands beside a step: the log, the score, the checkpoint.
static bool after_step(Run *run, const StepReport *report) {
    const Options *o = &run->options;
    run_profile_add_step(&run->profile, report);
    bool changed = report->density.cloned || report->density.split || report->density.pruned || report->opacity_reset;
    if (due(report->step, o->log_every) || changed || report->step == o->train.iterations) {
        const GpuStageTime *times;
        int count;
        if (!gpu_stage_times(run->gpu, &times, &count)) return false;
        run_profile_add_stages(&run->profile, times, count);
        if (!metrics_log_step(&run->log, report, run_seconds(run), times, count)) return false;
    }
    if (due(report->step, o->eval_every) && report->step < o->train.iterations) {
        Evaluation evaluation;
        const GpuStageTime *of_evaluation; // no step's
        int count;
        if (!score(run, false, &evaluation)) return false;
        log_info("step %d: %s PSNR %.2f dB, SSIM %.4f, %d splats%s", report->step, scored_views(run), evaluation.psnr,
                 evaluation.ssim, report->splats, report->opacity_reset ? " (opacities were reset at this step)" : "");
        bool done = metrics_log_evaluation(&run->log, report->step, &evaluation) &&
                    gpu_stage_times(run->gpu, &of_evaluation, &count);
        evaluation_destroy(&evaluation);
        if (!done) return false;
    }
    return !due(report->step, o->checkpoint_every) || save_all(run, false);
}

// Steps until the end, Ctrl-C, or a failure.
static bool train(Run *run) {
    int iterations = run->options.train.iterations;
    double smooth_loss = 0, smooth_psnr = 0;
    Progress progress = progress_begin("train", run->first_step, iterations);
    run->began_s = clock_seconds();
    while (trainer_steps_done(run->trainer) < iterations && !interrupt_requested()) {
        StepReport report;
        if (!trainer_step(run->trainer, &report)) {
            progress_end(&progress, NULL);
            return false;
        }
        double keep = report.step - run->first_step > 1 ? 0.95 : 0;
        smooth_loss = keep * smooth_loss + (1 - keep) * report.loss.total;
        smooth_psnr = keep * smooth_psnr + (1 - keep) * report.psnr;
        char note[128];
        snprintf(note, sizeof note, "loss %.4f  PSNR %.2f dB  %d splats", smooth_loss, smooth_psnr, report.splats);
        progress_update(&progress, report.step, note);
        if (!after_step(run, &report)) {
            progress_end(&progress, NULL);
            if (file_exists(run->folder.checkpoint))
                log_warn("the last checkpoint is whole; when this is mended, go on with: splatlab train --resume %s",
                         run->folder.folder);
            return false;
        }
    }
    progress_end(&progress, NULL);
    return true;
}

static bool print_result(Run *run, bool interrupted) {
    Evaluation e;
    char sha256[65];
    double seconds = run_seconds(run);
    int done = trainer_steps_done(run->trainer), here = done - run->first_step;
    double ms = here ? 1e3 * (clock_seconds() - run->began_s) / here : 0;
    if (!file_sha256(run->folder.model, sha256) || !score(run, true, &e)) return false;
    int splats = trainer_splat_count(run->trainer);
    bool logged = here == 0 || metrics_log_evaluation(&run->log, done, &e); // no new step, no new score
    if (run->options.json) {
        json_t *root = json_pack(
            "{sf sf si si sf sf ss sI so sb so sf sf}", "psnr", e.psnr, "ssim", e.ssim, "splats", splats, "iterations",
            done, "seconds", seconds, "ms_per_iteration", ms, "model_sha256", sha256, "peak_rss_bytes",
            (json_int_t)mem_peak_bytes(), "model", json_text(run->folder.model), "interrupted", interrupted, "profile",
            run_profile_json(&run->profile), "seconds_to_first_iteration", run->profile.first_step_s,
            "cpu_seconds_to_first_iteration", run->profile.first_step_cpu_s);
        json_print(root);
        json_decref(root);
    } else {
        printf("%s: %d steps, %d splats, %s PSNR %.2f dB, SSIM %.4f, %.0f s (%.1f ms a step)\n", run->folder.model,
               done, splats, scored_views(run), e.psnr, e.ssim, seconds, ms);
        if (run->options.profile) run_profile_print(&run->profile);
    }
    evaluation_destroy(&e);
    return logged;
}

// Saves what there is after a failed step, keeping the failure's message.
static bool rescue(const Run *run) {
    char *why = mem_text(fail_text());
    TrainingState state;
    if (trainer_get_state(run->trainer, &state)) {
        if (save_model(run, &state)) log_warn("the model before the failure is saved: %s", run->folder.model);
        training_state_destroy(&state);
    }
    fail("%s", why);
    mem_free(why);
    return false;
}

static bool run_train(Run *run) {
    interrupt_install();
    if (!run_open(run)) return false;
    if (!train(run)) return rescue(run);
    bool interrupted = trainer_steps_done(run->trainer) < run->options.train.iterations;
    if (!save_all(run, true)) return false;
    if (interrupted)
        log_warn("stopped behind step %d, everything is saved; go on with: splatlab train --resume %s",
                 trainer_steps_done(run->trainer), run->folder.folder);
    return print_result(run, interrupted);
}

static int cmd_train(int argc, char **argv) {
    Run run = {.options = default_options()};
    Options defaults = run.options;
    OptionField fields[FIELDS_MAX];
    OptionTable table = make_table(&defaults, fields);
    const char *positional[1];
    int count, exit_code;
    if (!command_line_parse(&CMD_TRAIN, &table, argc, argv, &run.options, positional, 1, &count, &exit_code))
        return exit_code;
    log_set_quiet(run.options.quiet);
    bool done = name_run(&run, count ? positional[0] : NULL) &&
                (!run.options.resume[0] || resume_options(&run, argc, argv)) && run_train(&run);
    run_close(&run);
    return done ? 0 : command_failed();
}

const Command CMD_TRAIN = {
    .name = "train",
    .arguments = "SCENE -o RUN | --resume RUN",
    .summary = "train a model on photographs with known cameras",
    .details = "SCENE is a folder with images and a COLMAP model (sparse/0) or a transforms.json. Ctrl-C stops behind "
               "the current\n"
               "step and saves everything; --resume goes on, to the same bytes as if nothing had happened.\n\n"
               "  splatlab scene studio -o studio && splatlab train studio -o run\n"
               "  splatlab train photos -o run --downscale 2 --iterations 2000 --eval-every 500\n"
               "  splatlab train --resume run",
    .run = cmd_train,
};
