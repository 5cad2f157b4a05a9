// native_blend_avx512.c - the native blend compiled for AVX-512; run only where the processor has it.
#define NATIVE_LANES_CHOSEN
#include "lab/app/native_lanes_avx512.h"
#include "lab/app/native_tile_backward.h"
#include "lab/app/native_tile_forward.h"

#if defined(__x86_64__)
const NativeTile NATIVE_TILE_AVX512 = {"AVX-512", forward_tile, backward_tile};
#endif
