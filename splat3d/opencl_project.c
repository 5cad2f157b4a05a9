#include "splat3d/opencl_project.h"

enum { GROUP_SIZE = 64 }; // work-items; one splat each

bool opencl_project_create(Gpu *gpu, OpenclProject *project) {
    *project = (OpenclProject){0};
    if (gpu_program_create(gpu, "project_forward.cl", "", &project->forward_program) &&
        gpu_kernel(project->forward_program, "project_forward", &project->forward) &&
        gpu_program_create(gpu, "project_backward.cl", "", &project->backward_program) &&
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

bool opencl_project_forward(OpenclProject *project, const FrameRecord *frame, const DeviceGaussians *model) {
    const size_t n = (size_t)frame->splat_count;
    if (!gpu_buffer_reserve(project->screen, n * sizeof(ScreenSplat)) ||
        !gpu_buffer_reserve(project->box, n * sizeof(TileBox)) ||
        !gpu_buffer_reserve(project->depth, n * sizeof(float)))
        return false;
    return gpu_launch(project->forward, ((GpuRange){.width = n, .group_width = GROUP_SIZE}),
                      gpu_record_arg(frame, sizeof *frame), field_arg(model, FIELD_MEAN),
                      field_arg(model, FIELD_LOG_SCALE), field_arg(model, FIELD_QUAT),
                      field_arg(model, FIELD_OPACITY_LOGIT), field_arg(model, FIELD_SH0), field_arg(model, FIELD_SH1),
                      field_arg(model, FIELD_SH2), field_arg(model, FIELD_SH3), gpu_buffer_arg(project->screen),
                      gpu_buffer_arg(project->box), gpu_buffer_arg(project->depth));
}

bool opencl_project_backward(OpenclProject *project, const FrameRecord *frame, const DeviceGaussians *model,
                             SplatRecords records, DeviceGaussians *gradient, GpuBuffer *gradient_ndc,
                             GpuBuffer *seen) {
    const bool has_statistics = gradient_ndc && seen;
    return gpu_launch(
        project->backward, ((GpuRange){.width = (size_t)frame->splat_count, .group_width = GROUP_SIZE}),
        gpu_record_arg(frame, sizeof *frame), field_arg(model, FIELD_MEAN), field_arg(model, FIELD_LOG_SCALE),
        field_arg(model, FIELD_QUAT), field_arg(model, FIELD_OPACITY_LOGIT), field_arg(model, FIELD_SH1),
        field_arg(model, FIELD_SH2), field_arg(model, FIELD_SH3), gpu_buffer_arg(project->screen),
        gpu_buffer_arg(project->box), gpu_buffer_arg(records.offset), gpu_buffer_arg(records.mask),
        gpu_buffer_arg(records.records), field_arg(gradient, FIELD_MEAN), field_arg(gradient, FIELD_LOG_SCALE),
        field_arg(gradient, FIELD_QUAT), field_arg(gradient, FIELD_OPACITY_LOGIT), field_arg(gradient, FIELD_SH0),
        field_arg(gradient, FIELD_SH1), field_arg(gradient, FIELD_SH2), field_arg(gradient, FIELD_SH3),
        gpu_int_arg(has_statistics), gpu_buffer_arg(has_statistics ? gradient_ndc : project->depth),
        gpu_buffer_arg(has_statistics ? seen : project->box));
}
