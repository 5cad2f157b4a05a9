#include "splat3d/opencl_project.h"

#include <assert.h>
#include <string.h>

enum {
    LANES_CPU = SPLAT_GROUP, // splats of one work-item
    GROUP_CPU = 4,           // work-items
    GROUP_GPU = 64,
};

static const char *options(const OpenclProject *project) { return project->lanes == 1 ? "" : "-D LANES=16"; }

bool opencl_project_create(Gpu *gpu, bool is_vectorised, OpenclProject *project) {
    *project = (OpenclProject){.gpu = gpu, .lanes = is_vectorised ? LANES_CPU : 1};
    if (gpu_program_create(gpu, "project_forward.cl", options(project), &project->forward_program) &&
        gpu_kernel(project->forward_program, "project_forward", &project->forward) &&
        gpu_buffer_create(gpu, "screen splats", 0, &project->screen) &&
        gpu_buffer_create(gpu, "tile boxes", 0, &project->box) && gpu_buffer_create(gpu, "depths", 0, &project->depth))
        return true;
    opencl_project_destroy(project);
    return false;
}

void opencl_project_destroy(OpenclProject *project) {
    gpu_buffer_destroy(project->screen);
    gpu_buffer_destroy(project->box);
    gpu_buffer_destroy(project->depth);
    gpu_program_destroy(project->forward_program);
    gpu_program_destroy(project->backward_program);
    gpu_program_destroy(project->step_program);
    *project = (OpenclProject){0};
}

// A field's buffer; for one that the model does not have, which the kernel will not touch, any other.
static GpuArg field_arg(const DeviceGaussians *g, GaussianFieldId id) {
    return gpu_buffer_arg(g->field[id] ? g->field[id] : g->field[FIELD_SH0]);
}

static size_t round_up(size_t n, size_t multiple) { return (n + multiple - 1) / multiple * multiple; }

static GpuRange splats(const OpenclProject *project, size_t n) {
    return gpu_range(round_up(n, project->lanes) / project->lanes, project->lanes == 1 ? GROUP_GPU : GROUP_CPU);
}

bool opencl_project_forward(OpenclProject *project, const FrameRecord *frame, const DeviceGaussians *model) {
    const size_t n = (size_t)frame->splat_count, room = round_up(n, project->lanes);
    if (!gpu_buffer_reserve(project->screen, room * sizeof(ScreenSplat)) ||
        !gpu_buffer_reserve(project->box, room * sizeof(TileBox)) ||
        !gpu_buffer_reserve(project->depth, room * sizeof(float)))
        return false;
    return gpu_launch(project->forward, splats(project, n), gpu_record_arg(frame, sizeof *frame),
                      field_arg(model, FIELD_MEAN), field_arg(model, FIELD_LOG_SCALE), field_arg(model, FIELD_QUAT),
                      field_arg(model, FIELD_OPACITY_LOGIT), field_arg(model, FIELD_SH0), field_arg(model, FIELD_SH1),
                      field_arg(model, FIELD_SH2), field_arg(model, FIELD_SH3), gpu_buffer_arg(project->screen),
                      gpu_buffer_arg(project->box), gpu_buffer_arg(project->depth));
}

static bool create_kernel(const OpenclProject *project, const char *how, const char *name, GpuProgram **program,
                          GpuKernel **kernel) {
    gpu_program_destroy(*program); // of an attempt that failed
    return gpu_program_create(project->gpu, "project_backward.cl", how, program) && gpu_kernel(*program, name, kernel);
}

// The arguments that the gradients' two kernels have in common, first of both.
enum { COMMON_ARGS = 16 };

static void common_args(const OpenclProject *project, const FrameRecord *frame, const DeviceGaussians *model,
                        SplatRecords records, const DensityStatistics *statistics, GpuArg *args) {
    const GpuArg common[COMMON_ARGS] = {
        gpu_record_arg(frame, sizeof *frame),
        field_arg(model, FIELD_MEAN),
        field_arg(model, FIELD_LOG_SCALE),
        field_arg(model, FIELD_QUAT),
        field_arg(model, FIELD_OPACITY_LOGIT),
        field_arg(model, FIELD_SH1),
        field_arg(model, FIELD_SH2),
        field_arg(model, FIELD_SH3),
        gpu_buffer_arg(project->screen),
        gpu_buffer_arg(project->box),
        gpu_buffer_arg(records.offset),
        gpu_buffer_arg(records.mask),
        gpu_buffer_arg(records.records),
        gpu_int_arg(statistics != NULL),
        gpu_buffer_arg(statistics ? statistics->gradient_ndc : project->depth),
        gpu_buffer_arg(statistics ? statistics->seen : project->box),
    };
    memcpy(args, common, sizeof common);
}

bool opencl_project_backward(OpenclProject *project, const FrameRecord *frame, const DeviceGaussians *model,
                             SplatRecords records, const DensityStatistics *statistics, DeviceGaussians *gradient) {
    GpuArg args[COMMON_ARGS + FIELD_COUNT];
    if (!project->backward &&
        !create_kernel(project, options(project), "project_backward", &project->backward_program, &project->backward))
        return false;
    common_args(project, frame, model, records, statistics, args);
    for (int id = 0; id < FIELD_COUNT; id++) args[COMMON_ARGS + id] = field_arg(gradient, id);
    return gpu_launch_args(project->backward, splats(project, (size_t)frame->splat_count), args,
                           sizeof args / sizeof *args);
}

bool opencl_project_step(OpenclProject *project, const FrameRecord *frame, DeviceGaussians *model, SplatRecords records,
                         const DensityStatistics *statistics, const AdamStep *adam) {
    GpuArg args[COMMON_ARGS + 2 * FIELD_COUNT + 3], *arg = args + COMMON_ARGS;
    assert(project->lanes != 1 && model->count == frame->splat_count);
    assert(adam->m->count == model->count && adam->v->count == model->count);
    if (!project->step && !create_kernel(project, "-D LANES=16 -D ADAM_STEP", "project_backward_step",
                                         &project->step_program, &project->step))
        return false;
    common_args(project, frame, model, records, statistics, args);
    *arg++ = gpu_record_arg(&adam->record, sizeof adam->record);
    *arg++ = field_arg(model, FIELD_SH0);
    for (int id = 0; id < FIELD_COUNT; id++) *arg++ = field_arg(adam->m, id);
    for (int id = 0; id < FIELD_COUNT; id++) *arg++ = field_arg(adam->v, id);
    *arg++ = gpu_buffer_arg(adam->not_finite);
    return gpu_launch_args(project->step, splats(project, (size_t)frame->splat_count), args, (int)(arg - args));
}
