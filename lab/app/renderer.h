// renderer.h - what a command renders with: an OpenCL device, or the double-precision C reference.
#ifndef SPLATLAB_LAB_APP_RENDERER_H
#define SPLATLAB_LAB_APP_RENDERER_H

#include "lab/gpu/gpu.h"
#include "splat3d/rasterizer.h"

typedef struct {
    Gpu *gpu; // NULL with the reference
    Rasterizer *rasterizer;
} Renderer;

// device and kernels: as --device and --kernels give them ("" for the kernels beside the program).
bool renderer_open(bool use_reference, const char *device, const char *kernels, Renderer *renderer);
void renderer_close(Renderer *renderer); // accepts a zeroed or half-built one

#endif
