#include "splat3d/opencl_project.h"

enum {
    LANES_CPU = 16, // splats of one work-item
    GROUP_CPU = 4,  // work-items
    GROUP_GPU = 64,
};

bool opencl_project_create(Gpu *gpu, bool is_vectorised, OpenclProject *project) {
    const char *options = is_vectorised ? "-D LANES=16" : "";
    *project = (OpenclProject){.lanes = is_vectorised ? LANES_CPU : 1};
    if (gpu_program_create(gpu, "project_forward.cl", options, &project->forward_program) &&
        gpu_kernel(project->forward_program, "project_forward", &project->forward) &&
        gpu_program_create(gpu, "project_backward.cl", options, &project->backward_program) &&
        gpu_kernel(project->backward_program, "project_backward", &project->backward) &&
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

bool opencl_project_backward(OpenclProject *project, const FrameRecord *frame, const DeviceGaussians *model,
                             SplatRecords records, DeviceGaussians *gradient, GpuBuffer *gradient_ndc,
                             GpuBuffer *seen) {
    const bool has_statistics = gradient_ndc && seen;
    return gpu_launch(
        project->backward, splats(project, (size_t)frame->splat_count), gpu_record_arg(frame, sizeof *frame),
        field_arg(model, FIELD_MEAN), field_arg(model, FIELD_LOG_SCALE), field_arg(model, FIELD_QUAT),
        field_arg(model, FIELD_OPACITY_LOGIT), field_arg(model, FIELD_SH1), field_arg(model, FIELD_SH2),
        field_arg(model, FIELD_SH3), gpu_buffer_arg(project->screen), gpu_buffer_arg(project->box),
        gpu_buffer_arg(records.offset), gpu_buffer_arg(records.mask), gpu_buffer_arg(records.records),
        field_arg(gradient, FIELD_MEAN), field_arg(gradient, FIELD_LOG_SCALE), field_arg(gradient, FIELD_QUAT),
        field_arg(gradient, FIELD_OPACITY_LOGIT), field_arg(gradient, FIELD_SH0), field_arg(gradient, FIELD_SH1),
        field_arg(gradient, FIELD_SH2), field_arg(gradient, FIELD_SH3), gpu_int_arg(has_statistics),
        gpu_buffer_arg(has_statistics ? gradient_ndc : project->depth),
        gpu_buffer_arg(has_statistics ? seen : project->box));
}
