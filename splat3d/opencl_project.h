// opencl_project.h - the model's splats on the screen, and the gradients back to its parameters (kernels/project_*.cl).
#ifndef SPLATLAB_SPLAT3D_OPENCL_PROJECT_H
#define SPLATLAB_SPLAT3D_OPENCL_PROJECT_H

#include "kernels/shared.h"
#include "splat3d/device_gaussians.h"
#include "splat3d/opencl_adam.h"

typedef struct {
    Gpu *gpu;
    GpuProgram *forward_program, *backward_program, *step_program; // the last two from their first use on
    GpuKernel *forward, *backward, *step;
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

// What density control needs to know of each splat, summed over steps; it divides one by the other.
typedef struct {
    GpuBuffer *gradient_ndc; // (N) floats: sum of |dL/d mean2d|, x in units of half the width, y of half the height
    GpuBuffer *seen;         // (N) ints: how many views saw it
} DensityStatistics;

// Enqueues; writes *gradient, and adds to *statistics unless that is NULL.
bool opencl_project_backward(OpenclProject *project, const FrameRecord *frame, const DeviceGaussians *model,
                             SplatRecords records, const DensityStatistics *statistics, DeviceGaussians *gradient);

// That and opencl_adam_step() at once, in two thirds of the time: the same numbers, but the gradients are never in memory. Enqueues;
// *model and the moments change. Only where is_vectorised.
bool opencl_project_step(OpenclProject *project, const FrameRecord *frame, DeviceGaussians *model, SplatRecords records,
                         const DensityStatistics *statistics, const AdamStep *adam);

#endif
