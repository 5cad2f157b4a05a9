// The host side of kernels/self_test.cl: the same sums, and the comparison.

#include "lab/gpu/opencl.h"

#include "kernels/self_test.h"
#include "lab/base/fail.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

static const float SCALE = 0.3712f; // any number whose multiples have full mantissas

static float float_of(uint32_t bits) {
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static uint32_t bits_of(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static uint32_t expected_integer(uint32_t i) {
    uint64_t product = (uint64_t)(uint32_t)(i * 0x9E3779B9u) * 0xD2511F53u;
    return ((uint32_t)(product >> 32) ^ (i << 13)) + (i >> 3) - 11u;
}

static bool same_word(const char *what, uint32_t item, uint32_t actual, uint32_t expected) {
    if (actual == expected) return true;
    return fail("%s of work-item %" PRIu32 ": 0x%08" PRIx32 ", want 0x%08" PRIx32
                "; choose another device with --device, or update its driver",
                what, item, actual, expected);
}

static bool item_is_right(uint32_t i, const uint32_t *answers) {
    // x is one multiplication and one subtraction, which the device may fuse: both roundings are right.
    float fused = fmaf((float)i, SCALE, -3.0f), apart = (float)i * SCALE;
    apart -= 3.0f;
    float x = answers[1] == bits_of(fmaf(fused, fused, -9.0f)) ? fused : apart;
    if (!same_word("integer arithmetic", i, answers[0], expected_integer(i)) ||
        !same_word("fma", i, answers[1], bits_of(fmaf(x, x, -9.0f))) ||
        !same_word("rounding by 1.5 * 2^23", i, answers[3], bits_of(rintf(x) + 0.0f)) ||
        !same_word("local memory behind a barrier", i, answers[4],
                   (SELF_TEST_ITEMS - 1 - i) * (SELF_TEST_ITEMS - 1 - i) + 7u))
        return false;
    double power = exp2((double)x), actual = float_of(answers[2]), tolerance = 4 * 0x1p-23 * power;
    if (fabs(actual - power) <= tolerance) return true;
    return fail("exp2 of work-item %" PRIu32 ": %.9g, want %.9g; choose another device with --device, or update its "
                "driver",
                i, actual, power);
}

static bool self_test_launch(Gpu *gpu, GpuProgram *program, GpuBuffer *buffer, uint32_t *answers) {
    GpuKernel *kernel;
    GpuRange range = {.width = SELF_TEST_ITEMS, .group_width = SELF_TEST_ITEMS};
    return gpu_kernel(program, "self_test", &kernel) &&
           gpu_launch(kernel, range, gpu_buffer_arg(buffer), gpu_float_arg(SCALE)) && gpu_finish(gpu) &&
           gpu_buffer_read(buffer, answers, sizeof(uint32_t) * SELF_TEST_ITEMS * SELF_TEST_ANSWERS);
}

bool self_test_run(Gpu *gpu) {
    uint32_t answers[SELF_TEST_ITEMS * SELF_TEST_ANSWERS];
    GpuProgram *program = NULL;
    GpuBuffer *buffer = NULL;
    bool good = gpu_program_create(gpu, "self_test.cl", "", &program) &&
                gpu_buffer_create(gpu, "self-test answers", sizeof answers, &buffer) &&
                self_test_launch(gpu, program, buffer, answers);
    for (uint32_t i = 0; good && i < SELF_TEST_ITEMS; i++) good = item_is_right(i, answers + i * SELF_TEST_ANSWERS);
    gpu_buffer_destroy(buffer);
    gpu_program_destroy(program);
    return good;
}
