// native_blend_avx2.c - the native blend compiled for AVX2; run only where the processor has it.
#define NATIVE_LANES_CHOSEN
#include "lab/app/native_lanes_avx2.h"
#include "lab/app/native_tile_backward.h"
#include "lab/app/native_tile_forward.h"

#if defined(__x86_64__)
const NativeTile NATIVE_TILE_AVX2 = {"AVX2", forward_tile, backward_tile};
#endif
