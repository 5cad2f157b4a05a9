// Every launch of a stage leaves an event; events are summed and released when the queue is empty anyway (a map, a finish), or
// when the ring of them is full. Nothing here allocates on the host.

#include "lab/gpu/opencl.h"

#include <assert.h>
#include <string.h>

// Index of the stage's sums; a new name begins at zero.
static int stage_index(Stages *stages, const char *name) {
    for (int i = 0; i < stages->count; i++)
        if (stages->times[i].stage == name || !strcmp(stages->times[i].stage, name)) return i;
    assert(stages->count < STAGES_MAX);
    stages->times[stages->count] = (GpuStageTime){.stage = name};
    return stages->count++;
}

void gpu_stage(Gpu *gpu, const char *stage) { gpu->stages.current = stage ? stage_index(&gpu->stages, stage) : -1; }

void gpu_stage_host(Gpu *gpu, double ms) {
    if (gpu->stages.current >= 0) gpu->stages.times[gpu->stages.current].host_ms += ms;
}

cl_event *stage_next_event(Gpu *gpu) {
    Stages *stages = &gpu->stages;
    if (stages->current < 0) return NULL;
    if (stages->event_count == STAGE_EVENTS_MAX) {
        clWaitForEvents(1, &stages->events[STAGE_EVENTS_MAX - 1]); // the queue is in order: all others are done too
        stage_collect(gpu);
    }
    stages->event_stage[stages->event_count] = stages->current;
    return &stages->events[stages->event_count++];
}

void stage_collect(Gpu *gpu) {
    Stages *stages = &gpu->stages;
    for (int i = 0; i < stages->event_count; i++) {
        cl_event event = stages->events[i];
        if (!event) continue; // its launch failed
        cl_ulong start = 0, end = 0;
        bool timed = clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_START, sizeof start, &start, NULL) == 0 &&
                     clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_END, sizeof end, &end, NULL) == 0;
        if (timed && end > start) stages->times[stages->event_stage[i]].device_ms += (double)(end - start) * 1e-6;
        clReleaseEvent(event);
        stages->events[i] = NULL;
    }
    stages->event_count = 0;
}

bool gpu_stage_times(Gpu *gpu, const GpuStageTime **times, int *count) {
    Stages *stages = &gpu->stages;
    if (!gpu_finish(gpu)) return false;
    memcpy(stages->given, stages->times, sizeof stages->times);
    for (int i = 0; i < stages->count; i++) stages->times[i].device_ms = stages->times[i].host_ms = 0;
    *times = stages->given;
    *count = stages->count;
    return true;
}
