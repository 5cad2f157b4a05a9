// blend_forward_gpu.cl - front-to-back blending of each tile's list, one work-item per pixel, for GPUs.
//
// The same equation, rule, arguments and stored state as blend_forward_cpu.cl. The group's 256 work-items fetch 256 splats of the list into
// local memory, then each walks them for its own pixel, skipping those whose mask does not reach its 4x4 block. The group
// leaves when all its pixels are opaque; every barrier is met by the whole group.
//
// One work-item: one pixel (group TILE_SIZE x TILE_SIZE = one tile). Local memory: 256 * (48 + 2) + 4 = 12,804 bytes.
// Reference: splat3d/reference_blend.c. Test: tests/splat3d/test_opencl_rasterizer.c.
#include "shared.h"

#include "blend_gpu.h"

typedef struct {
    float t, r, g, b;
    int last;
} PixelState;

// Blends the staged splats behind what is there. first: index of staged[0] in the tile's list; x, y: the pixel's centre.
static void blend_pixel(const float alpha_max, __local const ScreenSplat *staged, __local const ushort *mask, int batch,
                        int first, int block, float x, float y, PixelState *state) {
    for (int i = 0; i < batch && state->t >= TRANSMITTANCE_STOP; i++) {
        if (!(mask[i] >> block & 1)) continue;
        const float dy = y - staged[i].y;
        const float u = fma(staged[i].shear, dy, x - staged[i].x);
        const float power = fma(staged[i].along_u * u, u, fma(staged[i].along_v * dy, dy, staged[i].log2_opacity));
        if (!(power >= LOG2_ALPHA_MIN)) continue;
        const float weight = min(exp2_fast(power), alpha_max) * state->t;
        state->r = fma(weight, staged[i].r, state->r);
        state->g = fma(weight, staged[i].g, state->g);
        state->b = fma(weight, staged[i].b, state->b);
        state->t -= weight;
        state->last = first + i + 1;
    }
}

__kernel __attribute__((reqd_work_group_size(TILE_SIZE, TILE_SIZE, 1))) void
blend_forward_gpu(const FrameRecord frame, __global const uint *start, __global const uint *list_splat,
                  __global const ushort *list_mask, __global const ScreenSplat *screen, __global float *rgb,
                  __global float *transmittance, __global int *last) {
    __local ScreenSplat staged[TILE_PIXELS];
    __local ushort mask[TILE_PIXELS];
    __local int clear_pixels; // not opaque yet

    const int x = (int)get_local_id(0), y = (int)get_local_id(1), item = y * TILE_SIZE + x;
    const int tile = (int)(get_group_id(1) * get_num_groups(0) + get_group_id(0));
    const uint begin = start[tile];
    const int count = (int)(start[tile + 1] - begin);
    PixelState state = {1, 0, 0, 0, 0};

    for (int first = 0; first < count; first += TILE_PIXELS) {
        if (item == 0) clear_pixels = 0;
        barrier(CLK_LOCAL_MEM_FENCE); // also: everybody is done with the staged splats
        if (state.t >= TRANSMITTANCE_STOP) atomic_inc(&clear_pixels);
        const int batch = min(count - first, TILE_PIXELS);
        if (item < batch) {
            staged[item] = screen[list_splat[begin + first + item]];
            mask[item] = list_mask[begin + first + item];
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        const int is_done = clear_pixels == 0;
        barrier(CLK_LOCAL_MEM_FENCE); // everybody has read clear_pixels
        if (is_done) break;           // the same for the whole group
        blend_pixel(frame.alpha_max, staged, mask, batch, first, pixel_block(x, y), (float)get_global_id(0) + 0.5f,
                    (float)get_global_id(1) + 0.5f, &state);
    }

    const size_t plane = (size_t)frame.rows * frame.stride;
    const size_t pixel = get_global_id(1) * frame.stride + get_global_id(0);
    rgb[pixel] = fma(state.t, frame.background[0], state.r);
    rgb[pixel + plane] = fma(state.t, frame.background[1], state.g);
    rgb[pixel + 2 * plane] = fma(state.t, frame.background[2], state.b);
    transmittance[tile * TILE_PIXELS + pixel_place(x, y)] = state.t;
    last[tile * TILE_PIXELS + pixel_place(x, y)] = state.last;
}
