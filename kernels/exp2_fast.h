// exp2_fast.h - 2^x for exponents in [-126, 127], scalar and sixteen at once, from eight operations.
//
// x = n + f with n the nearest integer: adding and subtracting 1.5 * 2^23 rounds, and leaves n in the low bits of the sum. 2^f on
// [-1/2, 1/2] is a minimax polynomial of degree 5 (relative error 7.5e-8, as good as float is); n goes into the exponent bits.
// The compiler must not fold the rounding: never -cl-unsafe-math-optimizations nor -cl-fast-relaxed-math.
// Outside the range the result is garbage: the callers select it away.
// On PoCL the built-in exp2() makes the whole forward blend 35 % slower. Test: the pictures of
// tests/splat3d/test_opencl_rasterizer.c.
#ifndef SPLATLAB_KERNELS_EXP2_FAST_H
#define SPLATLAB_KERNELS_EXP2_FAST_H

#define EXP2_ROUNDER 12582912.0f // 1.5 * 2^23

#define DEFINE_EXP2_FAST(NAME, FLOAT, INT)                                                                             \
    static inline FLOAT NAME(FLOAT x) {                                                                                \
        const FLOAT shifted = x + EXP2_ROUNDER;                                                                        \
        const FLOAT f = x - (shifted - EXP2_ROUNDER);                                                                  \
        FLOAT p = fma((FLOAT)(0.00132764722f), f, (FLOAT)(0.00967554133f));                                            \
        p = fma(p, f, (FLOAT)(0.0555071327f));                                                                         \
        p = fma(p, f, (FLOAT)(0.240221197f));                                                                          \
        p = fma(p, f, (FLOAT)(0.693146967f));                                                                          \
        p = fma(p, f, (FLOAT)(1.00000007f));                                                                           \
        return as_##FLOAT(as_##INT(p) + (as_##INT(shifted) << 23));                                                    \
    }

DEFINE_EXP2_FAST(exp2_fast, float, int)
DEFINE_EXP2_FAST(exp2_fast16, float16, int16)

#endif
