// blend_backward_gpu.cl - the gradient of the blend, back to front, one work-item per pixel, for GPUs.
//
// The same equations, arguments and records as blend_backward_cpu.cl. What a CPU sums over vector lanes is summed here over the
// group in a fixed order, in local memory: each pixel writes its nine numbers, 9 x 16 work-items add sixteen pixels each, and nine
// add the sixteen partial sums and write the record. Two barriers a splat, no atomics on floats, the same bits in every run.
//
//     part[value][pixel 0..255]  --16 at a time-->  strip[value][0..15]  -->  record[value]
//
// One work-item: one pixel (group TILE_SIZE x TILE_SIZE = one tile).
// Local memory: staged 256 * (48 + 2 + 4), part 9 * 256 * 4, strip 9 * 16 * 4, deepest 4: 23,620 bytes.
// Reference: splat3d/reference_blend.c. Test: tests/splat3d/test_opencl_gradients.c.
#include "shared.h"

#include "blend_gpu.h"

#define VALUES (int)(sizeof(PairGradient) / sizeof(float))
#define STRIPS 16 // partial sums of one value

typedef struct {
    float t;      // transmittance in front of everything done so far
    float behind; // light from behind, times the pixel's gradient
    float g_red, g_green, g_blue;
    int last;
} PixelState;

// What this pixel says about one splat: nine numbers to part[value * TILE_PIXELS]. Steps in front of the splat.
static void unblend_pixel(const float alpha_max, ScreenSplat splat, float x, float y, PixelState *state,
                          __local float *part) {
    const float dy = y - splat.y;
    const float u = fma(splat.shear, dy, x - splat.x);
    const float power = fma(splat.along_u * u, u, fma(splat.along_v * dy, dy, splat.log2_opacity));
    float w = 0, weight = 0;
    if (power >= LOG2_ALPHA_MIN) {
        const float free_alpha = exp2_fast(power), alpha = min(free_alpha, alpha_max);
        const float inverse = 1.0f / (1.0f - alpha);
        const float colour_g = fma(splat.r, state->g_red, fma(splat.g, state->g_green, splat.b * state->g_blue));
        const float d_alpha = inverse * fma(state->t, colour_g, -state->behind);
        state->t *= inverse;
        weight = alpha * state->t;
        state->behind = fma(weight, colour_g, state->behind);
        w = free_alpha >= alpha_max ? 0 : alpha * d_alpha;
    }
    part[0 * TILE_PIXELS] = w;
    part[1 * TILE_PIXELS] = w * u;
    part[2 * TILE_PIXELS] = w * dy;
    part[3 * TILE_PIXELS] = w * u * u;
    part[4 * TILE_PIXELS] = w * u * dy;
    part[5 * TILE_PIXELS] = w * dy * dy;
    part[6 * TILE_PIXELS] = weight * state->g_red;
    part[7 * TILE_PIXELS] = weight * state->g_green;
    part[8 * TILE_PIXELS] = weight * state->g_blue;
}

// Sums part over the pixels in a fixed order and writes the record; the whole group calls it, after a barrier behind the
// writes to part. Only nine items read strip afterwards, before they come to the next such barrier.
static void reduce_record(int item, __local const float *part, __local float *strip, __global float *record) {
    if (item < VALUES * STRIPS) {
        const int value = item / STRIPS, lane = item % STRIPS;
        float sum = 0;
        for (int i = lane; i < TILE_PIXELS; i += STRIPS) sum += part[value * TILE_PIXELS + i];
        strip[item] = sum;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    if (item < VALUES) {
        float sum = 0;
        for (int i = 0; i < STRIPS; i++) sum += strip[item * STRIPS + i];
        record[item] = sum;
    }
}

__kernel __attribute__((reqd_work_group_size(TILE_SIZE, TILE_SIZE, 1))) void
blend_backward_gpu(const FrameRecord frame, __global const uint *start, __global const uint *list_splat,
                   __global const uint *list_slot, __global const ushort *list_mask, __global const ScreenSplat *screen,
                   __global const float *transmittance, __global const int *last, __global const float *d_rgb,
                   __global PairGradient *records, __global ushort *mask_of_slot) {
    __local ScreenSplat staged[TILE_PIXELS];
    __local ushort mask[TILE_PIXELS];
    __local uint slot[TILE_PIXELS];
    __local float part[sizeof(PairGradient) / sizeof(float) * TILE_PIXELS];
    __local float strip[sizeof(PairGradient) / sizeof(float) * STRIPS];
    __local int deepest_shared;

    const int x = (int)get_local_id(0), y = (int)get_local_id(1), item = y * TILE_SIZE + x;
    const int tile = (int)(get_group_id(1) * get_num_groups(0) + get_group_id(0));
    const uint begin = start[tile];
    const int count = (int)(start[tile + 1] - begin);
    const size_t plane = (size_t)frame.rows * frame.stride;
    const size_t pixel = get_global_id(1) * frame.stride + get_global_id(0);
    PixelState state;
    state.g_red = d_rgb[pixel], state.g_green = d_rgb[pixel + plane], state.g_blue = d_rgb[pixel + 2 * plane];
    state.t = transmittance[tile * TILE_PIXELS + pixel_place(x, y)];
    state.last = last[tile * TILE_PIXELS + pixel_place(x, y)];
    state.behind = state.t * (frame.background[0] * state.g_red + frame.background[1] * state.g_green +
                              frame.background[2] * state.g_blue);

    if (item == 0) deepest_shared = 0;
    barrier(CLK_LOCAL_MEM_FENCE);
    atomic_max(&deepest_shared, state.last);
    barrier(CLK_LOCAL_MEM_FENCE);
    const int deepest = deepest_shared;
    for (int index = deepest + item; index < count; index += TILE_PIXELS) mask_of_slot[list_slot[begin + index]] = 0;

    for (int top = deepest; top > 0; top -= TILE_PIXELS) { // staged[i] is list entry top - 1 - i
        const int batch = min(top, TILE_PIXELS);
        if (item < batch) {
            const uint entry = begin + top - 1 - item;
            staged[item] = screen[list_splat[entry]];
            mask[item] = list_mask[entry];
            slot[item] = list_slot[entry];
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        for (int i = 0; i < batch; i++) {
            __local float *mine = part + item;
            if (top - 1 - i < state.last && mask[i] >> pixel_block(x, y) & 1)
                unblend_pixel(frame.alpha_max, staged[i], (float)get_global_id(0) + 0.5f,
                              (float)get_global_id(1) + 0.5f, &state, mine);
            else
                for (int value = 0; value < VALUES; value++) mine[value * TILE_PIXELS] = 0;
            barrier(CLK_LOCAL_MEM_FENCE);
            reduce_record(item, part, strip, (__global float *)&records[slot[i]]);
        }
        barrier(CLK_LOCAL_MEM_FENCE); // everybody is done with slot before it is filled again
    }
}
