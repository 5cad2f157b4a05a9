// opencl_adam.h - Adam on the device, one launch per field or inside opencl_project_step(), and the guards that stand with it:
// quaternions stay unit, numbers stay finite.
#ifndef SPLATLAB_SPLAT3D_OPENCL_ADAM_H
#define SPLATLAB_SPLAT3D_OPENCL_ADAM_H

#include "kernels/adam_record.h"
#include "splat3d/device_gaussians.h"

typedef struct OpenclAdam OpenclAdam;

// only_in_view: a step changes only the splats that its frame shows; the others keep parameters and moments ("sparse" Adam: Mallick
// et al. 2024). Else all of them, whose moments fade and whose parameters drift on while they are out of view.
bool opencl_adam_create(Gpu *gpu, bool only_in_view, OpenclAdam **adam);
void opencl_adam_destroy(OpenclAdam *adam); // accepts NULL

// Step number `step` (1 is the first): parameters, m and v change by the gradient (Kingma & Ba 2015, algorithm 1; beta 0.9,
// 0.999; epsilon 1e-15; the order of roundings stands in kernels/adam.cl). learning_rate: one per field; fields of SH degree
// above active_sh_degree are left alone, moments too. Quaternions are renormalised afterwards. A number whose gradient or new
// value is not finite stays as it is, with its moments, and its splat is noted. box (N): opencl_boxes() of the frame; may be NULL unless
// only_in_view. Enqueues; does not wait.
bool opencl_adam_step(OpenclAdam *adam, int step, const float learning_rate[FIELD_COUNT], int active_sh_degree,
                      GpuBuffer *box, const DeviceGaussians *gradient, DeviceGaussians *model, DeviceGaussians *m,
                      DeviceGaussians *v);

// The same step (step >= 1) for a kernel that does it right behind the gradients (opencl_project_step()).
typedef struct {
    AdamStepRecord record;
    DeviceGaussians *m, *v;
    GpuBuffer *not_finite; // one word: see kernels/adam.cl
} AdamStep;
AdamStep opencl_adam_prepare(OpenclAdam *adam, int step, const float learning_rate[FIELD_COUNT], DeviceGaussians *m,
                             DeviceGaussians *v);

// The lowest index of a splat that was noted by a step since the last call, and the first of its fields; *splat = -1 if
// all was well. Waits for the device.
bool opencl_adam_check(OpenclAdam *adam, int *splat, GaussianFieldId *field);

#endif
