// self_test.cl - small sums with known answers, run before a device is trusted with a training.
//
// One group of SELF_TEST_ITEMS work-items; item i writes SELF_TEST_ANSWERS words at answers[i * SELF_TEST_ANSWERS]:
//   0  integer arithmetic: a 64-bit product, shifts, wrap-around
//   1  fma(), bit for bit: it must round once
//   2  exp2(), within 3 ulp of the true value (OpenCL 1.2, table 7.1), as bits
//   3  rounding to an integer by adding and subtracting 1.5 * 2^23: the compiler must not fold it (no fast-math)
//   4  a value that another work-item put into local memory before a barrier
// Local memory: 4 * SELF_TEST_ITEMS bytes. Host side, with the expected answers: lab/gpu/self_test.c.
#include "self_test.h"

__kernel void self_test(__global uint *answers, const float scale) {
    __local uint slots[SELF_TEST_ITEMS];
    const uint i = (uint)get_local_id(0);
    const float x = (float)i * scale - 3.0f;

    slots[i] = i * i + 7u;
    barrier(CLK_LOCAL_MEM_FENCE);

    __global uint *mine = answers + i * SELF_TEST_ANSWERS;
    mine[0] = (mul_hi(i * 0x9E3779B9u, 0xD2511F53u) ^ (i << 13)) + (i >> 3) - 11u;
    mine[1] = as_uint(fma(x, x, -9.0f));
    mine[2] = as_uint(exp2(x));
    mine[3] = as_uint((x + 12582912.0f) - 12582912.0f);
    mine[4] = slots[SELF_TEST_ITEMS - 1 - i];
}
