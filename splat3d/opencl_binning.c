#include "splat3d/opencl_binning.h"

#include "lab/base/clock.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "splat3d/radix_sort.h"

#include <limits.h>

enum {
    GROUP_SIZE = 64,  // work-items; one splat or one tile each
    CHUNKS_CPU = 32,  // of the counting sort. A device property only: the lists are the same with any number, and
    CHUNKS_GPU = 512, // a GPU needs many work-items at once, where a CPU would rather keep the counts in its cache
};

bool opencl_binning_create(Gpu *gpu, OpenclBinning *binning) {
    *binning = (OpenclBinning){.gpu = gpu};
    const char *tile_rows = gpu_info(gpu)->is_cpu ? "-D TILE_ROWS=4" : "";
    if (gpu_program_create(gpu, "tile_masks.cl", tile_rows, &binning->masks_program) &&
        gpu_kernel(binning->masks_program, "tile_masks", &binning->masks) &&
        gpu_program_create(gpu, "tile_sort.cl", "", &binning->sort_program) &&
        gpu_kernel(binning->sort_program, "tile_sort_count", &binning->count) &&
        gpu_kernel(binning->sort_program, "tile_sort_prefix", &binning->prefix) &&
        gpu_kernel(binning->sort_program, "tile_sort_scatter", &binning->scatter) &&
        gpu_buffer_create(gpu, "depth order", 0, &binning->order) &&
        gpu_buffer_create(gpu, "slot offsets", 0, &binning->offset) &&
        gpu_buffer_create(gpu, "block masks", 0, &binning->mask) &&
        gpu_buffer_create(gpu, "tile counts", 0, &binning->counts) &&
        gpu_buffer_create(gpu, "tile starts", 0, &binning->start) &&
        gpu_buffer_create(gpu, "tile lists (splats)", 0, &binning->list_splat) &&
        gpu_buffer_create(gpu, "tile lists (slots)", 0, &binning->list_slot) &&
        gpu_buffer_create(gpu, "tile lists (masks)", 0, &binning->list_mask))
        return true;
    opencl_binning_destroy(binning);
    return false;
}

void opencl_binning_destroy(OpenclBinning *binning) {
    gpu_buffer_destroy(binning->order);
    gpu_buffer_destroy(binning->offset);
    gpu_buffer_destroy(binning->mask);
    gpu_buffer_destroy(binning->counts);
    gpu_buffer_destroy(binning->start);
    gpu_buffer_destroy(binning->list_splat);
    gpu_buffer_destroy(binning->list_slot);
    gpu_buffer_destroy(binning->list_mask);
    gpu_program_destroy(binning->masks_program);
    gpu_program_destroy(binning->sort_program);
    mem_free(binning->keys);
    mem_free(binning->scratch);
    *binning = (OpenclBinning){0};
}

static void reserve_keys(OpenclBinning *binning, int count) {
    if (count <= binning->keys_capacity) return;
    const int capacity = count + count / 2;
    mem_free(binning->keys);
    mem_free(binning->scratch);
    binning->keys = mem_alloc((size_t)capacity, sizeof *binning->keys);
    binning->scratch = mem_alloc((size_t)capacity, sizeof *binning->scratch);
    binning->keys_capacity = capacity;
}

// Slots in the order of the splats, and the keys of the visible ones; mapped memory of n entries.
static void number_slots(OpenclBinning *binning, int n, const TileBox *box, const float *depth, uint32_t *offset) {
    const double began_s = clock_seconds();
    binning->visible = 0;
    binning->slots = 0;
    for (int i = 0; i < n; i++) {
        offset[i] = (uint32_t)binning->slots;
        const long tiles = (long)(box[i].x1 - box[i].x0) * (box[i].y1 - box[i].y0);
        if (!tiles) continue;
        binning->slots += tiles;
        binning->keys[binning->visible++] = radix_key_depth(depth[i], (uint32_t)i);
    }
    gpu_stage_host(binning->gpu, (clock_seconds() - began_s) * 1e3);
}

static bool fail_too_many(const OpenclBinning *binning) {
    return fail("%d splats touch %ld tiles, more than %d can be sorted; are the scales or the focal length too large? "
                "Smaller pictures need fewer",
                binning->visible, binning->slots, INT_MAX);
}

static bool make_masks(OpenclBinning *binning, const FrameRecord *frame, const OpenclProject *project) {
    return gpu_buffer_reserve(binning->mask, (size_t)binning->slots * sizeof(uint16_t)) &&
           gpu_launch(binning->masks, ((GpuRange){.width = (size_t)frame->splat_count, .group_width = GROUP_SIZE}),
                      gpu_record_arg(frame, sizeof *frame), gpu_buffer_arg(project->screen),
                      gpu_buffer_arg(project->box), gpu_buffer_arg(binning->offset), gpu_buffer_arg(binning->mask)) &&
           gpu_flush(binning->gpu);
}

// The host sorts while the device makes the masks: the order is mapped before, so that the map does not wait for them. (A stage
// report counts the masks, and what the sort takes longer than they do as `other`.)
bool opencl_binning_sort(OpenclBinning *binning, const FrameRecord *frame, const OpenclProject *project) {
    const size_t bytes = (size_t)frame->splat_count * sizeof(uint32_t);
    enum { ORDER, OFFSET, BOX, DEPTH, MAPS };
    gpu_stage(binning->gpu, "sort");
    reserve_keys(binning, frame->splat_count);
    if (!gpu_buffer_reserve(binning->offset, bytes) || !gpu_buffer_reserve(binning->order, bytes)) return false;
    GpuMap maps[MAPS] = {
        [ORDER] = {binning->order, GPU_WRITE, NULL},
        [OFFSET] = {binning->offset, GPU_WRITE, NULL},
        [BOX] = {project->box, GPU_READ, NULL},
        [DEPTH] = {project->depth, GPU_READ, NULL},
    };
    if (!gpu_buffers_map(maps, MAPS)) return false;
    number_slots(binning, frame->splat_count, maps[BOX].pointer, maps[DEPTH].pointer, maps[OFFSET].pointer);
    bool done = true;
    for (int i = OFFSET; i < MAPS; i++) done = gpu_buffer_unmap(maps[i].buffer) && done;
    if (done && binning->slots > INT_MAX) done = fail_too_many(binning);
    done = done && make_masks(binning, frame, project);
    if (done) radix_sort(binning->visible, binning->keys, binning->scratch, maps[ORDER].pointer);
    return gpu_buffer_unmap(binning->order) && done;
}

// Turns each tile's number of pairs into where its list starts.
static bool place_lists(OpenclBinning *binning, int tile_count) {
    void *mapped;
    if (!gpu_buffer_map(binning->start, GPU_READ_WRITE, &mapped)) return false;
    uint32_t *start = mapped, sum = 0;
    for (int tile = 0; tile < tile_count; tile++) {
        const uint32_t pairs = start[tile];
        start[tile] = sum;
        sum += pairs;
    }
    start[tile_count] = sum;
    binning->pairs = sum;
    return gpu_buffer_unmap(binning->start) && gpu_buffer_reserve(binning->list_splat, sum * sizeof(uint32_t)) &&
           gpu_buffer_reserve(binning->list_slot, sum * sizeof(uint32_t)) &&
           gpu_buffer_reserve(binning->list_mask, sum * sizeof(uint16_t));
}

bool opencl_binning_lists(OpenclBinning *binning, const FrameRecord *frame, const OpenclProject *project) {
    const int tile_count = frame->tiles_x * frame->tiles_y;
    const int chunks = gpu_info(binning->gpu)->is_cpu ? CHUNKS_CPU : CHUNKS_GPU;
    const int chunk_length = (binning->visible + chunks - 1) / chunks;

    gpu_stage(binning->gpu, "bin");
    if (!gpu_buffer_reserve(binning->counts, (size_t)chunks * (size_t)tile_count * sizeof(uint32_t)) ||
        !gpu_buffer_reserve(binning->start, ((size_t)tile_count + 1) * sizeof(uint32_t)))
        return false;
    if (!gpu_launch(binning->count, ((GpuRange){.width = (size_t)chunks, .group_width = 1}),
                    gpu_int_arg(binning->visible), gpu_int_arg(chunk_length), gpu_int_arg(frame->tiles_x),
                    gpu_int_arg(tile_count), gpu_int_arg(chunks), gpu_buffer_arg(binning->order),
                    gpu_buffer_arg(project->box), gpu_buffer_arg(binning->offset), gpu_buffer_arg(binning->mask),
                    gpu_buffer_arg(binning->counts)) ||
        !gpu_launch(binning->prefix, ((GpuRange){.width = (size_t)tile_count, .group_width = GROUP_SIZE}),
                    gpu_int_arg(tile_count), gpu_int_arg(chunks), gpu_buffer_arg(binning->counts),
                    gpu_buffer_arg(binning->start)) ||
        !place_lists(binning, tile_count))
        return false;
    return gpu_launch(
        binning->scatter, ((GpuRange){.width = (size_t)chunks, .group_width = 1}), gpu_int_arg(binning->visible),
        gpu_int_arg(chunk_length), gpu_int_arg(frame->tiles_x), gpu_int_arg(tile_count), gpu_int_arg(chunks),
        gpu_buffer_arg(binning->order), gpu_buffer_arg(project->box), gpu_buffer_arg(binning->offset),
        gpu_buffer_arg(binning->mask), gpu_buffer_arg(binning->counts), gpu_buffer_arg(binning->start),
        gpu_buffer_arg(binning->list_splat), gpu_buffer_arg(binning->list_slot), gpu_buffer_arg(binning->list_mask));
}
