// exp2_fast.h - 2^x for exponents in [-125, 127], scalar and sixteen at once.
//
// x = n + f with n the integer below: 2^f on [0, 1) is a minimax polynomial of degree 5 (relative error 1.5e-7, rounding
// included), and n goes into the exponent bits. AVX-512 has one instruction for f and one for 2^n: seven in all instead of
// ten, with the same bits.
// Outside the range the result is garbage: the callers select it away, right here, before a processor stumbles over the tiny
// numbers among it.
// On PoCL the built-in exp2() makes the whole forward blend take 70 % more time. Test: tests/splat3d/test_exp2_fast.c.
#ifndef SPLATLAB_KERNELS_EXP2_FAST_H
#define SPLATLAB_KERNELS_EXP2_FAST_H

#include "pocl.h"

#ifdef POCL_ON_CPU
#if __has_builtin(__builtin_elementwise_floor)
#define EXP2_FLOOR(x) __builtin_elementwise_floor(x) // floor() is a call for each lane
#endif
#if defined(__AVX512DQ__) && __has_builtin(__builtin_ia32_reduceps512_mask) &&                                         \
    __has_builtin(__builtin_ia32_scalefps512_mask)
#define CPU_IS_AVX512
#endif
#endif
#ifndef EXP2_FLOOR
#define EXP2_FLOOR(x) floor(x)
#endif

#define DEFINE_EXP2_FAST(NAME, FLOAT, INT)                                                                             \
    static inline FLOAT NAME##_of_fraction(FLOAT f) {                                                                  \
        FLOAT p = fma((FLOAT)(0.00187757646f), f, (FLOAT)(0.00898933969f));                                            \
        p = fma(p, f, (FLOAT)(0.0558263138f));                                                                         \
        p = fma(p, f, (FLOAT)(0.240153611f));                                                                          \
        p = fma(p, f, (FLOAT)(0.693153024f));                                                                          \
        return fma(p, f, (FLOAT)(0.99999994f));                                                                        \
    }                                                                                                                  \
    static inline FLOAT NAME##_portable(FLOAT x) {                                                                     \
        const FLOAT n = EXP2_FLOOR(x);                                                                                 \
        return as_##FLOAT(as_##INT(NAME##_of_fraction(x - n)) + (convert_##INT(n) << 23));                             \
    }

DEFINE_EXP2_FAST(exp2_fast, float, int)
DEFINE_EXP2_FAST(exp2_fast16, float16, int16)

static inline float exp2_fast(float x) { return exp2_fast_portable(x); }

static inline float16 exp2_fast16(float16 x) {
#ifdef CPU_IS_AVX512
    const float16 f = __builtin_ia32_reduceps512_mask(x, 1, x, (ushort)-1, 4);
    return __builtin_ia32_scalefps512_mask(exp2_fast16_of_fraction(f), x, x, (ushort)-1, 4);
#else
    return exp2_fast16_portable(x);
#endif
}

#endif
