// bench_measure.c - a round runs every stage and its ceiling once, one after the other, so that a noisy minute hits both.
#include "lab/app/bench_measure.h"

#include "lab/app/bench_ceiling.h"
#include "lab/base/clock.h"
#include "lab/base/mem.h"

#include <math.h>
#include <stdlib.h>

enum { WARM_UP_ROUNDS = 2 }; // kernels are compiled, buffers grown, pages touched

typedef enum { WALL, CPU, CEILING, RATIO, SERIES_COUNT } Series;

// values[stage][series][round]
typedef struct {
    int rounds;
    double *values;
} Samples;

static double *samples_at(const Samples *s, int stage, Series series) {
    return s->values + (size_t)(stage * SERIES_COUNT + (int)series) * (size_t)s->rounds;
}

static int compare_numbers(const void *left, const void *right) {
    const double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

static double median(double *values, int count) {
    qsort(values, (size_t)count, sizeof *values, compare_numbers);
    return count % 2 ? values[count / 2] : 0.5 * (values[count / 2 - 1] + values[count / 2]);
}

static bool run_stage(BenchStages *stages, BenchStage stage, const Samples *samples, int round) {
    const double began_s = clock_seconds(), cpu_s = clock_cpu_seconds();
    if (!bench_stages_run(stages, stage)) return false;
    if (round < 0) return true;
    samples_at(samples, stage, WALL)[round] = 1e3 * (clock_seconds() - began_s);
    samples_at(samples, stage, CPU)[round] = 1e3 * (clock_cpu_seconds() - cpu_s);
    return true;
}

static bool run_ceiling(BenchCeiling *ceiling, BenchStage stage, const Samples *samples, int round) {
    double ms;
    if (!ceiling || !bench_ceiling_exists(ceiling, stage)) return true;
    if (!bench_ceiling_run(ceiling, stage, &ms)) return false;
    if (round < 0) return true;
    samples_at(samples, stage, CEILING)[round] = ms;
    samples_at(samples, stage, RATIO)[round] = samples_at(samples, stage, WALL)[round] / ms;
    return true;
}

// Warm-up rounds run every stage, so that each finds what it reads; their number is negative.
static bool run_rounds(BenchStages *stages, BenchCeiling *ceiling, const bool *wanted, const Samples *samples) {
    for (int round = -WARM_UP_ROUNDS; round < samples->rounds; round++)
        for (BenchStage stage = 0; stage < BENCH_STAGE_COUNT; stage++) {
            const bool is_needed = wanted[stage] || (round < 0 && stage <= BENCH_ADAM);
            if (!is_needed) continue;
            if (!run_stage(stages, stage, samples, round) || !run_ceiling(ceiling, stage, samples, round)) return false;
        }
    return true;
}

static bool counts_pairs(BenchStage stage) {
    return stage == BENCH_BLEND_FORWARD || stage == BENCH_BLEND_BACKWARD || stage == BENCH_FRAME || stage == BENCH_STEP;
}

static BenchFigure summarize(const Samples *samples, BenchStage stage, double evaluated, size_t bytes,
                             bool has_ceiling) {
    BenchFigure figure = {.is_measured = true, .ns_per_pair = NAN, .gbps = NAN, .native_ms = NAN, .ratio_native = NAN};
    const int n = samples->rounds;
    figure.ms = median(samples_at(samples, stage, WALL), n);
    figure.cpu_ms = median(samples_at(samples, stage, CPU), n);
    if (counts_pairs(stage) && evaluated > 0) figure.ns_per_pair = 1e6 * figure.cpu_ms / evaluated;
    if (bytes) figure.gbps = (double)bytes / (1e6 * figure.ms);
    if (has_ceiling) {
        figure.native_ms = median(samples_at(samples, stage, CEILING), n);
        figure.ratio_native = median(samples_at(samples, stage, RATIO), n);
    }
    return figure;
}

bool bench_measure(Gpu *gpu, BenchStages *stages, const bool wanted[BENCH_STAGE_COUNT], int rounds, bool with_ceiling,
                   BenchResult *result) {
    *result = (BenchResult){0};
    BenchCeiling *ceiling = with_ceiling ? bench_ceiling_create(gpu, stages) : NULL;
    Samples samples = {rounds, mem_alloc((size_t)(BENCH_STAGE_COUNT * SERIES_COUNT) * (size_t)rounds, sizeof(double))};
    bool done = run_rounds(stages, ceiling, wanted, &samples) && bench_stages_work(stages, &result->work);
    if (done && ceiling && bench_ceiling_exists(ceiling, BENCH_BLEND_FORWARD)) done = bench_ceiling_check(ceiling);
    for (BenchStage stage = 0; done && stage < BENCH_STAGE_COUNT; stage++)
        if (wanted[stage])
            result->stage[stage] = summarize(&samples, stage, result->work.evaluated, bench_stages_bytes(stages, stage),
                                             ceiling && bench_ceiling_exists(ceiling, stage));
    bench_ceiling_destroy(ceiling);
    mem_free(samples.values);
    return done;
}
