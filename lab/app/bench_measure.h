// bench_measure.h - times stages and their ceilings side by side, round by round, and takes medians.
#ifndef SPLATLAB_LAB_APP_BENCH_MEASURE_H
#define SPLATLAB_LAB_APP_BENCH_MEASURE_H

#include "lab/app/bench_stages.h"

// Medians over the rounds of one stage; NAN for what does not apply.
typedef struct {
    bool is_measured;
    double ms;           // until the stage is done, and waited for
    double cpu_ms;       // of all threads: what other programs take does not count
    double ns_per_pair;  // CPU nanoseconds per (pixel, splat) pair; the blends, frame and step
    double gbps;         // bytes that have to be moved, per second; stages that wait for memory
    double native_ms;    // the ceiling's
    double ratio_native; // ms / native_ms of the same round
} BenchFigure;

typedef struct {
    BenchWork work;
    BenchFigure stage[BENCH_STAGE_COUNT];
} BenchResult;

// with_ceiling: measure the ceilings too, and check that native code and kernels agree. rounds >= 1.
bool bench_measure(Gpu *gpu, BenchStages *stages, const bool wanted[BENCH_STAGE_COUNT], int rounds, bool with_ceiling,
                   BenchResult *result);

#endif
