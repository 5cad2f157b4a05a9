// native_tile.h - one tile of the native blend, for one kind of vector registers each (native_blend_avx512.c, native_blend_avx2.c).
#ifndef SPLATLAB_LAB_APP_NATIVE_TILE_H
#define SPLATLAB_LAB_APP_NATIVE_TILE_H

#include "lab/app/native_blend.h"

typedef struct {
    const char *name;
    void (*forward)(const NativeBlend *blend, int tile);
    void (*backward)(const NativeBlend *blend, int tile);
} NativeTile;

#if defined(__x86_64__)
extern const NativeTile NATIVE_TILE_AVX512, NATIVE_TILE_AVX2;
#endif

#endif
