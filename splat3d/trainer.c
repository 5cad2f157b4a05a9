#include "splat3d/trainer.h"

#include "lab/base/clock.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/base/rng.h"
#include "splat3d/background.h"
#include "splat3d/first_splats.h"
#include "splat3d/opencl_adam.h"
#include "splat3d/schedule.h"

#include <math.h>
#include <string.h>

// A training view at one size.
typedef struct {
    Camera camera;
    GpuBuffer *photo; // RGBA bytes on the device
    int shrink;       // 1, 2, 4, ... times smaller than the view
} Shot;

struct Trainer {
    TrainOptions options;
    float background[3];
    bool background_is_random;
    const Dataset *dataset;
    uint64_t scene; // its fingerprint

    // The training views, by index 0..view_count-1.
    int view_count;
    const View **views; // borrowed from the data set
    int level_count;    // sizes of each view: 1 + coarse_levels
    Shot *shots;        // (view_count, level_count), level 0 the full size; one that would be too small has no photo
    int *view_order;    // of the current epoch
    int epoch;

    Gpu *gpu; // borrowed
    OpenclRasterizer *rasterizer;
    OpenclLoss *loss;
    OpenclAdam *adam;
    DeviceGaussians model, m, v;
    DensityStatistics statistics;

    int steps_done;
    double seconds;
    uint32_t *id; // (N)
    uint32_t next_id;
};

static Shot *shots_of(const Trainer *t, int view) { return t->shots + (size_t)view * (size_t)t->level_count; }

// The view at all its sizes: each the half of the one before.
static bool upload_view(Trainer *t, const View *view, Shot *shots) {
    int sizes = schedule_sizes(&t->options, view->camera.width, view->camera.height);
    shots[0] = (Shot){.camera = view->camera, .shrink = 1};
    bool done = opencl_photo_create(t->gpu, &view->image, &shots[0].photo);
    Image8 small = {0};
    for (int level = 1; done && level < sizes; level++) {
        Image8 half = image8_downscale(level == 1 ? &view->image : &small, 2);
        image8_destroy(&small);
        small = half;
        shots[level] = (Shot){.camera = camera_shrunk(&view->camera, 1 << level), .shrink = 1 << level};
        done = opencl_photo_create(t->gpu, &small, &shots[level].photo);
    }
    image8_destroy(&small);
    return done;
}

// The view as that step sees it.
static const Shot *shot_of(const Trainer *t, int step, int view) {
    const Shot *shots = shots_of(t, view);
    int level = schedule_coarse_level(&t->options, step);
    while (!shots[level].photo) level--;
    return &shots[level];
}

static bool upload_views(Trainer *t, Dataset *dataset) {
    t->view_count = dataset_train_count(dataset);
    if (t->view_count == 0)
        return fail("%s: no view is left to train on; all %d are held out", dataset->path, dataset->view_count);
    t->views = mem_alloc((size_t)t->view_count, sizeof *t->views);
    t->level_count = 1 + t->options.coarse_levels;
    t->shots = mem_alloc((size_t)t->view_count * (size_t)t->level_count, sizeof *t->shots);
    t->view_order = mem_alloc((size_t)t->view_count, sizeof *t->view_order);
    t->epoch = -1;
    for (int i = 0, n = 0; i < dataset->view_count; i++) {
        View *view = &dataset->views[i];
        if (view->held_out) continue;
        t->views[n] = view;
        if (!upload_view(t, view, shots_of(t, n++))) return fail_context("%s", view->path);
        image8_destroy(&view->image);
    }
    return true;
}

static bool create_device_side(Trainer *t, BlendKernels blend) {
    int degree = t->options.sh_degree;
    return opencl_rasterizer_create(t->gpu, blend, &t->rasterizer) && opencl_loss_create(t->gpu, blend, &t->loss) &&
           opencl_adam_create(t->gpu, t->options.sparse_adam, &t->adam) &&
           device_gaussians_create(t->gpu, "model", 0, degree, &t->model) &&
           device_gaussians_create(t->gpu, "first moment", 0, degree, &t->m) &&
           device_gaussians_create(t->gpu, "second moment", 0, degree, &t->v) &&
           gpu_buffer_create(t->gpu, "density gradient", sizeof(float), &t->statistics.gradient_ndc) &&
           gpu_buffer_create(t->gpu, "density views", sizeof(int), &t->statistics.seen);
}

static bool begin_from_points(Trainer *t) {
    const Dataset *d = t->dataset;
    const TrainOptions *o = &t->options;
    Points random = {0};
    if (d->points.count == 0) random = first_splats_random_points(d, o->init_points, o->seed);
    TrainingState state = training_state_from_model(
        first_splats_from_points(random.count ? &random : &d->points, o->sh_degree, o->init_opacity));
    state.scene = t->scene;
    bool done = trainer_set_state(t, &state);
    training_state_destroy(&state);
    points_destroy(&random);
    return done;
}

bool trainer_create(Gpu *gpu, BlendKernels blend, const TrainOptions *options, Dataset *dataset, Trainer **trainer) {
    Trainer *t = mem_alloc(1, sizeof *t);
    t->options = *options;
    t->dataset = dataset;
    t->scene = dataset_fingerprint(dataset);
    t->gpu = gpu;
    bool done = background_parse(options->background, t->background, &t->background_is_random) &&
                create_device_side(t, blend) && upload_views(t, dataset) && begin_from_points(t);
    if (!done) {
        trainer_destroy(t);
        return false;
    }
    *trainer = t;
    return true;
}

void trainer_destroy(Trainer *t) {
    if (!t) return;
    for (int i = 0; t->shots && i < t->view_count * t->level_count; i++) gpu_buffer_destroy(t->shots[i].photo);
    mem_free(t->views);
    mem_free(t->shots);
    mem_free(t->view_order);
    mem_free(t->id);
    gpu_buffer_destroy(t->statistics.gradient_ndc);
    gpu_buffer_destroy(t->statistics.seen);
    device_gaussians_destroy(&t->model);
    device_gaussians_destroy(&t->m);
    device_gaussians_destroy(&t->v);
    opencl_adam_destroy(t->adam);
    opencl_loss_destroy(t->loss);
    opencl_rasterizer_destroy(t->rasterizer);
    mem_free(t);
}

int trainer_steps_done(const Trainer *t) { return t->steps_done; }
int trainer_splat_count(const Trainer *t) { return t->model.count; }
double trainer_scene_extent(const Trainer *t) { return t->dataset->extent; }
Rasterizer *trainer_rasterizer(Trainer *t) { return opencl_rasterizer_interface(t->rasterizer); }

RenderSettings trainer_render_settings(const Trainer *t) {
    RenderSettings settings = render_settings_default();
    memcpy(settings.background, t->background, sizeof settings.background);
    settings.sh_degree = t->options.sh_degree;
    return settings;
}

bool trainer_get_state(const Trainer *t, TrainingState *state) {
    TrainingState s = {.steps_done = t->steps_done, .scene = t->scene, .seconds = t->seconds, .next_id = t->next_id};
    size_t n = (size_t)t->model.count;
    s.id = mem_alloc(n, sizeof *s.id);
    s.gradient_sum = mem_alloc(n, sizeof *s.gradient_sum);
    s.seen = mem_alloc(n, sizeof *s.seen);
    if (n) memcpy(s.id, t->id, n * sizeof *s.id);
    bool done = device_gaussians_read(&t->model, &s.model) && device_gaussians_read(&t->m, &s.m) &&
                device_gaussians_read(&t->v, &s.v) &&
                gpu_buffer_read(t->statistics.gradient_ndc, s.gradient_sum, n * sizeof *s.gradient_sum) &&
                gpu_buffer_read(t->statistics.seen, s.seen, n * sizeof *s.seen);
    if (done)
        *state = s;
    else
        training_state_destroy(&s);
    return done;
}

bool trainer_get_model(const Trainer *t, Gaussians *model) { return device_gaussians_read(&t->model, model); }

bool trainer_set_state(Trainer *t, const TrainingState *s) {
    size_t n = (size_t)s->model.count;
    if (s->scene != t->scene)
        return fail("%s is no longer what the state was trained on: views, cameras, points or the pictures' sizes have "
                    "changed; "
                    "put them back, or begin a new run",
                    t->dataset->path);
    if (s->model.sh_degree != t->options.sh_degree)
        return fail("the state has SH degree %d, the options say %d; put sh_degree of options.json back",
                    s->model.sh_degree, t->options.sh_degree);
    bool done = device_gaussians_write(&t->model, &s->model) && device_gaussians_write(&t->m, &s->m) &&
                device_gaussians_write(&t->v, &s->v) &&
                gpu_buffer_reserve(t->statistics.gradient_ndc, n * sizeof *s->gradient_sum) &&
                gpu_buffer_reserve(t->statistics.seen, n * sizeof *s->seen) &&
                gpu_buffer_write(t->statistics.gradient_ndc, s->gradient_sum, n * sizeof *s->gradient_sum) &&
                gpu_buffer_write(t->statistics.seen, s->seen, n * sizeof *s->seen);
    if (!done) return false;
    mem_free(t->id);
    t->id = mem_alloc(n, sizeof *t->id);
    if (n) memcpy(t->id, s->id, n * sizeof *t->id);
    t->next_id = s->next_id;
    t->steps_done = s->steps_done;
    t->seconds = s->seconds;
    return true;
}

static RenderSettings settings_of_step(const Trainer *t, int step) {
    RenderSettings settings = trainer_render_settings(t);
    settings.sh_degree = schedule_sh_degree(&t->options, step);
    if (t->background_is_random) {
        Rng rng = rng_at(t->options.seed, RNG_BACKGROUND, (uint32_t)step, 0);
        for (int c = 0; c < 3; c++) settings.background[c] = (float)rng_uniform(&rng);
    }
    return settings;
}

// Forward, loss, backward, Adam: all enqueued, then one wait for the loss.
static bool descend(Trainer *t, int step, int view, StepReport *report) {
    RenderSettings settings = settings_of_step(t, step);
    float rate[FIELD_COUNT];
    schedule_learning_rates(&t->options, step, t->dataset->extent, rate);
    DensityStatistics *statistics = schedule_density_is_on(&t->options, step) ? &t->statistics : NULL;
    const Shot *shot = shot_of(t, step, view);
    int splat;
    GaussianFieldId field;
    report->shrink = shot->shrink;
    bool done = opencl_render(t->rasterizer, &t->model, &shot->camera, &settings);
    gpu_stage(t->gpu, "loss");
    done = done && opencl_loss_run(t->loss, opencl_picture(t->rasterizer), shot->photo, settings.background,
                                   (float)t->options.dssim_weight);
    done = done && opencl_backward_step(t->rasterizer, t->adam, step, rate, &t->model, &t->m, &t->v, statistics);
    done = done && opencl_loss_read(t->loss, &report->loss) && opencl_adam_check(t->adam, &splat, &field);
    if (!done) return fail_context("step %d, view %s", step, t->views[view]->name);
    if (splat >= 0)
        return fail(
            "step %d, view %s: splat %d (id %u) has a gradient or parameter '%s' that is not finite; its last good "
            "numbers are kept; try a smaller learning rate",
            step, t->views[view]->name, splat, t->id[splat], GAUSSIAN_FIELDS[field].name);
    if (!isfinite(report->loss.total))
        return fail("step %d, view %s: the loss is not finite; try a smaller learning rate", step,
                    t->views[view]->name);
    return true;
}

// Where it fails the trainer keeps what it had, so that there is a model to save.
static bool check_adapted(const Gaussians *model, int step) {
    int splat;
    GaussianFieldId field;
    if (model->count == 0)
        return fail("step %d: density control would remove every splat; lower --prune-opacity, or check the cameras",
                    step);
    if (!gaussians_are_finite(model, &splat, &field))
        return fail("step %d: density control would make a splat whose '%s' is not finite; its parent has grown out of "
                    "all bounds: try a smaller --lr-log-scale",
                    step, GAUSSIAN_FIELDS[field].name);
    return true;
}

// Density control and opacity reset, when they are due after this step.
static bool adapt(Trainer *t, int step, StepReport *report) {
    const float *b = t->background;
    bool white = !t->background_is_random && b[0] == 1 && b[1] == 1 && b[2] == 1;
    bool control = schedule_density_is_due(&t->options, step);
    report->opacity_reset = schedule_reset_is_due(&t->options, step, white);
    if (!control && !report->opacity_reset) return true;
    TrainingState state;
    gpu_stage(t->gpu, "density");
    double began = clock_seconds();
    if (!trainer_get_state(t, &state)) return false;
    if (control)
        report->density =
            density_control(&t->options, step, t->dataset->extent, schedule_prunes_large(&t->options, step), &state);
    if (report->opacity_reset) density_reset_opacity(&t->options, &state);
    bool done = check_adapted(&state.model, step) && trainer_set_state(t, &state);
    training_state_destroy(&state);
    gpu_stage_host(t->gpu, 1e3 * (clock_seconds() - began));
    return done;
}

bool trainer_step(Trainer *t, StepReport *report) {
    double began = clock_seconds();
    int step = t->steps_done + 1;
    int view = schedule_view(&t->options, step, t->view_count, t->view_order, &t->epoch);
    *report = (StepReport){.step = step, .view = t->views[view]->name};
    if (!descend(t, step, view, report)) return false;
    report->frame = opencl_frame_counts(t->rasterizer);
    report->psnr = report->loss.mse > 0 ? -10 * log10(report->loss.mse) : 99;
    t->steps_done = step;
    if (!adapt(t, step, report)) return false;
    report->splats = t->model.count;
    report->seconds = clock_seconds() - began;
    t->seconds += report->seconds;
    return true;
}
