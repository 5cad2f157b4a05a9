// native_blend.c - chooses by what the processor has, and spreads the tiles over threads.
#include "lab/app/native_blend.h"

#include "lab/app/native_tile.h"
#include "lab/base/parallel.h"

#include <stddef.h>

static const NativeTile *best_tile(void) {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) return &NATIVE_TILE_AVX512;
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return &NATIVE_TILE_AVX2;
#endif
    return NULL;
}

const char *native_blend_name(void) { return best_tile() ? best_tile()->name : NULL; }

typedef struct {
    const NativeBlend *blend;
    void (*tile)(const NativeBlend *blend, int tile);
} Job;

static void run_tile(void *context, int index) {
    const Job *job = context;
    job->tile(job->blend, index);
}

static void run_all(const NativeBlend *blend, void (*tile)(const NativeBlend *, int)) {
    Job job = {blend, tile};
    parallel_for(blend->frame.tiles_x * blend->frame.tiles_y, run_tile, &job);
}

void native_blend_forward(const NativeBlend *blend) { run_all(blend, best_tile()->forward); }
void native_blend_backward(const NativeBlend *blend) { run_all(blend, best_tile()->backward); }
