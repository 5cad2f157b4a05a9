// renderer.c - opens and closes a rasterizer together with its device.
#include "lab/app/renderer.h"

#include "splat3d/opencl_rasterizer.h"
#include "splat3d/reference.h"

bool renderer_open(bool use_reference, const char *device, const char *kernels, Renderer *renderer) {
    *renderer = (Renderer){0};
    if (use_reference) {
        renderer->rasterizer = reference_rasterizer_create();
        return true;
    }
    if (kernels[0]) gpu_set_kernel_folder(kernels);
    OpenclRasterizer *opencl;
    if (!gpu_open(device, &renderer->gpu)) return false;
    if (!opencl_rasterizer_create(renderer->gpu, BLEND_AUTO, &opencl)) return false;
    renderer->rasterizer = opencl_rasterizer_interface(opencl);
    return true;
}

void renderer_close(Renderer *renderer) {
    rasterizer_destroy(renderer->rasterizer);
    gpu_close(renderer->gpu);
    *renderer = (Renderer){0};
}
