// native_blend.h - the two blend kernels once more, in C with vector intrinsics: the ceiling that `splatlab bench` holds the
// kernels against.
//
// The same algorithm as kernels/blend_*_cpu.cl (exact masks, sixteen pixels of a block at once, back to front with one record a
// pair), written by hand for AVX-512, or for AVX2 where there is no AVX-512. What the kernels lose against it, the OpenCL compiler loses.
#ifndef SPLATLAB_LAB_APP_NATIVE_BLEND_H
#define SPLATLAB_LAB_APP_NATIVE_BLEND_H

#include "kernels/shared.h"

#include <stdbool.h>
#include <stdint.h>

// Arrays as the kernels have them (opencl_binning.h, opencl_blend.h); rgb, transmittance and last are written forward and, but for
// rgb, read backward.
typedef struct {
    FrameRecord frame;
    const uint32_t *start, *list_splat, *list_slot;
    const uint16_t *list_mask;
    const ScreenSplat *screen;
    float *rgb, *transmittance;
    int32_t *last;
    const float *d_rgb;
    PairGradient *records;
    uint16_t *mask_of_slot; // set to 0 backward for pairs that are hidden in all of their tile: they get no record
} NativeBlend;

// "AVX-512", "AVX2"; NULL where this processor has neither: then the two below must not be called.
const char *native_blend_name(void);

// All tiles, on parallel_threads() threads.
void native_blend_forward(const NativeBlend *blend);
void native_blend_backward(const NativeBlend *blend);

#endif
