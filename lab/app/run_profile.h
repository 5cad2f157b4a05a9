// run_profile.h - where the time of a training run went: milliseconds a step by stage, beside how many splats there were.
//
// Counts the steps of this process alone: a resumed run begins at zero.
#ifndef SPLATLAB_LAB_APP_RUN_PROFILE_H
#define SPLATLAB_LAB_APP_RUN_PROFILE_H

#include "lab/gpu/gpu.h"
#include "splat3d/trainer.h"

#include <jansson.h>

enum { RUN_PROFILE_STAGES_MAX = 16 };

typedef struct {
    int steps;
    double seconds;                             // all steps together, as the trainer took them
    double splats, visible, pairs;              // sums over the steps
    double first_step_s;                        // from the start of the process to the end of its first step
    double first_step_cpu_s;                    // what its threads had worked by then, all together
    GpuStageTime stage[RUN_PROFILE_STAGES_MAX]; // sums, in the order of first use
    int stage_count;
} RunProfile;

void run_profile_add_step(RunProfile *profile, const StepReport *report);
void run_profile_add_stages(RunProfile *profile, const GpuStageTime *times, int count); // of gpu_stage_times()

// {"steps", "ms" (a step), "splats", "visible", "pairs" (means over the steps), "stages_ms": {stage: ms a step, .., "other"}}; "other" is
// what no stage explains: waiting for threads, launching. The caller owns it. Without a step all figures are 0.
json_t *run_profile_json(const RunProfile *profile);

void run_profile_print(const RunProfile *profile); // the same as a table on stdout

#endif
