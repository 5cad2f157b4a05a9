// kernels/exp2_fast.h: close to 2^x, and the same bits by each of its ways.

#include "lab/base/fail.h"
#include "lab/gpu/gpu.h"
#include "tests/support/support.h"

#include <math.h>
#include <string.h>

enum { COUNT = 1 << 16 }; // exponents, a multiple of 16

static const char SOURCE[] = "#include \"exp2_fast.h\"\n"
                             "__kernel void powers(__global const float *x, __global float *vector, __global float "
                             "*portable, __global float *scalar) {\n"
                             "    const size_t i = get_global_id(0);\n"
                             "    const float16 v = vload16(i, x);\n"
                             "    vstore16(exp2_fast16(v), i, vector);\n"
                             "    vstore16(exp2_fast16_portable(v), i, portable);\n"
                             "    for (size_t k = 16 * i; k < 16 * i + 16; k++) scalar[k] = exp2_fast(x[k]);\n"
                             "}\n";

// Densest where the blend has them, [-8, 0]; whole numbers and their neighbours; down to where floats end.
static float exponent(int i) {
    const int whole = -(i / 3 % 120);
    if (i < COUNT / 2) return -8.0f * (float)i / (COUNT / 2);
    if (i < COUNT * 3 / 4) return i % 3 == 0 ? (float)whole : nextafterf((float)whole, i % 3 == 1 ? -200.0f : 200.0f);
    return -125.0f + 250.0f * (float)(i - COUNT * 3 / 4) / (COUNT / 4);
}

static GpuBuffer *buffer(Gpu *gpu) {
    GpuBuffer *b;
    if (!gpu_buffer_create(gpu, "powers", COUNT * sizeof(float), &b)) fail_msg("%s", fail_text());
    return b;
}

static void powers_are_close_and_the_same_bits_by_every_way(void **state) {
    (void)state;
    static float x[COUNT], vector[COUNT], portable[COUNT], scalar[COUNT];
    Gpu *gpu;
    GpuProgram *program;
    GpuKernel *kernel;
    const char *folder = support_scratch();
    FILE *file = fopen(support_path(folder, "powers.cl"), "w");
    assert_non_null(file);
    fputs(SOURCE, file);
    fclose(file);
    gpu_set_kernel_folder(folder);
    if (!gpu_open("", &gpu) || !gpu_program_create(gpu, "powers.cl", "", &program) ||
        !gpu_kernel(program, "powers", &kernel))
        fail_msg("%s", fail_text());
    GpuBuffer *of_x = buffer(gpu), *of_vector = buffer(gpu), *of_portable = buffer(gpu), *of_scalar = buffer(gpu);
    for (int i = 0; i < COUNT; i++) x[i] = exponent(i);
    assert_true(gpu_buffer_write(of_x, x, sizeof x));
    assert_true(gpu_launch(kernel, gpu_range(COUNT / 16, 1), gpu_buffer_arg(of_x), gpu_buffer_arg(of_vector),
                           gpu_buffer_arg(of_portable), gpu_buffer_arg(of_scalar)));
    assert_true(gpu_buffer_read(of_vector, vector, sizeof vector));
    assert_true(gpu_buffer_read(of_portable, portable, sizeof portable));
    assert_true(gpu_buffer_read(of_scalar, scalar, sizeof scalar));
    for (int i = 0; i < COUNT; i++) {
        const double power = exp2((double)x[i]), error = fabs((double)vector[i] - power) / power;
        if (error > 1.6e-7)
            fail_msg("2^%.9g: %.9g, off by %.3g of it, want 1.6e-7", (double)x[i], (double)vector[i], error);
        if (memcmp(&vector[i], &portable[i], sizeof *x) || memcmp(&vector[i], &scalar[i], sizeof *x))
            fail_msg("2^%.9g: %.9g by the vector's way, %.9g by the portable one, %.9g for one number", (double)x[i],
                     (double)vector[i], (double)portable[i], (double)scalar[i]);
    }
    GpuBuffer *const all[] = {of_x, of_vector, of_portable, of_scalar};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) gpu_buffer_destroy(all[k]);
    gpu_program_destroy(program);
    gpu_close(gpu);
    gpu_set_kernel_folder(NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(powers_are_close_and_the_same_bits_by_every_way),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
