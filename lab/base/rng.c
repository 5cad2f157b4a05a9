// rng.c - Philox4x32-10 and the distributions drawn from it.
#include "lab/base/rng.h"

#include <assert.h>
#include <math.h>

// Constants of the paper, table 2: multipliers, and the Weyl sequence by which the key changes each round
// (golden ratio and sqrt(3) - 1, times 2^32).
static const uint32_t MULTIPLIER_0 = 0xD2511F53, MULTIPLIER_1 = 0xCD9E8D57;
static const uint32_t WEYL_0 = 0x9E3779B9, WEYL_1 = 0xBB67AE85;
enum { ROUNDS = 10 };

void rng_philox4x32(const uint32_t counter[4], const uint32_t key[2], uint32_t out[4]) {
    uint32_t c0 = counter[0], c1 = counter[1], c2 = counter[2], c3 = counter[3];
    uint32_t k0 = key[0], k1 = key[1];
    for (int round = 0; round < ROUNDS; round++) {
        uint64_t product_0 = (uint64_t)MULTIPLIER_0 * c0;
        uint64_t product_1 = (uint64_t)MULTIPLIER_1 * c2;
        c0 = (uint32_t)(product_1 >> 32) ^ c1 ^ k0;
        c1 = (uint32_t)product_1;
        c2 = (uint32_t)(product_0 >> 32) ^ c3 ^ k1;
        c3 = (uint32_t)product_0;
        k0 += WEYL_0;
        k1 += WEYL_1;
    }
    out[0] = c0;
    out[1] = c1;
    out[2] = c2;
    out[3] = c3;
}

Rng rng_at(uint64_t seed, RngPurpose purpose, uint32_t a, uint32_t b) {
    return (Rng){.key = {(uint32_t)seed, (uint32_t)(seed >> 32)}, .counter = {0, (uint32_t)purpose, a, b}};
}

uint32_t rng_u32(Rng *rng) {
    if (rng->left == 0) {
        rng_philox4x32(rng->counter, rng->key, rng->block);
        rng->counter[0]++;
        rng->left = 4;
    }
    return rng->block[4 - rng->left--];
}

double rng_uniform(Rng *rng) { return rng_u32(rng) * 0x1p-32; }

double rng_range(Rng *rng, double low, double high) {
    double value = low + (high - low) * rng_uniform(rng);
    return value < high ? value : low; // rounding may reach `high` where the range is narrow
}

double rng_normal(Rng *rng) {
    double radius = sqrt(-2 * log(1 - rng_uniform(rng))); // 1 - u is in (0, 1]: the logarithm is finite
    return radius * cos(2 * M_PI * rng_uniform(rng));
}

uint32_t rng_below(Rng *rng, uint32_t n) {
    assert(n >= 1);
    // The lowest 2^32 mod n values would make some results likelier than others: they are drawn again.
    uint32_t rejected = (uint32_t)-n % n;
    uint32_t value;
    do value = rng_u32(rng);
    while (value < rejected);
    return value % n;
}
