// The host side of kernels/adam.cl. The reference is splat2d/adam.c.

#include "splat3d/opencl_adam.h"

#include "lab/base/mem.h"
#include "splat2d/adam.h"

#include <assert.h>
#include <math.h>
#include <stdint.h>

enum { GROUP = 64 }; // work-items
_Static_assert(FIELD_COUNT <= 1 << ADAM_FIELD_BITS, "a field's number does not fit into the word that notes it");

struct OpenclAdam {
    Gpu *gpu;
    bool only_in_view;
    GpuProgram *program; // from the first opencl_adam_step() on
    GpuKernel *adam, *normalize;
    GpuBuffer *not_finite; // one word, as in kernels/adam.cl
};

static bool forget_noted(OpenclAdam *a) {
    const uint32_t none = ADAM_ALL_FINITE;
    return gpu_buffer_write(a->not_finite, &none, sizeof none);
}

bool opencl_adam_create(Gpu *gpu, bool only_in_view, OpenclAdam **adam) {
    OpenclAdam *a = mem_alloc(1, sizeof *a);
    a->gpu = gpu;
    a->only_in_view = only_in_view;
    bool good = gpu_buffer_create(gpu, "Adam's note", sizeof(uint32_t), &a->not_finite) && forget_noted(a);
    *adam = good ? a : NULL;
    if (!good) opencl_adam_destroy(a);
    return good;
}

void opencl_adam_destroy(OpenclAdam *adam) {
    if (!adam) return;
    gpu_buffer_destroy(adam->not_finite);
    gpu_program_destroy(adam->program);
    mem_free(adam);
}

_Static_assert((int)ADAM_MEAN == FIELD_MEAN && (int)ADAM_LOG_SCALE == FIELD_LOG_SCALE && (int)ADAM_QUAT == FIELD_QUAT &&
                   (int)ADAM_OPACITY_LOGIT == FIELD_OPACITY_LOGIT && (int)ADAM_SH0 == FIELD_SH0 &&
                   (int)ADAM_SH1 == FIELD_SH1 && (int)ADAM_SH2 == FIELD_SH2 && (int)ADAM_SH3 == FIELD_SH3 &&
                   (int)ADAM_FIELDS == FIELD_COUNT,
               "the kernels number the fields in another way");

static AdamRecord adam_record(const OpenclAdam *adam, const AdamRule *rule, int step) {
    return (AdamRecord){
        .only_in_view = adam->only_in_view,
        .beta1 = (float)rule->beta1,
        .beta2 = (float)rule->beta2,
        .one_minus_beta1 = (float)(1 - rule->beta1),
        .one_minus_beta2 = (float)(1 - rule->beta2),
        .rate = (float)(rule->learning_rate / (1 - pow(rule->beta1, step))),
        .over_root_v_part = (float)(1 / sqrt(1 - pow(rule->beta2, step))),
        .epsilon = (float)rule->epsilon,
    };
}

static bool create_kernels(OpenclAdam *a) {
    gpu_program_destroy(a->program); // of an attempt that failed
    return gpu_program_create(a->gpu, "adam.cl", "", &a->program) && gpu_kernel(a->program, "adam", &a->adam) &&
           gpu_kernel(a->program, "normalize_quaternions", &a->normalize);
}

bool opencl_adam_step(OpenclAdam *adam, int step, const float learning_rate[FIELD_COUNT], int active_sh_degree,
                      GpuBuffer *box, const DeviceGaussians *gradient, DeviceGaussians *model, DeviceGaussians *m,
                      DeviceGaussians *v) {
    assert(step >= 1 && (box || !adam->only_in_view));
    assert(gradient->count == model->count && m->count == model->count && v->count == model->count);
    const size_t groups = ((size_t)model->count + ADAM_LANES - 1) / ADAM_LANES;
    if (!adam->normalize && !create_kernels(adam)) return false;
    const GpuArg box_arg = gpu_buffer_arg(box ? box : adam->not_finite); // which is not looked into
    for (int f = 0; f < FIELD_COUNT; f++) {
        if (GAUSSIAN_FIELDS[f].sh_degree > active_sh_degree || !model->field[f]) continue;
        AdamRule rule = adam_rule_default((double)learning_rate[f]);
        AdamRecord record = adam_record(adam, &rule, step);
        record.width = GAUSSIAN_FIELDS[f].width;
        record.splats = model->count;
        record.field = f;
        if (!gpu_launch(adam->adam, gpu_range(groups * (size_t)record.width, GROUP),
                        gpu_record_arg(&record, sizeof record), box_arg, gpu_buffer_arg(gradient->field[f]),
                        gpu_buffer_arg(model->field[f]), gpu_buffer_arg(m->field[f]), gpu_buffer_arg(v->field[f]),
                        gpu_buffer_arg(adam->not_finite)))
            return false;
    }
    return gpu_launch(adam->normalize, gpu_range(groups, GROUP), gpu_int_arg(model->count),
                      gpu_int_arg(adam->only_in_view), box_arg, gpu_buffer_arg(model->field[FIELD_QUAT]));
}

AdamStep opencl_adam_prepare(OpenclAdam *adam, int step, const float learning_rate[FIELD_COUNT], DeviceGaussians *m,
                             DeviceGaussians *v) {
    AdamStep s = {.m = m, .v = v, .not_finite = adam->not_finite};
    assert(step >= 1);
    for (int f = 0; f < FIELD_COUNT; f++) {
        AdamRule rule = adam_rule_default((double)learning_rate[f]);
        s.record.rule = adam_record(adam, &rule, step);
        s.record.rate[f] = s.record.rule.rate;
    }
    return s;
}

bool opencl_adam_check(OpenclAdam *adam, int *splat, GaussianFieldId *field) {
    uint32_t word;
    if (!gpu_buffer_read(adam->not_finite, &word, sizeof word)) return false;
    *splat = word == ADAM_ALL_FINITE ? -1 : (int)(word >> ADAM_FIELD_BITS);
    *field = word == ADAM_ALL_FINITE ? 0 : (GaussianFieldId)(word & ((1u << ADAM_FIELD_BITS) - 1));
    return word == ADAM_ALL_FINITE || forget_noted(adam);
}
