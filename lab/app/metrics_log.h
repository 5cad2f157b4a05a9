// metrics_log.h - RUN/metrics.jsonl: what training measured, one JSON object a line, in the order of the steps.
//
// A line of a step: {"iteration", "loss", "l1", "ssim", "psnr" (of the view that the step saw), "splats", "visible", "pairs", "seconds",
// "ms": {stage: milliseconds per step since the line before}}; with "cloned", "split", "pruned" and "opacity_reset" when density
// control ran, and with "shrink" when the view was used at 1/shrink of its size (--coarse-levels): l1, ssim and psnr are of that size.
// A line of an evaluation: {"iteration", "held_out": {"psnr", "ssim", "psnr8"}}.
#ifndef SPLATLAB_LAB_APP_METRICS_LOG_H
#define SPLATLAB_LAB_APP_METRICS_LOG_H

#include "splat3d/evaluate.h"
#include "splat3d/trainer.h"

#include <stdio.h>

typedef struct {
    FILE *file;
    char *path;
    int logged_step; // of the line before
} MetricsLog;

// Opens the file to go on behind step `steps_done`: lines of later steps (of a run that was killed after its last checkpoint) are dropped.
bool metrics_log_open(const char *path, int steps_done, MetricsLog *log);

// seconds: spent training so far. times: of the stages since the line before.
bool metrics_log_step(MetricsLog *log, const StepReport *report, double seconds, const GpuStageTime *times,
                      int time_count);
bool metrics_log_evaluation(MetricsLog *log, int step, const Evaluation *evaluation);

void metrics_log_close(MetricsLog *log); // accepts a zeroed one

#endif
