// rng.h - random numbers as a pure function of a key: no hidden state, so a run can be stopped, resumed
// and split over threads and still draw the same numbers.
//
// Philox4x32-10 (Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC 2011): a counter of
// 128 bit is scrambled with a key of 64 bit. The key is the user's seed; the counter says what the number is for:
// (purpose, a, b, draw), e.g. (RNG_SPLIT, iteration, splat, 0).
#ifndef SPLATLAB_LAB_BASE_RNG_H
#define SPLATLAB_LAB_BASE_RNG_H

#include <stdint.h>

// What a random number is for; a new use gets a new line, never the number of an old one.
typedef enum {
    RNG_TEST = 0,
    RNG_VIEW_ORDER = 1,   // a: epoch
    RNG_SPLIT = 2,        // a: iteration, b: splat
    RNG_BACKGROUND = 3,   // a: iteration
    RNG_INIT_POINTS = 4,  // a: point
    RNG_SCENE_PIXEL = 5,  // sample scenes: a: view, b: pixel
    RNG_SCENE_LAYOUT = 6, // sample scenes: a: object kind, b: object
    RNG_SCENE_POINTS = 7, // sample scenes: a: point
    RNG_SCENE_PATH = 8,   // sample scenes: a: view
    RNG_BENCH = 9,        // a: splat
    RNG_EXERCISE = 10,    // a: claim, b: case
    RNG_EWA_CLOUD = 13,   // points of one splat
    RNG_FIGURE = 14,      // points of a drawing
} RngPurpose;

// A stream of numbers for one purpose and one (a, b); cheap to make, lives on the stack.
typedef struct {
    uint32_t key[2];
    uint32_t counter[4]; // draw, purpose, a, b
    uint32_t block[4];   // the four numbers of the current draw
    int left;            // how many of them are not yet used, 0..4
} Rng;

Rng rng_at(uint64_t seed, RngPurpose purpose, uint32_t a, uint32_t b);

uint32_t rng_u32(Rng *rng);
double rng_uniform(Rng *rng);                        // [0, 1), 32 random bits
double rng_range(Rng *rng, double low, double high); // [low, high)
double rng_normal(Rng *rng);                         // mean 0, standard deviation 1 (Box-Muller)
uint32_t rng_below(Rng *rng, uint32_t n);            // 0..n-1 without bias; n >= 1

// The bare generator: out[4] from counter[4] and key[2]; checked against the paper's known answers.
void rng_philox4x32(const uint32_t counter[4], const uint32_t key[2], uint32_t out[4]);

#endif
