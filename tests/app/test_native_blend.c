#include "lab/app/bench_ceiling.h"
#include "lab/app/native_tile.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "splat3d/bench_scene.h"
#include "tests/support/support.h"

#include <math.h>
#include <string.h>

enum { WIDTH = 100, HEIGHT = 76, SPLATS = 3000 };

typedef struct {
    Gpu *gpu;
    BenchStages *stages;
} Fixture;

// Every stage has been run once on a small crowd, dense enough that pixels become opaque.
static int open_stages(void **state) {
    static Fixture f;
    const Camera camera = bench_scene_camera(WIDTH, HEIGHT);
    Gaussians model = bench_scene_gaussians(3, SPLATS, &camera);
    Image8 photo = bench_scene_photo(3, WIDTH, HEIGHT);
    bool done = gpu_open("cpu", &f.gpu) && bench_stages_create(f.gpu, BLEND_CPU, &model, &camera, &photo, &f.stages);
    for (BenchStage stage = 0; done && stage < BENCH_STAGE_COUNT; stage++) done = bench_stages_run(f.stages, stage);
    if (!done) print_error("%s\n", fail_text());
    gaussians_destroy(&model);
    image8_destroy(&photo);
    *state = &f;
    return done ? 0 : -1;
}

static int close_stages(void **state) {
    Fixture *f = *state;
    bench_stages_destroy(f->stages);
    gpu_close(f->gpu);
    return 0;
}

static double relative_l2(const float *a, const float *b, size_t count) {
    double difference = 0, size = 0;
    for (size_t i = 0; i < count; i++) {
        difference += ((double)a[i] - (double)b[i]) * ((double)a[i] - (double)b[i]);
        size += (double)b[i] * (double)b[i];
    }
    return sqrt(difference / size);
}

// Blends every tile with that code; pictures, transmittances, last indices and records are those of the kernels.
static void compare(Fixture *f, const NativeTile *tile) {
    NativeBlend device;
    assert_true(bench_stages_map(f->stages, &device));
    const FrameRecord *frame = &device.frame;
    const size_t pixels = (size_t)frame->stride * (size_t)frame->rows;
    const int tiles = frame->tiles_x * frame->tiles_y;
    const uint32_t pairs = device.start[tiles];
    uint32_t slots = 0;
    for (uint32_t i = 0; i < pairs; i++)
        if (device.list_slot[i] >= slots) slots = device.list_slot[i] + 1;
    NativeBlend native = device;
    native.rgb = mem_alloc(3 * pixels, sizeof(float));
    native.transmittance = mem_alloc(pixels, sizeof(float));
    native.last = mem_alloc(pixels, sizeof(int32_t));
    native.records = mem_alloc(slots, sizeof(PairGradient));
    native.mask_of_slot = mem_alloc(slots, sizeof(uint16_t));
    for (uint32_t i = 0; i < slots; i++) native.mask_of_slot[i] = 1;
    float *a = mem_alloc(pairs, sizeof(PairGradient)), *b = mem_alloc(pairs, sizeof(PairGradient));
    for (int i = 0; i < tiles; i++) tile->forward(&native, i);
    for (int i = 0; i < tiles; i++) tile->backward(&native, i);
    uint32_t hidden = 0, other_hidden = 0; // pairs without a record
    for (uint32_t i = 0; i < pairs; i++) {
        const uint32_t slot = device.list_slot[i];
        const bool is_hidden = !native.mask_of_slot[slot];
        hidden += is_hidden;
        other_hidden += is_hidden != !device.mask_of_slot[slot];
        if (!is_hidden) memcpy(a + 9 * i, &native.records[slot], sizeof(PairGradient));
        if (device.mask_of_slot[slot]) memcpy(b + 9 * i, &device.records[slot], sizeof(PairGradient));
    }
    int opaque = 0, other_last = 0;
    for (size_t i = 0; i < pixels; i++) {
        opaque += device.transmittance[i] < TRANSMITTANCE_STOP;
        other_last += native.last[i] != device.last[i];
    }
    assert_true(opaque > (int)pixels / 4);
    assert_true(hidden > pairs / 20);
    assert_true(other_hidden < 40); // one tile's, where the last pixel's alpha stands on the threshold
    assert_true(other_last < 4);    // where an alpha stands on the threshold
    support_near(relative_l2(native.rgb, device.rgb, 3 * pixels), 0, 1e-5, "picture");
    support_near(relative_l2(native.transmittance, device.transmittance, pixels), 0, 1e-5, "transmittance");
    support_near(relative_l2(a, b, 9 * (size_t)pairs), 0, 1e-4, "records");
    mem_free(native.rgb), mem_free(native.transmittance), mem_free(native.last), mem_free(native.records);
    mem_free(native.mask_of_slot);
    mem_free(a), mem_free(b);
    assert_true(bench_stages_unmap(f->stages));
}

static void avx512_code_blends_as_the_kernels_do(void **state) {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) {
        compare(*state, &NATIVE_TILE_AVX512);
        return;
    }
#endif
    (void)state;
    skip();
}

static void avx2_code_blends_as_the_kernels_do(void **state) {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
        compare(*state, &NATIVE_TILE_AVX2);
        return;
    }
#endif
    (void)state;
    skip();
}

static void the_ceiling_refuses_kernels_that_disagree(void **state) {
    Fixture *f = *state;
    NativeBlend device;
    double ms;
    BenchCeiling *ceiling = bench_ceiling_create(f->gpu, f->stages);
    if (!bench_ceiling_exists(ceiling, BENCH_BLEND_FORWARD)) {
        bench_ceiling_destroy(ceiling);
        skip();
    }
    assert_true(bench_ceiling_run(ceiling, BENCH_BLEND_FORWARD, &ms) && ms > 0);
    assert_true(bench_ceiling_run(ceiling, BENCH_BLEND_BACKWARD, &ms) && ms > 0);
    assert_true(bench_ceiling_check(ceiling));
    assert_true(bench_stages_map(f->stages, &device));
    for (int i = 0; i < 64; i++) device.rgb[i] += 0.1f; // a kernel that is wrong in a corner
    assert_true(bench_stages_unmap(f->stages));
    assert_false(bench_ceiling_check(ceiling));
    assert_non_null(strstr(fail_text(), "disagree"));
    assert_true(bench_stages_run(f->stages, BENCH_BLEND_FORWARD));
    bench_ceiling_destroy(ceiling);
}

static void the_work_is_counted(void **state) {
    Fixture *f = *state;
    BenchWork work;
    assert_true(bench_stages_work(f->stages, &work));
    assert_true(work.visible > SPLATS * 9 / 10 && work.visible <= SPLATS);
    assert_true(work.pairs > SPLATS && work.pairs < work.pairs_box && work.pairs_box < work.pairs_square);
    assert_true(work.evaluated > 256.0 * SPLATS / 10 && work.evaluated < 256.0 * (double)work.pairs);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(avx512_code_blends_as_the_kernels_do),
        cmocka_unit_test(avx2_code_blends_as_the_kernels_do),
        cmocka_unit_test(the_ceiling_refuses_kernels_that_disagree),
        cmocka_unit_test(the_work_is_counted),
    };
    return cmocka_run_group_tests(tests, open_stages, close_stages);
}
