// device_gaussians.h - Gaussians on an OpenCL device: parameters, their gradients, or Adam's moments (all have the same shape).
//
// A field lies in groups of SPLAT_GROUP splats: of a group all first numbers, then all second ones, ... (kernels/splat_lanes.h).
#ifndef SPLATLAB_SPLAT3D_DEVICE_GAUSSIANS_H
#define SPLATLAB_SPLAT3D_DEVICE_GAUSSIANS_H

#include "lab/gpu/gpu.h"
#include "splat3d/gaussians.h"

typedef struct {
    int count;
    int sh_degree;
    GpuBuffer *field[FIELD_COUNT]; // floats, width of each splat, in whole groups; NULL above sh_degree
} DeviceGaussians;

// what: "model", "gradient"; stands in messages before the field's name. All numbers are zero.
bool device_gaussians_create(Gpu *gpu, const char *what, int count, int sh_degree, DeviceGaussians *g);
void device_gaussians_destroy(DeviceGaussians *g); // accepts a zeroed, half-built or destroyed one

// Another count; the content is lost. Allocates only to grow.
bool device_gaussians_resize(DeviceGaussians *g, int count);

bool device_gaussians_write(DeviceGaussians *g, const Gaussians *host); // takes its count; the same sh_degree
bool device_gaussians_read(const DeviceGaussians *g, Gaussians *host);  // creates *host, owned by the caller

#endif
