// cmd_bench.c - `splatlab bench`: how long each stage takes, and how near that is to what the machine could do.
#include "lab/app/bench_measure.h"
#include "lab/app/bench_scaling.h"
#include "lab/app/commands.h"
#include "lab/base/fail.h"
#include "lab/base/log.h"
#include "lab/base/nearest.h"
#include "lab/base/parallel.h"
#include "lab/io/json_io.h"
#include "splat3d/bench_scene.h"
#include "splat3d/morton_order.h"
#include "splat3d/ply.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct {
    char stage[OPTION_TEXT_BYTES];
    int splats, size_px[2];
    char model[OPTION_TEXT_BYTES], camera[OPTION_TEXT_BYTES];
    bool scaling;
    int threads, rounds;
    uint64_t seed;
    char device[OPTION_TEXT_BYTES], kernels[OPTION_TEXT_BYTES];
    int blend; // BlendKernels
    bool quiet, json;
} Options;

static const char *const BLENDS[] = {"auto", "cpu", "gpu", NULL};

static const OptionField FIELDS[] = {
    {.name = "stage",
     .type = OPTION_TEXT,
     .offset = offsetof(Options, stage),
     .help = "only these, with commas: project, sort, bin, blend_forward, loss, blend_backward, project_backward, "
             "adam, update (the last two at once), frame, step",
     .section = "What is measured"},
    {.name = "splats",
     .type = OPTION_INT,
     .offset = offsetof(Options, splats),
     .low = 1,
     .high = 20000000,
     .unit = "splats",
     .help = "of the standard scene"},
    {.name = "size",
     .type = OPTION_SIZE,
     .offset = offsetof(Options, size_px),
     .low = 1,
     .high = 32768,
     .unit = "px",
     .help = "of the picture"},
    {.name = "model",
     .type = OPTION_TEXT,
     .offset = offsetof(Options, model),
     .help = "this .ply, put in Morton order, instead of the standard scene"},
    {.name = "camera",
     .type = OPTION_TEXT,
     .offset = offsetof(Options, camera),
     .help = "CAM.json to see the model with; else from the origin along +z, 60 degrees wide"},
    {.name = "scaling",
     .type = OPTION_FLAG,
     .offset = offsetof(Options, scaling),
     .help = "instead: 5k to 400k splats in three sizes, with one thread and with all"},
    {.name = "threads",
     .type = OPTION_INT,
     .offset = offsetof(Options, threads),
     .low = 1,
     .high = 256,
     .help = "of a CPU device and of native code"},
    {.name = "rounds",
     .type = OPTION_INT,
     .offset = offsetof(Options, rounds),
     .low = 1,
     .high = 10000,
     .help = "figures are medians over so many"},
    {.name = "seed",
     .type = OPTION_U64,
     .offset = offsetof(Options, seed),
     .low = 0,
     .high = 1e18,
     .help = "of the scene"},
    {OPTION_DEVICE_OF(Options), .section = "Device and output"},
    {OPTION_KERNELS_OF(Options)},
    {.name = "blend",
     .type = OPTION_CHOICE,
     .offset = offsetof(Options, blend),
     .choices = BLENDS,
     .high = 2,
     .help = "which blend kernels: made for a CPU, for a GPU, or by the device"},
    {.name = "quiet",
     .letter = 'q',
     .type = OPTION_FLAG,
     .offset = offsetof(Options, quiet),
     .help = "only warnings and errors on stderr"},
    {OPTION_JSON_OF(Options, "the figures")},
};

// "bin,adam" -> wanted; all for "".
static bool parse_stages(const char *text, bool wanted[BENCH_STAGE_COUNT]) {
    for (int k = 0; k < BENCH_STAGE_COUNT; k++) wanted[k] = !text[0];
    while (*text) {
        char name[32] = "";
        const size_t length = strcspn(text, ",");
        snprintf(name, sizeof name, "%.*s", (int)length, text);
        int k = 0, best;
        while (k < BENCH_STAGE_COUNT && strcmp(name, BENCH_STAGE_NAMES[k]) != 0) k++;
        if (k == BENCH_STAGE_COUNT && nearest_find(name, BENCH_STAGE_NAMES, BENCH_STAGE_COUNT, &best, 1))
            return fail_usage("--stage: there is no stage '%s'; did you mean %s?", name, BENCH_STAGE_NAMES[best]);
        if (k == BENCH_STAGE_COUNT)
            return fail_usage("--stage: there is no stage '%s'; splatlab bench --help lists them", name);
        wanted[k] = true;
        text += length + (text[length] == ',');
    }
    return true;
}

// The model, in the order in which training keeps its splats, and the camera that sees it.
static bool find_scene(const Options *o, Gaussians *model, Camera *camera) {
    *camera = bench_scene_camera(o->size_px[0], o->size_px[1]);
    if (o->camera[0] && !o->model[0]) return fail_usage("--camera sees a --model; the standard scene has its own");
    if (o->camera[0] && !camera_load_json(o->camera, camera)) return false;
    if (!o->model[0])
        *model = bench_scene_gaussians(o->seed, o->splats, camera);
    else if (!ply_load(o->model, model))
        return false;
    morton_arrange(model);
    return true;
}

static void set_number(json_t *object, const char *key, double value) {
    if (!isnan(value)) json_object_set_new(object, key, json_real(value));
}

static json_t *figures_of(const BenchResult *result) {
    json_t *list = json_array();
    for (BenchStage k = 0; k < BENCH_STAGE_COUNT; k++) {
        const BenchFigure *f = &result->stage[k];
        if (!f->is_measured) continue;
        json_t *stage = json_pack("{ss sf sf}", "name", BENCH_STAGE_NAMES[k], "ms", f->ms, "cpu_ms", f->cpu_ms);
        if (!isnan(f->ns_per_pair))
            json_object_set_new(stage, "pairs", json_integer((json_int_t)result->work.evaluated));
        set_number(stage, "ns_per_pair", f->ns_per_pair);
        set_number(stage, "gbps", f->gbps);
        set_number(stage, "native_ms", f->native_ms);
        set_number(stage, "ratio_native", f->ratio_native);
        json_array_append_new(list, stage);
    }
    return list;
}

static json_t *facts_of(const Options *o, const Gpu *gpu, const Gaussians *model, const Camera *camera,
                        const BenchResult *result) {
    const BenchWork *work = &result->work;
    return json_pack("{ss si ss* si si si si si sI sI sI sI si so}", "device", gpu_info(gpu)->name, "threads",
                     parallel_threads(), "native", native_blend_name(), "splats", model->count, "sh_degree",
                     model->sh_degree, "width", camera->width, "height", camera->height, "visible", work->visible,
                     "tile_pairs", (json_int_t)work->pairs, "tile_pairs_box", (json_int_t)work->pairs_box,
                     "tile_pairs_square", (json_int_t)work->pairs_square, "evaluated_pairs",
                     (json_int_t)work->evaluated, "rounds", o->rounds, "stages", figures_of(result));
}

static void print_cell(double value, const char *format) {
    if (isnan(value))
        printf("%10s", "");
    else
        printf(format, value);
}

static void print_table(const json_t *facts, const BenchResult *result) {
    const BenchWork *work = &result->work;
    const char *native = json_string_value(json_object_get(facts, "native"));
    printf("%s, %lld threads; %lld splats, %lldx%lld px, median of %lld rounds\n",
           json_string_value(json_object_get(facts, "device")), json_integer_value(json_object_get(facts, "threads")),
           json_integer_value(json_object_get(facts, "splats")), json_integer_value(json_object_get(facts, "width")),
           json_integer_value(json_object_get(facts, "height")), json_integer_value(json_object_get(facts, "rounds")));
    printf("%d splats in view; (tile, splat) pairs: %ld (%ld in boxes, %ld in squares of 3 sigma); "
           "(pixel, splat) pairs evaluated: %.2f M\n",
           work->visible, work->pairs, work->pairs_box, work->pairs_square, 1e-6 * work->evaluated);
    printf("ceilings: blends in native C with %s, the others by memcpy\n\n",
           native ? native : "nothing (no AVX2 here)");
    printf("%-17s%10s%10s%10s%10s%10s%10s\n", "stage", "ms", "cpu ms", "ns/pair", "GB/s", "ceiling", "ratio");
    for (BenchStage k = 0; k < BENCH_STAGE_COUNT; k++) {
        const BenchFigure *f = &result->stage[k];
        if (!f->is_measured) continue;
        printf("%-17s", BENCH_STAGE_NAMES[k]);
        print_cell(f->ms, "%10.2f");
        print_cell(f->cpu_ms, "%10.2f");
        print_cell(f->ns_per_pair, "%10.3f");
        print_cell(f->gbps, "%10.1f");
        print_cell(f->native_ms, "%10.2f");
        print_cell(f->ratio_native, "%10.2f");
        putchar('\n');
    }
}

static bool bench_scene(const Options *o, const bool *wanted) {
    Gpu *gpu = NULL;
    BenchStages *stages = NULL;
    Gaussians model = {0};
    Image8 photo = {0};
    Camera camera;
    BenchResult result;
    if (o->kernels[0]) gpu_set_kernel_folder(o->kernels);
    bool done = find_scene(o, &model, &camera) && gpu_open(o->device, &gpu);
    if (done) photo = bench_scene_photo(o->seed, camera.width, camera.height);
    done = done && bench_stages_create(gpu, (BlendKernels)o->blend, &model, &camera, &photo, &stages) &&
           bench_measure(gpu, stages, wanted, o->rounds, true, &result);
    if (done) {
        json_t *facts = facts_of(o, gpu, &model, &camera, &result);
        if (o->json)
            json_print(facts);
        else
            print_table(facts, &result);
        json_decref(facts);
    }
    bench_stages_destroy(stages);
    image8_destroy(&photo);
    gaussians_destroy(&model);
    gpu_close(gpu);
    return done;
}

static bool bench_scaling(const Options *o) {
    json_t *root;
    const char *other = o->stage[0] ? "stage" : o->model[0] ? "model" : o->camera[0] ? "camera" : NULL;
    if (other) return fail_usage("--scaling measures the standard scene in its own sizes; leave --%s away", other);
    if (!bench_scaling_run(o->device, o->kernels, (BlendKernels)o->blend, o->seed, o->rounds, o->threads, &root))
        return false;
    if (o->json)
        json_print(root);
    else
        bench_scaling_print(root);
    json_decref(root);
    return true;
}

static int cmd_bench(int argc, char **argv) {
    const Options defaults = {.splats = 100000,
                              .size_px = {640, 480},
                              .threads = parallel_threads(),
                              .rounds = 11,
                              .seed = 1,
                              .device = "auto"};
    const OptionTable table = {FIELDS, sizeof FIELDS / sizeof FIELDS[0], &defaults};
    Options options = defaults;
    bool wanted[BENCH_STAGE_COUNT];
    int count, exit_code;
    if (!command_line_parse(&CMD_BENCH, &table, argc, argv, &options, NULL, 0, &count, &exit_code)) return exit_code;
    log_set_quiet(options.quiet);
    if (!parse_stages(options.stage, wanted)) return command_failed();
    bench_set_threads(options.threads);
    const bool done = options.scaling ? bench_scaling(&options) : bench_scene(&options, wanted);
    return done ? 0 : command_failed();
}

const Command CMD_BENCH = {
    .name = "bench",
    .arguments = "",
    .summary = "measure how long each stage takes on this machine, beside what the machine could do at best",
    .details =
        "Stages and their ceilings run in turn, and the figures are medians. ns/pair is time on a core for each\n"
        "(pixel, splat) pair that has to be looked at; ratio is the time as a multiple of the ceiling's.\n\n"
        "  splatlab bench\n"
        "  splatlab bench --stage blend_forward,blend_backward --splats 20000 --size 1280x720\n"
        "  splatlab bench --model run/model.ply --camera cam.json\n"
        "  splatlab bench --scaling",
    .run = cmd_bench,
};
