// lanes.h - a few neighbouring pixels at once: 16 bytes of numbers that add and multiply like one number.
//
// Every processor of the last twenty years computes four floats as fast as one; the compiler's vector type says so without
// a word about any of them. A loop over pixels in steps of LANES reads like the loop over pixels it stands for.
// Real is float; the tests of gradients compile the same code with LANES_DOUBLE.
#ifndef SPLATLAB_SPLAT2D_LANES_H
#define SPLATLAB_SPLAT2D_LANES_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#ifdef LANES_DOUBLE
typedef double Real;
typedef int64_t RealBits;
#else
typedef float Real;
typedef int32_t RealBits;
#endif

enum { LANES = 16 / sizeof(Real) };
typedef Real Lanes __attribute__((vector_size(16)));
typedef RealBits Mask __attribute__((vector_size(16))); // a comparison of Lanes: all bits set where it holds, else none

static inline Lanes lanes_all(Real value) { return value - (Lanes){0}; }

static inline Lanes lanes_load(const Real *from) {
    Lanes lanes;
    memcpy(&lanes, from, sizeof lanes); // one instruction; from need not be aligned
    return lanes;
}

static inline void lanes_store(Real *to, Lanes lanes) { memcpy(to, &lanes, sizeof lanes); }

// first, first + 1, first + 2, ...
static inline Lanes lanes_count_from(Real first) {
    Lanes lanes;
    for (int i = 0; i < LANES; i++) lanes[i] = first + (Real)i;
    return lanes;
}

static inline Lanes lanes_where(Mask mask, Lanes yes, Lanes no) {
    return (Lanes)((mask & (Mask)yes) | (~mask & (Mask)no));
}

// yes where the mask holds, else 0.
static inline Lanes lanes_only(Mask mask, Lanes yes) { return (Lanes)(mask & (Mask)yes); }

static inline Lanes lanes_min(Lanes a, Lanes b) { return lanes_where(a < b, a, b); }

static inline bool lanes_any(Mask mask) {
    int64_t halves[2];
    memcpy(halves, &mask, sizeof halves);
    return (halves[0] | halves[1]) != 0;
}

// The sum over the lanes, from the first to the last.
static inline Real lanes_sum(Lanes lanes) {
    Real sum = lanes[0];
    for (int i = 1; i < LANES; i++) sum += lanes[i];
    return sum;
}

// 2^x. For floats: x = n + f with the nearest integer n (adding 1.5 * 2^23 rounds, and leaves n in the low bits); 2^f by
// a minimax polynomial of degree 5, relative error 1e-7; n goes into the exponent. x is clamped to -126..126.
static inline Lanes lanes_exp2(Lanes x) {
#ifdef LANES_DOUBLE
    for (int i = 0; i < LANES; i++) x[i] = exp2(x[i]);
    return x;
#else
    const float rounder = 12582912.0f;
    x = lanes_where(x < 126.0f, x, lanes_all(126));
    x = lanes_where(x > -126.0f, x, lanes_all(-126));
    Lanes shifted = x + rounder;
    Lanes f = x - (shifted - rounder);
    Lanes p = 0.0013276472f * f + 0.00967554133f;
    p = p * f + 0.0555071327f;
    p = p * f + 0.240221197f;
    p = p * f + 0.693146967f;
    p = p * f + 1.00000007f;
    return (Lanes)((Mask)p + ((Mask)shifted << 23));
#endif
}

#endif
