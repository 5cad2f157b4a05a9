// bench_ceiling.c - runs native code on the arrays of the device, which on a CPU are plain memory.
#include "lab/app/bench_ceiling.h"

#include "lab/base/clock.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/base/parallel.h"

#include <math.h>
#include <string.h>

struct BenchCeiling {
    BenchStages *stages; // borrowed
    bool has_blend;      // native code that can reach the device's memory

    // What the native blend computes; sizes in elements. Grown when needed.
    float *rgb, *transmittance;
    int32_t *last;
    PairGradient *records;
    uint16_t *mask_of_slot; // 1: there may be a record
    size_t pixels, record_count;

    char *from, *to;               // copied between
    size_t room_bytes, copy_bytes; // of each; of the stage at hand
};

BenchCeiling *bench_ceiling_create(const Gpu *gpu, BenchStages *stages) {
    BenchCeiling *c = mem_alloc(1, sizeof *c);
    c->stages = stages;
    c->has_blend = gpu_info(gpu)->is_cpu && native_blend_name();
    return c;
}

void bench_ceiling_destroy(BenchCeiling *c) {
    if (!c) return;
    mem_free(c->rgb);
    mem_free(c->transmittance);
    mem_free(c->last);
    mem_free(c->records);
    mem_free(c->mask_of_slot);
    mem_free(c->from);
    mem_free(c->to);
    mem_free(c);
}

static bool is_blend(BenchStage stage) { return stage == BENCH_BLEND_FORWARD || stage == BENCH_BLEND_BACKWARD; }

bool bench_ceiling_exists(const BenchCeiling *c, BenchStage stage) {
    return is_blend(stage) ? c->has_blend : bench_stages_bytes(c->stages, stage) > 0;
}

static void make_room(BenchCeiling *c, const NativeBlend *blend, size_t slots) {
    const size_t pixels = (size_t)blend->frame.stride * (size_t)blend->frame.rows;
    if (pixels > c->pixels) {
        c->rgb = mem_resize(c->rgb, 3 * c->pixels, 3 * pixels, sizeof *c->rgb);
        c->transmittance = mem_resize(c->transmittance, c->pixels, pixels, sizeof *c->transmittance);
        c->last = mem_resize(c->last, c->pixels, pixels, sizeof *c->last);
        c->pixels = pixels;
    }
    if (slots > c->record_count) {
        c->records = mem_resize(c->records, c->record_count, slots, sizeof *c->records);
        c->mask_of_slot = mem_resize(c->mask_of_slot, c->record_count, slots, sizeof *c->mask_of_slot);
        for (size_t i = 0; i < slots; i++) c->mask_of_slot[i] = 1;
        c->record_count = slots;
    }
}

// The device's lists, with outputs of our own.
static bool open_native(BenchCeiling *c, NativeBlend *device, NativeBlend *native) {
    BenchWork work;
    if (!bench_stages_work(c->stages, &work) || !bench_stages_map(c->stages, device)) return false;
    make_room(c, device, (size_t)work.pairs_box);
    *native = *device;
    native->rgb = c->rgb;
    native->transmittance = c->transmittance;
    native->last = c->last;
    native->records = c->records;
    native->mask_of_slot = c->mask_of_slot;
    return true;
}

static bool run_blend(BenchCeiling *c, BenchStage stage, double *ms) {
    NativeBlend device, native;
    if (!open_native(c, &device, &native)) return false;
    if (stage == BENCH_BLEND_BACKWARD) { // from the kernel's own forward pass
        native.transmittance = device.transmittance;
        native.last = device.last;
    }
    const double began_s = clock_seconds();
    if (stage == BENCH_BLEND_FORWARD)
        native_blend_forward(&native);
    else
        native_blend_backward(&native);
    *ms = 1e3 * (clock_seconds() - began_s);
    return bench_stages_unmap(c->stages);
}

static void copy_part(void *context, int part) {
    BenchCeiling *c = context;
    const size_t parts = (size_t)parallel_threads(), at = (size_t)part;
    const size_t begin = c->copy_bytes * at / parts, end = c->copy_bytes * (at + 1) / parts;
    memcpy(c->to + begin, c->from + begin, end - begin);
}

// Half of the bytes are read, half written. Memory grows to what the largest stage needs, and is touched beforehand.
static double run_copy(BenchCeiling *c, size_t bytes) {
    c->copy_bytes = bytes / 2;
    if (c->copy_bytes > c->room_bytes) {
        mem_free(c->from);
        mem_free(c->to);
        c->room_bytes = c->copy_bytes;
        c->from = mem_alloc(c->room_bytes, 1);
        c->to = mem_alloc(c->room_bytes, 1);
        memset(c->from, 1, c->room_bytes); // pages that were never written are all the same one
        memset(c->to, 1, c->room_bytes);
    }
    const double began_s = clock_seconds();
    parallel_for(parallel_threads(), copy_part, c);
    return 1e3 * (clock_seconds() - began_s);
}

bool bench_ceiling_run(BenchCeiling *c, BenchStage stage, double *ms) {
    if (is_blend(stage)) return run_blend(c, stage, ms);
    *ms = run_copy(c, bench_stages_bytes(c->stages, stage));
    return true;
}

// |a - b|_2 / |b|_2
typedef struct {
    double difference, size; // squared
} Distance;

static void distance_add(Distance *d, float a, float b) {
    d->difference += ((double)a - (double)b) * ((double)a - (double)b);
    d->size += (double)b * (double)b;
}

static double distance(Distance d) { return d.size > 0 ? sqrt(d.difference / d.size) : sqrt(d.difference); }

static Distance picture_distance(const NativeBlend *a, const NativeBlend *b) {
    const FrameRecord *frame = &a->frame;
    Distance d = {0};
    for (int row = 0; row < 3 * frame->rows; row++)
        for (int x = 0; x < frame->stride; x++)
            distance_add(&d, a->rgb[row * frame->stride + x], b->rgb[row * frame->stride + x]);
    return d;
}

static Distance record_distance(const NativeBlend *a, const NativeBlend *b) {
    enum { FLOATS = sizeof(PairGradient) / sizeof(float) };
    const uint32_t pairs = a->start[a->frame.tiles_x * a->frame.tiles_y];
    Distance d = {0};
    for (uint32_t i = 0; i < pairs; i++) {
        const PairGradient nothing = {0}; // what a pair without a record stands for
        const uint32_t slot = a->list_slot[i];
        const float *x = (const float *)(a->mask_of_slot[slot] ? &a->records[slot] : &nothing);
        const float *y = (const float *)(b->mask_of_slot[slot] ? &b->records[slot] : &nothing);
        for (int k = 0; k < FLOATS; k++) distance_add(&d, x[k], y[k]);
    }
    return d;
}

bool bench_ceiling_check(BenchCeiling *c) {
    // Rounding differs by the order of a sum; where an alpha stands on the threshold, a pixel differs by 1/255 at most.
    static const double PICTURE_TOLERANCE = 1e-4, RECORD_TOLERANCE = 1e-3;
    NativeBlend device, native;
    if (!open_native(c, &device, &native)) return false;
    const double picture = distance(picture_distance(&native, &device));
    const double records = distance(record_distance(&native, &device));
    if (!bench_stages_unmap(c->stages)) return false;
    if (picture < PICTURE_TOLERANCE && records < RECORD_TOLERANCE) return true;
    return fail("native blend (%s) and kernels disagree: pictures by %.2g (tolerance %.2g), gradients by %.2g (%.2g), "
                "relative; one of them is wrong: run the tests of the rasterizer",
                native_blend_name(), picture, PICTURE_TOLERANCE, records, RECORD_TOLERANCE);
}
