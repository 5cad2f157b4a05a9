#include "splat3d/opencl_rasterizer.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "splat3d/frame_record.h"
#include "splat3d/opencl_binning.h"
#include "splat3d/opencl_blend.h"
#include "splat3d/opencl_project.h"

#include <assert.h>
#include <string.h>

struct OpenclRasterizer {
    Rasterizer interface; // first: a pointer to it is a pointer to the whole
    Gpu *gpu;
    OpenclProject project;
    OpenclBinning binning;
    OpenclBlend blend;
    bool has_frame;    // a frame was rendered and can be gone back
    FrameRecord frame; // of the last opencl_render()

    // Created when first used.
    DeviceGaussians gradient;
    DeviceGaussians model; // a copy for the interface, which takes models of the host
    const Gaussians *held; // what `model` is a copy of, by rasterizer_hold(); borrowed, never looked into
};

// A gradient with the model's shape; its content means nothing.
static bool reserve_gradient(OpenclRasterizer *r, const DeviceGaussians *model) {
    if (r->gradient.field[FIELD_MEAN] && r->gradient.sh_degree == model->sh_degree)
        return device_gaussians_resize(&r->gradient, model->count);
    device_gaussians_destroy(&r->gradient);
    return device_gaussians_create(r->gpu, "gradient", model->count, model->sh_degree, &r->gradient);
}

bool opencl_render(OpenclRasterizer *r, const DeviceGaussians *model, const Camera *camera,
                   const RenderSettings *settings) {
    r->has_frame = false;
    if (!frame_record_make(camera, settings, model->count, model->sh_degree, &r->frame)) return false;
    gpu_stage(r->gpu, "project");
    if (!opencl_project_forward(&r->project, &r->frame, model)) return false;
    if (!opencl_binning_sort(&r->binning, &r->frame, &r->project)) return false;
    if (!opencl_binning_lists(&r->binning, &r->frame, &r->project)) return false;
    gpu_stage(r->gpu, "blend_forward");
    r->has_frame = opencl_blend_forward(&r->blend, &r->frame, &r->binning, r->project.screen);
    return r->has_frame;
}

static SplatRecords records_of(const OpenclRasterizer *r) {
    return (SplatRecords){r->binning.offset, r->binning.mask, r->blend.records};
}

static bool blend_backward(OpenclRasterizer *r, const DeviceGaussians *model) {
    assert(r->has_frame && model->count == r->frame.splat_count);
    gpu_stage(r->gpu, "blend_backward");
    return opencl_blend_backward(&r->blend, &r->frame, &r->binning, r->project.screen);
}

bool opencl_backward(OpenclRasterizer *r, const DeviceGaussians *model, DeviceGaussians *gradient,
                     const DensityStatistics *statistics) {
    assert(gradient->count == model->count && gradient->sh_degree == model->sh_degree);
    if (!blend_backward(r, model)) return false;
    gpu_stage(r->gpu, "project_backward");
    return opencl_project_backward(&r->project, &r->frame, model, records_of(r), statistics, gradient);
}

bool opencl_backward_step(OpenclRasterizer *r, OpenclAdam *adam, int step, const float learning_rate[FIELD_COUNT],
                          DeviceGaussians *model, DeviceGaussians *m, DeviceGaussians *v,
                          const DensityStatistics *statistics) {
    if (r->project.lanes == 1) {
        if (!reserve_gradient(r, model) || !opencl_backward(r, model, &r->gradient, statistics)) return false;
        gpu_stage(r->gpu, "adam");
        return opencl_adam_step(adam, step, learning_rate, r->frame.sh_degree, opencl_boxes(r), &r->gradient, model, m,
                                v);
    }
    const AdamStep adam_step = opencl_adam_prepare(adam, step, learning_rate, m, v);
    if (!blend_backward(r, model)) return false;
    gpu_stage(r->gpu, "update");
    return opencl_project_step(&r->project, &r->frame, model, records_of(r), statistics, &adam_step);
}

DevicePicture opencl_picture(OpenclRasterizer *r) {
    return (DevicePicture){
        .width = r->frame.width,
        .height = r->frame.height,
        .stride = r->frame.stride,
        .rows = r->frame.rows,
        .rgb = r->blend.rgb,
        .d_rgb = r->blend.d_rgb,
    };
}

GpuBuffer *opencl_boxes(const OpenclRasterizer *r) { return r->project.box; }

FrameCounts opencl_frame_counts(const OpenclRasterizer *r) {
    return (FrameCounts){.visible = r->binning.visible, .pairs = r->binning.pairs};
}

static bool read_rgb(OpenclRasterizer *r, ImageF *rgb) {
    void *mapped;
    if (!gpu_buffer_map(r->blend.rgb, GPU_READ, &mapped)) return false;
    const float *planes = mapped;
    const size_t stride = (size_t)r->frame.stride, plane = stride * (size_t)r->frame.rows;
    float *out = rgb->values;
    for (int y = 0; y < rgb->height; y++)
        for (int x = 0; x < rgb->width; x++)
            for (int c = 0; c < 3; c++) *out++ = planes[(size_t)c * plane + (size_t)y * stride + (size_t)x];
    return gpu_buffer_unmap(r->blend.rgb);
}

static bool read_alpha(OpenclRasterizer *r, ImageF *alpha) {
    void *mapped;
    if (!gpu_buffer_map(r->blend.transmittance, GPU_READ, &mapped)) return false;
    const float *transmittance = mapped;
    float *out = alpha->values;
    for (int y = 0; y < alpha->height; y++)
        for (int x = 0; x < alpha->width; x++) *out++ = 1 - transmittance[opencl_blend_place(r->frame.tiles_x, x, y)];
    return gpu_buffer_unmap(r->blend.transmittance);
}

bool opencl_read_picture(OpenclRasterizer *r, Picture *picture) {
    assert(r->has_frame);
    picture->rgb = imagef_create(r->frame.width, r->frame.height, 3);
    picture->alpha = imagef_create(r->frame.width, r->frame.height, 1);
    if (read_rgb(r, &picture->rgb) && read_alpha(r, &picture->alpha)) return true;
    picture_destroy(picture);
    return false;
}

// ---- the table of rasterizer.h ----

// Puts a model of the host on the device.
static bool take_model(OpenclRasterizer *r, const Gaussians *model) {
    if (r->held == model) return true;
    r->held = NULL;
    if (!r->model.field[FIELD_MEAN] || r->model.sh_degree != model->sh_degree) {
        device_gaussians_destroy(&r->model);
        if (!device_gaussians_create(r->gpu, "model", 0, model->sh_degree, &r->model)) return false;
    }
    return device_gaussians_write(&r->model, model);
}

static bool table_render(Rasterizer *self, const Gaussians *model, const Camera *camera, const RenderSettings *settings,
                         Picture *picture) {
    OpenclRasterizer *r = (OpenclRasterizer *)self;
    return take_model(r, model) && opencl_render(r, &r->model, camera, settings) && opencl_read_picture(r, picture);
}

static bool table_hold(Rasterizer *self, const Gaussians *model) {
    OpenclRasterizer *r = (OpenclRasterizer *)self;
    r->held = NULL;
    if (!model) return true;
    if (!take_model(r, model)) return false;
    r->held = model;
    return true;
}

static bool write_d_rgb(OpenclRasterizer *r, const ImageF *d_rgb) {
    void *mapped;
    assert(d_rgb->width == r->frame.width && d_rgb->height == r->frame.height && d_rgb->channels == 3);
    if (!gpu_buffer_map(r->blend.d_rgb, GPU_READ_WRITE, &mapped)) return false;
    float *planes = mapped;
    const size_t stride = (size_t)r->frame.stride, plane = stride * (size_t)r->frame.rows;
    const float *in = d_rgb->values;
    for (int y = 0; y < d_rgb->height; y++)
        for (int x = 0; x < d_rgb->width; x++)
            for (int c = 0; c < 3; c++) planes[(size_t)c * plane + (size_t)y * stride + (size_t)x] = *in++;
    return gpu_buffer_unmap(r->blend.d_rgb);
}

// A gradient of the model on the device: zeros, which stay where the backward pass leaves fields alone.
static bool begin_gradient(OpenclRasterizer *r) {
    DeviceGaussians *gradient = &r->gradient;
    if (!reserve_gradient(r, &r->model)) return false;
    for (int id = 0; id < FIELD_COUNT; id++)
        if (gradient->field[id] && !gpu_buffer_zero(gradient->field[id])) return false;
    return true;
}

static bool table_backward(Rasterizer *self, const Gaussians *model, const Camera *camera,
                           const RenderSettings *settings, const ImageF *d_rgb, Gaussians *d_model) {
    OpenclRasterizer *r = (OpenclRasterizer *)self;
    return take_model(r, model) && begin_gradient(r) && opencl_render(r, &r->model, camera, settings) &&
           write_d_rgb(r, d_rgb) && opencl_backward(r, &r->model, &r->gradient, NULL) &&
           device_gaussians_read(&r->gradient, d_model);
}

static void table_destroy(Rasterizer *self) { opencl_rasterizer_destroy((OpenclRasterizer *)self); }

static const RasterizerApi OPENCL_API = {"opencl", table_render, table_backward, table_hold, table_destroy};

bool opencl_rasterizer_create(Gpu *gpu, BlendKernels blend, OpenclRasterizer **rasterizer) {
    OpenclRasterizer *r = mem_alloc(1, sizeof *r);
    const bool is_tile_wise = blend == BLEND_AUTO ? gpu_info(gpu)->is_cpu : blend == BLEND_CPU;
    r->interface.api = &OPENCL_API;
    r->gpu = gpu;
    *rasterizer = r;
    if (opencl_project_create(gpu, is_tile_wise, &r->project) && opencl_binning_create(gpu, &r->binning) &&
        opencl_blend_create(gpu, is_tile_wise, &r->blend))
        return true;
    opencl_rasterizer_destroy(r);
    *rasterizer = NULL;
    return false;
}

void opencl_rasterizer_destroy(OpenclRasterizer *r) {
    if (!r) return;
    opencl_project_destroy(&r->project);
    opencl_binning_destroy(&r->binning);
    opencl_blend_destroy(&r->blend);
    device_gaussians_destroy(&r->model);
    device_gaussians_destroy(&r->gradient);
    mem_free(r);
}

Rasterizer *opencl_rasterizer_interface(OpenclRasterizer *rasterizer) { return &rasterizer->interface; }
