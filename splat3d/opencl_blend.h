// opencl_blend.h - from tile lists to the picture and back (kernels/blend_*.cl), in a CPU's shape or a GPU's.
#ifndef SPLATLAB_SPLAT3D_OPENCL_BLEND_H
#define SPLATLAB_SPLAT3D_OPENCL_BLEND_H

#include "splat3d/opencl_binning.h"

typedef struct {
    bool is_tile_wise; // the CPU's shape: one work-item per tile; else one per pixel
    GpuProgram *forward_program, *backward_program;
    GpuKernel *forward, *backward;
    int width, height;        // px, of the last picture
    GpuBuffer *rgb, *d_rgb;   // (3, rows, stride) floats; d_rgb is zeroed when the size changes
    GpuBuffer *transmittance; // (tiles, 16, 16) floats: T_end, block by block (kernels/blend_cpu.h)
    GpuBuffer *last;          // (tiles, 16, 16) ints: 1 + list index of the last splat blended, 0 for none
    GpuBuffer *records;       // (P) PairGradient, by slot; undefined where the slot's mask is 0
} OpenclBlend;

bool opencl_blend_create(Gpu *gpu, bool is_tile_wise, OpenclBlend *blend);
void opencl_blend_destroy(OpenclBlend *blend); // accepts a zeroed, half-built or destroyed one

// Both enqueue. The backward pass reads d_rgb and what the forward pass of the same frame left.
bool opencl_blend_forward(OpenclBlend *blend, const FrameRecord *frame, const OpenclBinning *binning,
                          GpuBuffer *screen);
bool opencl_blend_backward(OpenclBlend *blend, const FrameRecord *frame, const OpenclBinning *binning,
                           GpuBuffer *screen);

// Place in transmittance and last of pixel (x, y) of a picture that is tiles_x tiles wide.
size_t opencl_blend_place(int tiles_x, int x, int y);

#endif
