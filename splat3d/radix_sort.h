// radix_sort.h - indices in the order of 32-bit numbers, on the host: splats from near to far, or along a curve through space.
//
// On a CPU device the host's own memory holds the depths, and one thread sorts 100,000 of them in less than a millisecond, while kernels
// make the tile masks.
#ifndef SPLATLAB_SPLAT3D_RADIX_SORT_H
#define SPLATLAB_SPLAT3D_RADIX_SORT_H

#include <stdint.h>
#include <string.h>

// What to sort by above, the index below.
static inline uint64_t radix_key(uint32_t number, uint32_t index) { return (uint64_t)number << 32 | index; }

// By a depth >= 0, whose bits order as it does.
static inline uint64_t radix_key_depth(float depth, uint32_t index) {
    uint32_t bits;
    memcpy(&bits, &depth, sizeof bits);
    return radix_key(bits, index);
}

// order (count): order[rank] is the index of the key with the rank-th smallest number; equal numbers keep the order in which the keys
// come. keys and scratch (count each) are overwritten. count >= 0.
void radix_sort(int count, uint64_t *keys, uint64_t *scratch, uint32_t *order);

#endif
