// opencl_project.h - the model's splats on the screen, and the gradients back to its parameters (kernels/project_*.cl).
#ifndef SPLATLAB_SPLAT3D_OPENCL_PROJECT_H
#define SPLATLAB_SPLAT3D_OPENCL_PROJECT_H

#include "kernels/shared.h"
#include "splat3d/device_gaussians.h"

typedef struct {
    GpuProgram *forward_program, *backward_program;
    GpuKernel *forward, *backward;
    size_t lanes;      // splats of one work-item; buffers have room for whole groups of them
    GpuBuffer *screen; // (N) ScreenSplat; without meaning where the splat is not visible
    GpuBuffer *box;    // (N) TileBox, all zero where it is not visible
    GpuBuffer *depth;  // (N) floats, camera z, world units; without meaning where it is not visible
} OpenclProject;

// is_vectorised: sixteen splats in one work-item, for CPUs; else one, for GPUs. The same numbers up to rounding.
bool opencl_project_create(Gpu *gpu, bool is_vectorised, OpenclProject *project);
void opencl_project_destroy(OpenclProject *project); // accepts a zeroed, half-built or destroyed one

// Enqueues; fills screen, box and depth.
bool opencl_project_forward(OpenclProject *project, const FrameRecord *frame, const DeviceGaussians *model);

// Where the blend left the gradients of each splat: P records, offset (N) the place of a splat's first, mask (P) 0 where there is none.
typedef struct {
    GpuBuffer *offset;  // (N) uints
    GpuBuffer *mask;    // (P) ushorts
    GpuBuffer *records; // (P) PairGradient
} SplatRecords;

// Enqueues; writes *gradient, and adds to gradient_ndc (N floats) and seen (N ints) unless they are NULL.
bool opencl_project_backward(OpenclProject *project, const FrameRecord *frame, const DeviceGaussians *model,
                             SplatRecords records, DeviceGaussians *gradient, GpuBuffer *gradient_ndc, GpuBuffer *seen);

#endif
