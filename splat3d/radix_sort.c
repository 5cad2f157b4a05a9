// Least significant digit first, three digits of 11 bits: after a stable pass by each, the keys are in order by all
// (Knuth, The Art of Computer Programming 3, 5.2.5). All histograms are taken in one reading.

#include "splat3d/radix_sort.h"

enum { DIGITS = 3, DIGIT_BITS = 11, BUCKETS = 1 << DIGIT_BITS, NUMBER_SHIFT = 32 };

static uint32_t digit(uint64_t key, int d) { return key >> (NUMBER_SHIFT + d * DIGIT_BITS) & (BUCKETS - 1); }

void radix_sort(int count, uint64_t *keys, uint64_t *scratch, uint32_t *order) {
    uint32_t start[DIGITS][BUCKETS] = {0};
    for (int i = 0; i < count; i++)
        for (int d = 0; d < DIGITS; d++) start[d][digit(keys[i], d)]++;
    for (int d = 0; d < DIGITS; d++) {
        uint32_t sum = 0;
        for (int b = 0; b < BUCKETS; b++) {
            uint32_t n = start[d][b];
            start[d][b] = sum;
            sum += n;
        }
    }
    for (int i = 0; i < count; i++) scratch[start[0][digit(keys[i], 0)]++] = keys[i];
    for (int i = 0; i < count; i++) keys[start[1][digit(scratch[i], 1)]++] = scratch[i];
    for (int i = 0; i < count; i++) order[start[2][digit(keys[i], 2)]++] = (uint32_t)keys[i];
}
