// bench_scaling.c - a child process for each thread count sends its rows through a pipe as JSON.
#include "lab/app/bench_scaling.h"

#include "lab/app/bench_fit.h"
#include "lab/app/bench_measure.h"
#include "lab/base/fail.h"
#include "lab/base/log.h"
#include "splat3d/bench_scene.h"
#include "splat3d/morton_order.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

static const int SPLATS[] = {5000, 20000, 100000, 400000};
static const int SIZES_PX[][2] = {{270, 480}, {640, 480}, {1280, 720}};
enum { SPLATS_COUNT = sizeof SPLATS / sizeof SPLATS[0], SIZE_COUNT = sizeof SIZES_PX / sizeof SIZES_PX[0] };

typedef struct {
    const char *device, *kernels;
    BlendKernels blend;
    uint64_t seed;
    int rounds, threads;
} Plan;

void bench_set_threads(int threads) {
    char text[16];
    snprintf(text, sizeof text, "%d", threads);
    setenv("POCL_MAX_PTHREAD_COUNT", text, 1);
    setenv("SPLATLAB_THREADS", text, 1);
}

static json_t *row_of(const Plan *plan, const Camera *camera, int splats, const BenchResult *r) {
    const BenchFigure *stage = r->stage;
    return json_pack("{si si si si sI sf sf sf sf sf sf}", "threads", plan->threads, "width", camera->width, "height",
                     camera->height, "splats", splats, "tile_pairs", (json_int_t)r->work.pairs, "evaluated_pairs",
                     r->work.evaluated, "blend_forward_ms", stage[BENCH_BLEND_FORWARD].ms, "blend_backward_ms",
                     stage[BENCH_BLEND_BACKWARD].ms, "blend_cpu_ms",
                     stage[BENCH_BLEND_FORWARD].cpu_ms + stage[BENCH_BLEND_BACKWARD].cpu_ms, "frame_ms",
                     stage[BENCH_FRAME].ms, "step_ms", stage[BENCH_STEP].ms);
}

static bool measure_row(Gpu *gpu, const Plan *plan, int splats, const int size_px[2], json_t *rows) {
    static const bool WANTED[BENCH_STAGE_COUNT] = {
        [BENCH_BLEND_FORWARD] = true, [BENCH_BLEND_BACKWARD] = true, [BENCH_FRAME] = true, [BENCH_STEP] = true};
    const Camera camera = bench_scene_camera(size_px[0], size_px[1]);
    Gaussians model = bench_scene_gaussians(plan->seed, splats, &camera);
    Image8 photo = bench_scene_photo(plan->seed, camera.width, camera.height);
    morton_arrange(&model); // as training keeps its splats
    BenchStages *stages = NULL;
    BenchResult result;
    log_info("bench: %d splats at %dx%d px, %d threads", splats, camera.width, camera.height, plan->threads);
    bool done = bench_stages_create(gpu, plan->blend, &model, &camera, &photo, &stages) &&
                bench_measure(gpu, stages, WANTED, plan->rounds, false, &result);
    bench_stages_destroy(stages);
    image8_destroy(&photo);
    gaussians_destroy(&model);
    if (done) json_array_append_new(rows, row_of(plan, &camera, splats, &result));
    return done;
}

static bool measure_all(const Plan *plan, json_t *rows) {
    Gpu *gpu;
    bench_set_threads(plan->threads);
    if (plan->kernels[0]) gpu_set_kernel_folder(plan->kernels);
    if (!gpu_open(plan->device, &gpu)) return false;
    bool done = true;
    for (int size = 0; size < SIZE_COUNT; size++)
        for (int n = 0; done && n < SPLATS_COUNT; n++) done = measure_row(gpu, plan, SPLATS[n], SIZES_PX[size], rows);
    gpu_close(gpu);
    return done;
}

// Never returns.
static void child(const Plan *plan, FILE *out) {
    json_t *rows = json_array();
    bool done = measure_all(plan, rows);
    json_t *answer = done ? json_pack("{sO}", "rows", rows) : json_pack("{ss}", "error", fail_text());
    json_dumpf(answer, out, JSON_COMPACT | JSON_REAL_PRECISION(9));
    json_decref(answer);
    json_decref(rows);
    fclose(out);
    _exit(done ? 0 : 1);
}

static bool measure_in_child(const Plan *plan, json_t *rows) {
    int ends[2], status;
    if (pipe(ends) != 0) return fail("cannot open a pipe to a process for %d threads", plan->threads);
    fflush(NULL);
    const pid_t process = fork();
    if (process == 0) {
        close(ends[0]);
        child(plan, fdopen(ends[1], "w"));
    }
    close(ends[1]);
    if (process < 0) {
        close(ends[0]);
        return fail("cannot start a process for %d threads", plan->threads);
    }
    json_t *answer = json_loadfd(ends[0], 0, NULL);
    close(ends[0]);
    waitpid(process, &status, 0);
    const char *error = json_string_value(json_object_get(answer, "error"));
    bool done = json_object_get(answer, "rows") != NULL;
    if (done)
        json_array_extend(rows, json_object_get(answer, "rows"));
    else
        fail("the process for %d threads failed: %s", plan->threads, error ? error : "it ended without an answer");
    json_decref(answer);
    return done;
}

static double number(const json_t *row, const char *key) { return json_number_value(json_object_get(row, key)); }

bool bench_scaling_run(const char *device, const char *kernels, BlendKernels blend, uint64_t seed, int rounds,
                       int most_threads, json_t **root) {
    json_t *rows = json_array();
    const int counts = most_threads > 1 ? 2 : 1;
    bool done = true;
    *root = json_pack("{sO so}", "rows", rows, "fits", json_array());
    for (int i = 0; done && i < counts; i++) {
        const Plan plan = {device, kernels, blend, seed, rounds, i ? most_threads : 1};
        done = measure_in_child(&plan, rows);
        if (done) json_array_append_new(json_object_get(*root, "fits"), bench_fit_rows(rows, plan.threads));
    }
    json_decref(rows);
    if (!done) json_decref(*root);
    return done;
}

void bench_scaling_print(const json_t *root) {
    size_t i;
    const json_t *row;
    printf("threads      size   splats  tile pairs  evaluated   forward  backward  ns/pair     frame      step\n");
    json_array_foreach(json_object_get(root, "rows"), i, row)
        printf("%7.0f %5.0fx%-4.0f %7.0f %11.0f %8.2f M %6.2f ms %6.2f ms %8.3f %6.2f ms %6.2f ms\n",
               number(row, "threads"), number(row, "width"), number(row, "height"), number(row, "splats"),
               number(row, "tile_pairs"), 1e-6 * number(row, "evaluated_pairs"), number(row, "blend_forward_ms"),
               number(row, "blend_backward_ms"), 1e6 * number(row, "blend_cpu_ms") / number(row, "evaluated_pairs"),
               number(row, "frame_ms"), number(row, "step_ms"));
    json_array_foreach(json_object_get(root, "fits"), i, row) {
        const json_t *pairs = json_object_get(row, "evaluated_pairs"),
                     *all = json_object_get(row, "pixels_times_splats"), *law = json_object_get(row, "law");
        printf("threads %.0f: cost of both blends ~ evaluated pairs^%.2f (scatter %.0f %%), ~ (pixels x splats)^%.2f "
               "(scatter %.0f %%)\n",
               number(row, "threads"), number(pairs, "exponent"), 100 * number(pairs, "scatter"),
               number(all, "exponent"), 100 * number(all, "scatter"));
        printf("   CPU time of both blends = %.2f ns x evaluated pairs + %.1f ns x tile pairs + %.1f ns x pixels, "
               "within %.0f %% "
               "(at most %.0f %%)\n",
               number(law, "ns_per_evaluated_pair"), number(law, "ns_per_tile_pair"), number(law, "ns_per_pixel"),
               100 * number(law, "scatter"), 100 * number(law, "worst"));
    }
}
