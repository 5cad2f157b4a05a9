// The host side of kernels/ssim_cpu.cl, and of kernels/ssim_forward_gpu.cl and kernels/ssim_backward_gpu.cl for a GPU. The reference is splat2d/loss.c.

#include "splat3d/opencl_loss.h"

#include "kernels/ssim.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"

#include <assert.h>
#include <math.h>

struct OpenclLoss {
    Gpu *gpu;
    bool is_fused; // the CPU's shape: one kernel; else two, with maps between them
    GpuProgram *fused_program, *forward_program, *backward_program;
    GpuKernel *fused, *forward, *backward;
    GpuBuffer *maps, *sums;        // as the kernels say
    float window[SSIM_RADIUS + 1]; // weight by distance
    int items;                     // work-items of the last forward run: rows of sums
    double values;                 // 3 width height of the last run
    double lambda;                 // of the last run
};

static bool create_kernels(OpenclLoss *l) {
    if (l->is_fused)
        return gpu_program_create(l->gpu, "ssim_cpu.cl", "", &l->fused_program) &&
               gpu_kernel(l->fused_program, "ssim_cpu", &l->fused);
    return gpu_program_create(l->gpu, "ssim_forward_gpu.cl", "", &l->forward_program) &&
           gpu_program_create(l->gpu, "ssim_backward_gpu.cl", "", &l->backward_program) &&
           gpu_kernel(l->forward_program, "ssim_forward_gpu", &l->forward) &&
           gpu_kernel(l->backward_program, "ssim_backward_gpu", &l->backward) &&
           gpu_buffer_create(l->gpu, "SSIM derivatives", 0, &l->maps);
}

bool opencl_loss_create(Gpu *gpu, BlendKernels kernels, OpenclLoss **loss) {
    OpenclLoss *l = mem_alloc(1, sizeof *l);
    l->gpu = gpu;
    l->is_fused = kernels == BLEND_AUTO ? gpu_info(gpu)->is_cpu : kernels == BLEND_CPU;
    double weight[SSIM_RADIUS + 1], sum = 0;
    for (int d = 0; d <= SSIM_RADIUS; d++) {
        weight[d] = exp(-d * d / (2.0 * SSIM_SIGMA * SSIM_SIGMA));
        sum += d ? 2 * weight[d] : weight[d];
    }
    for (int d = 0; d <= SSIM_RADIUS; d++) l->window[d] = (float)(weight[d] / sum);
    bool good = create_kernels(l) && gpu_buffer_create(gpu, "loss sums", 0, &l->sums);
    *loss = good ? l : NULL;
    if (!good) opencl_loss_destroy(l);
    return good;
}

void opencl_loss_destroy(OpenclLoss *loss) {
    if (!loss) return;
    gpu_buffer_destroy(loss->maps);
    gpu_buffer_destroy(loss->sums);
    gpu_program_destroy(loss->fused_program);
    gpu_program_destroy(loss->forward_program);
    gpu_program_destroy(loss->backward_program);
    mem_free(loss);
}

static int padded(int n) { return (n + TILE_SIZE - 1) / TILE_SIZE * TILE_SIZE; }

static void photo_fill(const Image8 *image, uint8_t *rgba) {
    size_t width = (size_t)image->width, stride = (size_t)padded(image->width);
    for (int y = 0; y < image->height; y++) {
        const uint8_t *in = image->bytes + (size_t)y * width * (size_t)image->channels;
        uint8_t *out = rgba + 4 * (size_t)y * stride;
        for (size_t x = 0; x < width; x++, in += image->channels, out += 4) {
            for (int c = 0; c < 3; c++) out[c] = in[image->channels == 1 ? 0 : c];
            out[3] = image->channels == 4 ? in[3] : 255;
        }
        for (size_t i = 0; i < 4 * (stride - width); i++) out[i] = 0;
    }
}

bool opencl_photo_create(Gpu *gpu, const Image8 *image, GpuBuffer **photo) {
    assert(image->channels == 1 || image->channels == 3 || image->channels == 4);
    void *mapped;
    if (!gpu_buffer_create(gpu, "photograph", 4 * (size_t)padded(image->width) * (size_t)image->height, photo))
        return false;
    if (!gpu_buffer_map(*photo, GPU_WRITE, &mapped)) {
        gpu_buffer_destroy(*photo);
        *photo = NULL;
        return false;
    }
    photo_fill(image, mapped);
    return gpu_buffer_unmap(*photo);
}

static int strips(int width, int height) {
    return 3 * (width / SSIM_STRIP_WIDTH) * ((height + SSIM_STRIP_HEIGHT - 1) / SSIM_STRIP_HEIGHT);
}

static int panels(int width, int height) {
    int across = (width + SSIM_PANEL_WIDTH - 1) / SSIM_PANEL_WIDTH;
    return 3 * across * ((height + SSIM_PANEL_HEIGHT - 1) / SSIM_PANEL_HEIGHT);
}

static bool run_fused(OpenclLoss *loss, const SsimRecord *record, DevicePicture picture, GpuBuffer *photo) {
    return gpu_launch(loss->fused, gpu_range((size_t)loss->items, 1), gpu_record_arg(record, sizeof *record),
                      gpu_buffer_arg(picture.rgb), gpu_buffer_arg(photo), gpu_buffer_arg(loss->sums),
                      gpu_buffer_arg(picture.d_rgb));
}

static bool run_in_two(OpenclLoss *loss, const SsimRecord *record, DevicePicture picture, GpuBuffer *photo) {
    size_t map_floats = (size_t)SSIM_MAPS * 3 * (size_t)picture.rows * (size_t)(picture.stride + 2 * SSIM_MARGIN);
    // A CPU does best with groups of one strip; a GPU has to have a group as wide as its hardware.
    size_t group = gpu_info(loss->gpu)->is_cpu ? 1 : 32;
    return gpu_buffer_reserve(loss->maps, map_floats * sizeof(float)) &&
           gpu_launch(loss->forward, gpu_range((size_t)loss->items, group), gpu_record_arg(record, sizeof *record),
                      gpu_buffer_arg(picture.rgb), gpu_buffer_arg(photo), gpu_buffer_arg(loss->maps),
                      gpu_buffer_arg(loss->sums)) &&
           gpu_launch(loss->backward, gpu_range((size_t)strips(picture.stride, picture.rows), group),
                      gpu_record_arg(record, sizeof *record), gpu_buffer_arg(picture.rgb), gpu_buffer_arg(photo),
                      gpu_buffer_arg(loss->maps), gpu_buffer_arg(picture.d_rgb));
}

bool opencl_loss_run(OpenclLoss *loss, DevicePicture picture, GpuBuffer *photo, const float background[3],
                     float lambda) {
    assert(gpu_buffer_bytes(photo) == 4 * (size_t)picture.stride * (size_t)picture.height);
    assert(picture.stride == padded(picture.width) && picture.rows == padded(picture.height));
    loss->values = 3.0 * picture.width * picture.height;
    loss->lambda = lambda;
    loss->items = loss->is_fused ? panels(picture.stride, picture.rows) : strips(picture.stride, picture.height);
    SsimRecord record = {
        .width = picture.width,
        .height = picture.height,
        .stride = picture.stride,
        .rows = picture.rows,
        .background = {background[0], background[1], background[2]},
        .l1_scale = (float)((1 - loss->lambda) / loss->values),
        .ssim_scale = (float)(-loss->lambda / loss->values),
    };
    for (int d = 0; d <= SSIM_RADIUS; d++) record.window[d] = loss->window[d];
    return gpu_buffer_reserve(loss->sums, (size_t)loss->items * SSIM_SUMS * sizeof(float)) &&
           (loss->is_fused ? run_fused : run_in_two)(loss, &record, picture, photo);
}

bool opencl_loss_read(OpenclLoss *loss, LossValues *values) {
    assert(loss->items > 0);
    void *mapped;
    if (!gpu_buffer_map(loss->sums, GPU_READ, &mapped)) return false;
    const float *sums = mapped;
    double total[SSIM_SUMS] = {0};
    for (int i = 0; i < loss->items; i++)
        for (int k = 0; k < SSIM_SUMS; k++) total[k] += (double)sums[i * SSIM_SUMS + k];
    if (!gpu_buffer_unmap(loss->sums)) return false;
    values->l1 = total[0] / loss->values;
    values->mse = total[1] / loss->values;
    values->ssim = total[2] / loss->values;
    values->total = (1 - loss->lambda) * values->l1 + loss->lambda * (1 - values->ssim);
    return true;
}
