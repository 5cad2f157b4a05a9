// bench_stages.c - a rasterizer, a loss and Adam, and the rasterizer's parts once more on their own.
#include "lab/app/bench_stages.h"

#include "lab/base/mem.h"
#include "splat3d/frame_record.h"
#include "splat3d/opencl_adam.h"
#include "splat3d/opencl_blend.h"
#include "splat3d/opencl_loss.h"

#include <math.h>
#include <string.h>

const char *const BENCH_STAGE_NAMES[BENCH_STAGE_COUNT + 1] = {
    "project",          "sort", "bin",    "blend_forward", "loss", "blend_backward",
    "project_backward", "adam", "update", "frame",         "step",
};

static const float DSSIM_WEIGHT = 0.2f;

enum { MAPPED = 11 };

struct BenchStages {
    Gpu *gpu;
    Camera camera;
    RenderSettings settings;
    FrameRecord frame;
    DeviceGaussians model, gradient, m, v;
    GpuBuffer *photo;
    OpenclRasterizer *rasterizer;
    OpenclLoss *loss;
    OpenclAdam *adam;
    int steps; // Adam's

    OpenclProject project;
    OpenclBinning binning;
    OpenclBlend blend;

    GpuBuffer *mapped[MAPPED]; // by bench_stages_map()
    int mapped_count;
};

static bool create_model(BenchStages *s, const Gaussians *model) {
    const int n = model->count, degree = model->sh_degree;
    return device_gaussians_create(s->gpu, "model", n, degree, &s->model) &&
           device_gaussians_create(s->gpu, "gradient", n, degree, &s->gradient) &&
           device_gaussians_create(s->gpu, "first moment", n, degree, &s->m) &&
           device_gaussians_create(s->gpu, "second moment", n, degree, &s->v) &&
           device_gaussians_write(&s->model, model);
}

static bool create_stages(BenchStages *s, BlendKernels blend) {
    const bool is_tile_wise = blend == BLEND_AUTO ? gpu_info(s->gpu)->is_cpu : blend == BLEND_CPU;
    return opencl_project_create(s->gpu, is_tile_wise, &s->project) && opencl_binning_create(s->gpu, &s->binning) &&
           opencl_blend_create(s->gpu, is_tile_wise, &s->blend) && opencl_loss_create(s->gpu, blend, &s->loss) &&
           opencl_adam_create(s->gpu, false, &s->adam) && opencl_rasterizer_create(s->gpu, blend, &s->rasterizer);
}

bool bench_stages_create(Gpu *gpu, BlendKernels blend, const Gaussians *model, const Camera *camera,
                         const Image8 *photo, BenchStages **stages) {
    BenchStages *s = mem_alloc(1, sizeof *s);
    s->gpu = gpu;
    s->camera = *camera;
    s->settings = render_settings_default();
    *stages = s;
    if (frame_record_make(camera, &s->settings, model->count, model->sh_degree, &s->frame) && create_model(s, model) &&
        create_stages(s, blend) && opencl_photo_create(gpu, photo, &s->photo))
        return true;
    bench_stages_destroy(s);
    *stages = NULL;
    return false;
}

void bench_stages_destroy(BenchStages *s) {
    if (!s) return;
    bench_stages_unmap(s);
    opencl_rasterizer_destroy(s->rasterizer);
    opencl_loss_destroy(s->loss);
    opencl_adam_destroy(s->adam);
    opencl_project_destroy(&s->project);
    opencl_binning_destroy(&s->binning);
    opencl_blend_destroy(&s->blend);
    gpu_buffer_destroy(s->photo);
    device_gaussians_destroy(&s->model);
    device_gaussians_destroy(&s->gradient);
    device_gaussians_destroy(&s->m);
    device_gaussians_destroy(&s->v);
    mem_free(s);
}

// The picture of the stages that run alone.
static DevicePicture own_picture(BenchStages *s) {
    return (DevicePicture){
        .width = s->frame.width,
        .height = s->frame.height,
        .stride = s->frame.stride,
        .rows = s->frame.rows,
        .rgb = s->blend.rgb,
        .d_rgb = s->blend.d_rgb,
    };
}

static bool run_loss(BenchStages *s, DevicePicture picture) {
    return opencl_loss_run(s->loss, picture, s->photo, s->settings.background, DSSIM_WEIGHT);
}

static bool run_adam(BenchStages *s) {
    const float rates[FIELD_COUNT] = {0};
    return opencl_adam_step(s->adam, ++s->steps, rates, s->model.sh_degree, NULL, &s->gradient, &s->model, &s->m,
                            &s->v);
}

// project_backward and adam as a step does them.
static bool run_update(BenchStages *s, SplatRecords records) {
    const float rates[FIELD_COUNT] = {0};
    if (s->project.lanes == 1)
        return opencl_project_backward(&s->project, &s->frame, &s->model, records, NULL, &s->gradient) && run_adam(s);
    const AdamStep step = opencl_adam_prepare(s->adam, ++s->steps, rates, &s->m, &s->v);
    return opencl_project_step(&s->project, &s->frame, &s->model, records, NULL, &step);
}

static bool run_step(BenchStages *s) {
    const float rates[FIELD_COUNT] = {0};
    LossValues values;
    int splat;
    GaussianFieldId field;
    return opencl_render(s->rasterizer, &s->model, &s->camera, &s->settings) &&
           run_loss(s, opencl_picture(s->rasterizer)) &&
           opencl_backward_step(s->rasterizer, s->adam, ++s->steps, rates, &s->model, &s->m, &s->v, NULL) &&
           opencl_loss_read(s->loss, &values) && opencl_adam_check(s->adam, &splat, &field);
}

static bool enqueue(BenchStages *s, BenchStage stage) {
    const SplatRecords records = {s->binning.offset, s->binning.mask, s->blend.records};
    switch (stage) {
    case BENCH_PROJECT:
        return opencl_project_forward(&s->project, &s->frame, &s->model);
    case BENCH_SORT:
        return opencl_binning_sort(&s->binning, &s->frame, &s->project);
    case BENCH_BIN:
        return opencl_binning_lists(&s->binning, &s->frame, &s->project);
    case BENCH_BLEND_FORWARD:
        return opencl_blend_forward(&s->blend, &s->frame, &s->binning, s->project.screen);
    case BENCH_LOSS:
        return run_loss(s, own_picture(s));
    case BENCH_BLEND_BACKWARD:
        return opencl_blend_backward(&s->blend, &s->frame, &s->binning, s->project.screen);
    case BENCH_PROJECT_BACKWARD:
        return opencl_project_backward(&s->project, &s->frame, &s->model, records, NULL, &s->gradient);
    case BENCH_ADAM:
        return run_adam(s);
    case BENCH_UPDATE:
        return run_update(s, records);
    case BENCH_FRAME:
        return opencl_render(s->rasterizer, &s->model, &s->camera, &s->settings);
    case BENCH_STEP:
        return run_step(s);
    case BENCH_STAGE_COUNT:
        break;
    }
    return false;
}

bool bench_stages_run(BenchStages *s, BenchStage stage) { return enqueue(s, stage) && gpu_finish(s->gpu); }

// Pairs that are not hidden in all of their tile: those that project_backward reads a record of. 0 on failure.
static size_t record_count(const BenchStages *s) {
    void *mapped;
    size_t records = 0;
    if (!gpu_buffer_map(s->binning.mask, GPU_READ, &mapped)) return 0;
    const uint16_t *mask = mapped;
    for (long slot = 0; slot < s->binning.slots; slot++) records += mask[slot] != 0;
    return gpu_buffer_unmap(s->binning.mask) ? records : 0;
}

size_t bench_stages_bytes(const BenchStages *s, BenchStage stage) {
    const size_t n = (size_t)s->model.count,
                 learned = sizeof(float) * (size_t)gaussians_floats_per_splat(s->model.sh_degree);
    const size_t pixels = (size_t)s->frame.stride * (size_t)s->frame.rows;
    const size_t screen = sizeof(ScreenSplat) + sizeof(TileBox);
    switch (stage) {
    case BENCH_PROJECT:
        return n * (learned + screen + sizeof(float));
    case BENCH_LOSS: // picture, photograph, gradient
        return pixels * (3 * sizeof(float) + 4 + 3 * sizeof(float));
    case BENCH_PROJECT_BACKWARD:
        return n * (2 * learned + screen + sizeof(int)) + record_count(s) * sizeof(PairGradient) +
               (size_t)s->binning.slots * sizeof(uint16_t);
    case BENCH_ADAM:
        return 7 * n * learned;
    case BENCH_UPDATE:
        return n * ((s->project.lanes == 1 ? 9 : 6) * learned + screen + sizeof(int)) +
               record_count(s) * sizeof(PairGradient) + (size_t)s->binning.slots * sizeof(uint16_t);
    default:
        return 0;
    }
}

// Tiles of [centre - reach, centre + reach] in one direction.
static long tiles_of(float centre, double reach, int tiles) {
    const double low = fmax(floor((centre - reach) / TILE_SIZE), 0);
    const double high = fmin(floor((centre + reach) / TILE_SIZE) + 1, tiles);
    return high > low ? (long)(high - low) : 0;
}

// Of the square whose half side is three times the longer standard deviation.
static long square_pairs(const FrameRecord *frame, const ScreenSplat *s) {
    const double log2_e_half = -0.5 / log(2);
    const double var_u = log2_e_half / s->along_u, yy = log2_e_half / s->along_v, xy = -s->shear * yy;
    const double xx = var_u + xy * xy / yy, middle = 0.5 * (xx + yy);
    const double longest = middle + sqrt(fmax(middle * middle - var_u * yy, 0.0));
    const double reach = ceil(3 * sqrt(longest));
    return tiles_of(s->x, reach, frame->tiles_x) * tiles_of(s->y, reach, frame->tiles_y);
}

// Entries of its list that a pixel looks at: all of them, or those until T fell below the stop.
static double evaluated_pairs(const FrameRecord *frame, const NativeBlend *blend) {
    enum { TILE_PIXELS = TILE_SIZE * TILE_SIZE };
    double sum = 0;
    for (int tile = 0; tile < frame->tiles_x * frame->tiles_y; tile++) {
        const int listed = (int)(blend->start[tile + 1] - blend->start[tile]);
        for (int pixel = tile * TILE_PIXELS; pixel < (tile + 1) * TILE_PIXELS; pixel++)
            sum += blend->transmittance[pixel] < TRANSMITTANCE_STOP ? blend->last[pixel] : listed;
    }
    return sum;
}

bool bench_stages_work(BenchStages *s, BenchWork *work) {
    NativeBlend blend;
    void *mapped;
    *work = (BenchWork){.visible = s->binning.visible, .pairs = s->binning.pairs, .pairs_box = s->binning.slots};
    if (!bench_stages_map(s, &blend)) return false;
    work->evaluated = evaluated_pairs(&s->frame, &blend);
    bool done = gpu_buffer_map(s->project.box, GPU_READ, &mapped);
    const TileBox *box = mapped;
    for (int i = 0; done && i < s->frame.splat_count; i++)
        if (box[i].x0 < box[i].x1) work->pairs_square += square_pairs(&s->frame, &blend.screen[i]);
    done = done && gpu_buffer_unmap(s->project.box);
    return bench_stages_unmap(s) && done;
}

static void *map(BenchStages *s, GpuBuffer *buffer, bool *done) {
    void *pointer = NULL;
    *done = *done && gpu_buffer_map(buffer, GPU_READ_WRITE, &pointer);
    if (*done) s->mapped[s->mapped_count++] = buffer;
    return pointer;
}

bool bench_stages_map(BenchStages *s, NativeBlend *blend) {
    bool done = true;
    *blend = (NativeBlend){
        .frame = s->frame,
        .start = map(s, s->binning.start, &done),
        .list_splat = map(s, s->binning.list_splat, &done),
        .list_slot = map(s, s->binning.list_slot, &done),
        .list_mask = map(s, s->binning.list_mask, &done),
        .screen = map(s, s->project.screen, &done),
        .transmittance = map(s, s->blend.transmittance, &done),
        .last = map(s, s->blend.last, &done),
        .rgb = map(s, s->blend.rgb, &done),
        .d_rgb = map(s, s->blend.d_rgb, &done),
        .records = map(s, s->blend.records, &done),
        .mask_of_slot = map(s, s->binning.mask, &done),
    };
    return done;
}

bool bench_stages_unmap(BenchStages *s) {
    bool done = true;
    while (s->mapped_count) done = gpu_buffer_unmap(s->mapped[--s->mapped_count]) && done;
    return done;
}
