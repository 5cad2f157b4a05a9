// tile_sort.cl - a stable counting sort of all (tile, splat) pairs into one list per tile, nearest splat first.
//
// The splats come in depth order and are cut into chunks of equal length. Each chunk is walked by one work-item, so the order
// within a tile is the depth order whatever the number of chunks, and nothing depends on which chunk runs first:
//
//     tile_sort_count     counts[chunk][tile] = pairs of this chunk in this tile
//     tile_sort_prefix    counts[chunk][tile] = pairs of all earlier chunks in this tile; total[tile] = pairs of all
//     (the host turns the totals into the lists' starts)
//     tile_sort_scatter   each pair goes to start[tile] + counts[chunk][tile]++
//
//              tile 0    tile 1    tile 2
//     chunk 0  | 2       | 0       | 1        list of tile 0:  [ 2 pairs of chunk 0 | 1 of chunk 1 | 3 of chunk 2 ]
//     chunk 1  | 1       | 4       | 0                          ^ start[0]
//     chunk 2  | 3       | 1       | 1
//
//     order (V): splats in view, nearest first      box (N), offset (N), mask (P): see tile_masks.cl
//     counts (chunks, tiles), total (tiles), start (tiles + 1)
//     list_splat, list_slot, list_mask (pairs): of each list entry, the splat, the pair's place in mask, its 16 bits
//
// One work-item: one chunk (one tile for the prefix). Local memory: none. Test: tests/splat3d/test_opencl_binning.c.
#include "shared.h"

#include "prefetch.h"

#define BOXES_AHEAD 16 // splats, in depth order
#define MASKS_AHEAD 8

// Splats in depth order lie anywhere in memory: asks for what the loops below will read of later ones, first their boxes and offsets,
// then the masks that those point to.
static void ask_ahead(int rank, int end, __global const uint *order, __global const TileBox *box,
                      __global const uint *offset, __global const ushort *mask) {
    if (rank + BOXES_AHEAD < end) {
        PREFETCH(box + order[rank + BOXES_AHEAD]);
        PREFETCH(offset + order[rank + BOXES_AHEAD]);
    }
    if (rank + MASKS_AHEAD < end) PREFETCH(mask + offset[order[rank + MASKS_AHEAD]]);
}

__kernel void tile_sort_count(const int visible, const int chunk_length, const int tiles_x, const int tile_count,
                              const int chunk_count, __global const uint *order, __global const TileBox *box,
                              __global const uint *offset, __global const ushort *mask, __global uint *counts) {
    const int chunk = (int)get_global_id(0);
    if (chunk >= chunk_count) return;
    __global uint *count = counts + (size_t)chunk * tile_count;
    for (int tile = 0; tile < tile_count; tile++) count[tile] = 0;

    const int end = min(visible, (chunk + 1) * chunk_length);
    for (int rank = chunk * chunk_length; rank < end; rank++) {
        const uint i = order[rank];
        ask_ahead(rank, end, order, box, offset, mask);
        const TileBox tiles = box[i];
        uint slot = offset[i];
        for (int y = tiles.y0; y < tiles.y1; y++)
            for (int x = tiles.x0; x < tiles.x1; x++) count[y * tiles_x + x] += mask[slot++] != 0;
    }
}

__kernel void tile_sort_prefix(const int tile_count, const int chunk_count, __global uint *counts,
                               __global uint *total) {
    const int tile = (int)get_global_id(0);
    if (tile >= tile_count) return;
    uint sum = 0;
    for (int chunk = 0; chunk < chunk_count; chunk++) {
        const size_t at = (size_t)chunk * tile_count + tile;
        const uint count = counts[at];
        counts[at] = sum;
        sum += count;
    }
    total[tile] = sum;
}

__kernel void tile_sort_scatter(const int visible, const int chunk_length, const int tiles_x, const int tile_count,
                                const int chunk_count, __global const uint *order, __global const TileBox *box,
                                __global const uint *offset, __global const ushort *mask, __global uint *counts,
                                __global const uint *start, __global uint *list_splat, __global uint *list_slot,
                                __global ushort *list_mask) {
    const int chunk = (int)get_global_id(0);
    if (chunk >= chunk_count) return;
    __global uint *count = counts + (size_t)chunk * tile_count;

    const int end = min(visible, (chunk + 1) * chunk_length);
    for (int rank = chunk * chunk_length; rank < end; rank++) {
        const uint i = order[rank];
        ask_ahead(rank, end, order, box, offset, mask);
        const TileBox tiles = box[i];
        uint slot = offset[i];
        for (int y = tiles.y0; y < tiles.y1; y++)
            for (int x = tiles.x0; x < tiles.x1; x++, slot++) {
                const ushort bits = mask[slot];
                if (!bits) continue;
                const int tile = y * tiles_x + x;
                const uint at = start[tile] + count[tile]++;
                list_splat[at] = i;
                list_slot[at] = slot;
                list_mask[at] = bits;
            }
    }
}
