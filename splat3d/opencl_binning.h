// opencl_binning.h - which splats each tile has to blend, nearest first: depth sort, exact masks, and a stable counting
// sort into tiles (kernels/tile_masks.cl, kernels/tile_sort.cl).
//
// Splats are sorted by depth once, not once per tile; the masks leave out every tile that the ellipse misses, about a third of
// those that the usual square around it touches. A splat owns one slot for each tile of its box, in the order of the splats; the
// backward pass puts its records there.
#ifndef SPLATLAB_SPLAT3D_OPENCL_BINNING_H
#define SPLATLAB_SPLAT3D_OPENCL_BINNING_H

#include "kernels/shared.h"
#include "lab/gpu/gpu.h"
#include "splat3d/opencl_project.h"

#include <stdint.h>

typedef struct {
    Gpu *gpu;
    GpuProgram *masks_program, *sort_program;
    GpuKernel *masks, *count, *prefix, *scatter;

    int visible;       // V: splats whose box is not empty
    long slots;        // P: tiles of all boxes
    long pairs;        // of them, those that the ellipse reaches
    GpuBuffer *order;  // (V) uints: splats, nearest first, equal depths by index
    GpuBuffer *offset; // (N) uints: a splat's first slot
    GpuBuffer *mask;   // (P) ushorts: blocks that the ellipse reaches, bit 4 row + column; backward: 0 for hidden pairs
    GpuBuffer *counts; // (chunks, tiles) uints, scratch of the counting sort

    // The lists of all tiles one after the other, tile by tile in rows.
    GpuBuffer *start;      // (tiles + 1) uints: where a tile's list begins
    GpuBuffer *list_splat; // (pairs) uints
    GpuBuffer *list_slot;  // (pairs) uints
    GpuBuffer *list_mask;  // (pairs) ushorts

    uint64_t *keys, *scratch; // host, for the depth sort
    int keys_capacity;
} OpenclBinning;

bool opencl_binning_create(Gpu *gpu, OpenclBinning *binning);
void opencl_binning_destroy(OpenclBinning *binning); // accepts a zeroed, half-built or destroyed one

// From what opencl_project_forward() left, in two stages: slots, masks and the depth order (waits for the device; fails when there
// are more than 2^31 - 1 slots), then the lists (waits once, for their lengths).
bool opencl_binning_sort(OpenclBinning *binning, const FrameRecord *frame, const OpenclProject *project);
bool opencl_binning_lists(OpenclBinning *binning, const FrameRecord *frame, const OpenclProject *project);

#endif
