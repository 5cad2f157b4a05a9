#include "lab/app/run_profile.h"

#include "lab/base/clock.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

void run_profile_add_step(RunProfile *p, const StepReport *r) {
    if (p->steps++ == 0) {
        p->first_step_s = clock_process_age_seconds();
        p->first_step_cpu_s = clock_cpu_seconds();
    }
    p->seconds += r->seconds;
    p->splats += r->splats;
    p->visible += r->frame.visible;
    p->pairs += (double)r->frame.pairs;
}

static GpuStageTime *find_stage(RunProfile *p, const char *name) {
    for (int i = 0; i < p->stage_count; i++)
        if (strcmp(p->stage[i].stage, name) == 0) return &p->stage[i];
    assert(p->stage_count < RUN_PROFILE_STAGES_MAX);
    p->stage[p->stage_count] = (GpuStageTime){.stage = name};
    return &p->stage[p->stage_count++];
}

void run_profile_add_stages(RunProfile *p, const GpuStageTime *times, int count) {
    for (int i = 0; i < count; i++) {
        GpuStageTime *stage = find_stage(p, times[i].stage);
        stage->device_ms += times[i].device_ms;
        stage->host_ms += times[i].host_ms;
    }
}

json_t *run_profile_json(const RunProfile *p) {
    const double steps = p->steps ? p->steps : 1, ms = 1e3 * p->seconds / steps;
    double other = ms;
    json_t *stages = json_object();
    for (int i = 0; i < p->stage_count; i++) {
        const double stage_ms = (p->stage[i].device_ms + p->stage[i].host_ms) / steps;
        json_object_set_new(stages, p->stage[i].stage, json_real(stage_ms));
        other -= stage_ms;
    }
    json_object_set_new(stages, "other", json_real(other));
    return json_pack("{si sf sf sf sf so}", "steps", p->steps, "ms", ms, "splats", p->splats / steps, "visible",
                     p->visible / steps, "pairs", p->pairs / steps, "stages_ms", stages);
}

void run_profile_print(const RunProfile *p) {
    json_t *profile = run_profile_json(p), *stages = json_object_get(profile, "stages_ms"), *value;
    const double ms = json_real_value(json_object_get(profile, "ms"));
    const char *stage;
    printf("%d steps with %.0f splats in the mean, %.0f of them in view, %.0f (tile, splat) pairs\n", p->steps,
           json_real_value(json_object_get(profile, "splats")), json_real_value(json_object_get(profile, "visible")),
           json_real_value(json_object_get(profile, "pairs")));
    printf("%-18s %9s %7s\n", "stage", "ms a step", "share");
    json_object_foreach(stages, stage, value)
        printf("%-18s %9.3f %5.1f %%\n", stage, json_real_value(value), ms > 0 ? 100 * json_real_value(value) / ms : 0);
    printf("%-18s %9.3f\n", "all", ms);
    printf("the first step was done %.2f s after the program's start (%.2f s of work)\n", p->first_step_s,
           p->first_step_cpu_s);
    json_decref(profile);
}
