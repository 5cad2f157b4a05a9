#include "splat3d/opencl_blend.h"

enum { TILE_PIXELS = TILE_SIZE * TILE_SIZE, BLOCK_PIXELS = BLOCK_SIZE * BLOCK_SIZE };

bool opencl_blend_create(Gpu *gpu, bool is_tile_wise, OpenclBlend *blend) {
    *blend = (OpenclBlend){.is_tile_wise = is_tile_wise};
    const char *forward = is_tile_wise ? "blend_forward_cpu" : "blend_forward_gpu";
    const char *backward = is_tile_wise ? "blend_backward_cpu" : "blend_backward_gpu";
    const char *forward_file = is_tile_wise ? "blend_forward_cpu.cl" : "blend_forward_gpu.cl";
    const char *backward_file = is_tile_wise ? "blend_backward_cpu.cl" : "blend_backward_gpu.cl";
    if (gpu_program_create(gpu, forward_file, "", &blend->forward_program) &&
        gpu_kernel(blend->forward_program, forward, &blend->forward) &&
        gpu_program_create(gpu, backward_file, "", &blend->backward_program) &&
        gpu_kernel(blend->backward_program, backward, &blend->backward) &&
        gpu_buffer_create(gpu, "picture", 0, &blend->rgb) &&
        gpu_buffer_create(gpu, "picture gradient", 0, &blend->d_rgb) &&
        gpu_buffer_create(gpu, "transmittance", 0, &blend->transmittance) &&
        gpu_buffer_create(gpu, "last splats", 0, &blend->last) &&
        gpu_buffer_create(gpu, "pair records", 0, &blend->records))
        return true;
    opencl_blend_destroy(blend);
    return false;
}

void opencl_blend_destroy(OpenclBlend *blend) {
    gpu_buffer_destroy(blend->rgb);
    gpu_buffer_destroy(blend->d_rgb);
    gpu_buffer_destroy(blend->transmittance);
    gpu_buffer_destroy(blend->last);
    gpu_buffer_destroy(blend->records);
    gpu_program_destroy(blend->forward_program);
    gpu_program_destroy(blend->backward_program);
    *blend = (OpenclBlend){0};
}

static bool resize(OpenclBlend *blend, const FrameRecord *frame) {
    if (blend->width == frame->width && blend->height == frame->height) return true;
    const size_t pixels = (size_t)frame->stride * (size_t)frame->rows;
    blend->width = blend->height = 0;
    if (!gpu_buffer_reserve(blend->rgb, 3 * pixels * sizeof(float)) ||
        !gpu_buffer_reserve(blend->d_rgb, 3 * pixels * sizeof(float)) ||
        !gpu_buffer_reserve(blend->transmittance, pixels * sizeof(float)) ||
        !gpu_buffer_reserve(blend->last, pixels * sizeof(int)) || !gpu_buffer_zero(blend->d_rgb))
        return false;
    blend->width = frame->width;
    blend->height = frame->height;
    return true;
}

static GpuRange blend_range(const OpenclBlend *blend, const FrameRecord *frame) {
    if (blend->is_tile_wise) return (GpuRange){(size_t)frame->tiles_x, (size_t)frame->tiles_y, 1, 1};
    return (GpuRange){(size_t)frame->stride, (size_t)frame->rows, TILE_SIZE, TILE_SIZE};
}

bool opencl_blend_forward(OpenclBlend *blend, const FrameRecord *frame, const OpenclBinning *binning,
                          GpuBuffer *screen) {
    return resize(blend, frame) &&
           gpu_launch(blend->forward, blend_range(blend, frame), gpu_record_arg(frame, sizeof *frame),
                      gpu_buffer_arg(binning->start), gpu_buffer_arg(binning->list_splat),
                      gpu_buffer_arg(binning->list_mask), gpu_buffer_arg(screen), gpu_buffer_arg(blend->rgb),
                      gpu_buffer_arg(blend->transmittance), gpu_buffer_arg(blend->last));
}

bool opencl_blend_backward(OpenclBlend *blend, const FrameRecord *frame, const OpenclBinning *binning,
                           GpuBuffer *screen) {
    return gpu_buffer_reserve(blend->records, (size_t)binning->slots * sizeof(PairGradient)) &&
           gpu_launch(blend->backward, blend_range(blend, frame), gpu_record_arg(frame, sizeof *frame),
                      gpu_buffer_arg(binning->start), gpu_buffer_arg(binning->list_splat),
                      gpu_buffer_arg(binning->list_slot), gpu_buffer_arg(binning->list_mask), gpu_buffer_arg(screen),
                      gpu_buffer_arg(blend->transmittance), gpu_buffer_arg(blend->last), gpu_buffer_arg(blend->d_rgb),
                      gpu_buffer_arg(blend->records), gpu_buffer_arg(binning->mask));
}

size_t opencl_blend_place(int tiles_x, int x, int y) {
    const int tile = y / TILE_SIZE * tiles_x + x / TILE_SIZE;
    const int in_x = x % TILE_SIZE, in_y = y % TILE_SIZE;
    const int block = in_y / BLOCK_SIZE * (TILE_SIZE / BLOCK_SIZE) + in_x / BLOCK_SIZE;
    return (size_t)tile * TILE_PIXELS +
           (size_t)(block * BLOCK_PIXELS + in_y % BLOCK_SIZE * BLOCK_SIZE + in_x % BLOCK_SIZE);
}
