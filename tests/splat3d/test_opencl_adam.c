#include "splat3d/opencl_adam.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/base/rng.h"
#include "splat2d/adam.h"
#include "tests/support/support.h"

#include <math.h>
#include <string.h>

enum { SEED = 20240611, SPLATS = 203, DEGREE = 3 };

static const float RATES[FIELD_COUNT] = {1.6e-4f, 5e-3f, 1e-3f, 5e-2f, 2.5e-3f, 1.25e-4f, 1.25e-4f, 1.25e-4f};

static struct {
    Gpu *gpu;
    OpenclAdam *adam;
    DeviceGaussians gradient, model, m, v;
} at;

static int set_up(void **state) {
    (void)state;
    bool good = gpu_open("", &at.gpu) && opencl_adam_create(at.gpu, false, &at.adam);
    if (!good) print_message("%s\n", fail_text());
    return good ? 0 : -1;
}

static int tear_down(void **state) {
    (void)state;
    opencl_adam_destroy(at.adam);
    gpu_close(at.gpu);
    return 0;
}

// Fresh arrays for each test: moments are zero.
static int make_arrays(void **state) {
    (void)state;
    bool good = device_gaussians_create(at.gpu, "gradient", SPLATS, DEGREE, &at.gradient) &&
                device_gaussians_create(at.gpu, "model", SPLATS, DEGREE, &at.model) &&
                device_gaussians_create(at.gpu, "m", SPLATS, DEGREE, &at.m) &&
                device_gaussians_create(at.gpu, "v", SPLATS, DEGREE, &at.v);
    if (!good) print_message("%s\n", fail_text());
    return good ? 0 : -1;
}

static int drop_arrays(void **state) {
    (void)state;
    device_gaussians_destroy(&at.gradient);
    device_gaussians_destroy(&at.model);
    device_gaussians_destroy(&at.m);
    device_gaussians_destroy(&at.v);
    return 0;
}

static size_t numbers(int field) { return (size_t)SPLATS * (size_t)GAUSSIAN_FIELDS[field].width; }

// Parameters of ordinary size; quaternions of unit length.
static Gaussians random_model(void) {
    Gaussians g = gaussians_create(SPLATS, DEGREE);
    for (int f = 0; f < FIELD_COUNT; f++) {
        Rng rng = rng_at(SEED, RNG_TEST, 0, (uint32_t)f);
        for (size_t i = 0; i < numbers(f); i++) g.field[f][i] = (float)rng_range(&rng, -2, 2);
    }
    for (int i = 0; i < SPLATS; i++) {
        float *q = gaussians_at(&g, FIELD_QUAT, i), squared = 0;
        for (int k = 0; k < 4; k++) squared += q[k] * q[k];
        for (int k = 0; k < 4; k++) q[k] /= sqrtf(squared);
    }
    return g;
}

// Gradients of every size that occurs: 1e-24 to 1e2, either sign, and zeros.
static Gaussians random_gradient(uint32_t number) {
    Gaussians g = gaussians_create(SPLATS, DEGREE);
    for (int f = 0; f < FIELD_COUNT; f++) {
        Rng rng = rng_at(SEED, RNG_TEST, number, (uint32_t)f);
        for (size_t i = 0; i < numbers(f); i++) {
            // One size for all steps of a number, as in training; its digits change from step to step.
            Rng of_number = rng_at(SEED, RNG_TEST, 1000 + (uint32_t)f, (uint32_t)i);
            double size = pow(10, rng_range(&of_number, -24, 2));
            g.field[f][i] = i % 11 == 3 ? 0.0f : (float)(size * rng_range(&rng, -1, 1));
        }
    }
    return g;
}

static void step_on_device(int step, int active_degree, const Gaussians *gradient) {
    if (!device_gaussians_write(&at.gradient, gradient) ||
        !opencl_adam_step(at.adam, step, RATES, active_degree, NULL, &at.gradient, &at.model, &at.m, &at.v))
        fail_msg("%s", fail_text());
}

static Gaussians read_back(const DeviceGaussians *g) {
    Gaussians host;
    if (!device_gaussians_read(g, &host)) fail_msg("%s", fail_text());
    return host;
}

static void expect_all_well(void) {
    int splat;
    GaussianFieldId field;
    assert_true(opencl_adam_check(at.adam, &splat, &field));
    assert_int_equal(splat, -1);
}

// The reference's state in double.
typedef struct {
    double *x[FIELD_COUNT], *m[FIELD_COUNT], *v[FIELD_COUNT], *g[FIELD_COUNT];
} Reference;

static Reference reference_create(const Gaussians *model) {
    Reference r;
    for (int f = 0; f < FIELD_COUNT; f++) {
        double **arrays[] = {&r.x[f], &r.m[f], &r.v[f], &r.g[f]};
        for (int k = 0; k < 4; k++) *arrays[k] = mem_alloc(numbers(f), sizeof(double));
        for (size_t i = 0; i < numbers(f); i++) r.x[f][i] = (double)model->field[f][i];
    }
    return r;
}

static void reference_destroy(Reference *r) {
    for (int f = 0; f < FIELD_COUNT; f++) {
        mem_free(r->x[f]);
        mem_free(r->m[f]);
        mem_free(r->v[f]);
        mem_free(r->g[f]);
    }
}

static void reference_step(Reference *r, int step, int active_degree, const Gaussians *gradient) {
    for (int f = 0; f < FIELD_COUNT; f++) {
        if (GAUSSIAN_FIELDS[f].sh_degree > active_degree) continue;
        AdamRule rule = adam_rule_default((double)RATES[f]);
        for (size_t i = 0; i < numbers(f); i++) r->g[f][i] = (double)gradient->field[f][i];
        adam_step(&rule, step, (int)numbers(f), r->g[f], r->x[f], r->m[f], r->v[f]);
    }
    for (int i = 0; i < SPLATS; i++) {
        double *q = r->x[FIELD_QUAT] + 4 * (size_t)i;
        double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
        for (int k = 0; k < 4; k++) q[k] /= length;
    }
}

// Every number may be off by the rounding of the additions (numbers stand below 4) and by 1e-5 of the way it has gone.
static void compare_model(const Reference *r, int steps) {
    Gaussians model = read_back(&at.model);
    double worst = 0;
    for (int f = 0; f < FIELD_COUNT; f++)
        for (size_t i = 0; i < numbers(f); i++) {
            double error = fabs((double)model.field[f][i] - r->x[f][i]);
            double allowed = steps * (3e-7 + 1e-5 * (double)RATES[f]);
            worst = fmax(worst, error / allowed);
        }
    print_message("%d steps: largest error %.2f of what is allowed\n", steps, worst);
    assert_true(worst <= 1);
    gaussians_destroy(&model);
}

static void many_steps_follow_the_reference_for_gradients_of_every_size(void **state) {
    (void)state;
    enum { STEPS = 12 };
    Gaussians model = random_model();
    Reference reference = reference_create(&model);
    assert_true(device_gaussians_write(&at.model, &model));
    for (int step = 1; step <= STEPS; step++) {
        Gaussians gradient = random_gradient((uint32_t)step);
        step_on_device(step, DEGREE, &gradient);
        reference_step(&reference, step, DEGREE, &gradient);
        gaussians_destroy(&gradient);
        if (step == 1) compare_model(&reference, step);
    }
    compare_model(&reference, STEPS);
    expect_all_well();
    reference_destroy(&reference);
    gaussians_destroy(&model);
}

// In the first step every number moves by its learning rate, however small its gradient, until epsilon takes over.
static void the_first_step_of_a_tiny_gradient_is_the_learning_rate(void **state) {
    (void)state;
    const double size[] = {1e-15, 1e-13, 1e-10, 1e-5, 1.0, 1e5};
    for (int k = 0; k < 6; k++) {
        drop_arrays(NULL);
        assert_int_equal(make_arrays(NULL), 0);
        Gaussians gradient = gaussians_create(SPLATS, DEGREE);
        for (size_t i = 0; i < numbers(FIELD_OPACITY_LOGIT); i++)
            gradient.field[FIELD_OPACITY_LOGIT][i] = (float)size[k];
        step_on_device(1, DEGREE, &gradient);
        Gaussians after = read_back(&at.model);
        double expected = -(double)RATES[FIELD_OPACITY_LOGIT] * size[k] / (size[k] + 1e-15);
        for (int i = 0; i < SPLATS; i++)
            support_near((double)after.field[FIELD_OPACITY_LOGIT][i], expected, 1e-6 * fabs(expected), "first step");
        gaussians_destroy(&gradient);
        gaussians_destroy(&after);
    }
}

static void degrees_that_are_not_active_keep_their_numbers_and_moments(void **state) {
    (void)state;
    Gaussians model = random_model(), gradient = random_gradient(1);
    assert_true(device_gaussians_write(&at.model, &model));
    step_on_device(1, 1, &gradient);
    Gaussians after = read_back(&at.model), m = read_back(&at.m);
    for (int f = FIELD_SH2; f <= FIELD_SH3; f++) {
        assert_memory_equal(after.field[f], model.field[f], numbers(f) * sizeof(float));
        for (size_t i = 0; i < numbers(f); i++) assert_true(m.field[f][i] == 0.0f);
    }
    assert_memory_not_equal(after.field[FIELD_SH1], model.field[FIELD_SH1], numbers(FIELD_SH1) * sizeof(float));
    gaussians_destroy(&model);
    gaussians_destroy(&gradient);
    gaussians_destroy(&after);
    gaussians_destroy(&m);
}

static void quaternions_are_unit_after_a_step_and_zero_stays_zero(void **state) {
    (void)state;
    Gaussians model = random_model(), gradient = random_gradient(1);
    for (int k = 0; k < 4; k++) gaussians_at(&model, FIELD_QUAT, 9)[k] = gaussians_at(&gradient, FIELD_QUAT, 9)[k] = 0;
    for (int k = 0; k < 4; k++) gaussians_at(&model, FIELD_QUAT, 10)[k] *= 1e3f;
    assert_true(device_gaussians_write(&at.model, &model));
    step_on_device(1, DEGREE, &gradient);
    Gaussians after = read_back(&at.model);
    for (int i = 0; i < SPLATS; i++) {
        double squared = 0;
        for (int k = 0; k < 4; k++) squared += pow((double)gaussians_at(&after, FIELD_QUAT, i)[k], 2);
        support_near(sqrt(squared), i == 9 ? 0 : 1, 3e-7, "length of a quaternion");
    }
    gaussians_destroy(&model);
    gaussians_destroy(&gradient);
    gaussians_destroy(&after);
}

// One bad number at a time, in the vector part of a field (splat 40) and in its last, incomplete vector (splat 202).
static void a_number_that_is_not_finite_is_left_alone_and_its_splat_is_named(void **state) {
    (void)state;
    const float bad[] = {NAN, INFINITY, -INFINITY, 1e30f}; // the last overflows only when it is squared
    const int places[] = {40, SPLATS - 1};
    Gaussians model = random_model();
    for (int f = 0; f < FIELD_COUNT; f++)
        for (int k = 0; k < 8; k++) {
            int splat = places[k / 4], named;
            GaussianFieldId field;
            Gaussians gradient = random_gradient(1);
            float *number = gaussians_at(&gradient, (GaussianFieldId)f, splat) + GAUSSIAN_FIELDS[f].width - 1;
            *number = bad[k % 4];
            size_t index = (size_t)(number - gradient.field[f]);
            assert_true(device_gaussians_write(&at.model, &model));
            step_on_device(1, DEGREE, &gradient);
            assert_true(opencl_adam_check(at.adam, &named, &field));
            assert_int_equal(named, splat);
            assert_int_equal(field, f);
            Gaussians after = read_back(&at.model), m = read_back(&at.m), v = read_back(&at.v);
            if (f != FIELD_QUAT) assert_true(after.field[f][index] == model.field[f][index]);
            assert_true(isfinite(m.field[f][index]) && isfinite(v.field[f][index]));
            assert_true(gaussians_are_finite(&after, &named, &field));
            gaussians_destroy(&gradient);
            gaussians_destroy(&after);
            gaussians_destroy(&m);
            gaussians_destroy(&v);
        }
    expect_all_well(); // asking has cleared the note
    gaussians_destroy(&model);
}

static void of_many_bad_numbers_the_lowest_splat_and_its_first_field_are_named(void **state) {
    (void)state;
    Gaussians model = random_model(), gradient = random_gradient(1);
    gaussians_at(&gradient, FIELD_MEAN, 150)[0] = NAN;
    gaussians_at(&gradient, FIELD_SH3, 77)[20] = NAN;
    gaussians_at(&gradient, FIELD_LOG_SCALE, 77)[1] = NAN;
    gaussians_at(&gradient, FIELD_SH0, 78)[1] = NAN;
    assert_true(device_gaussians_write(&at.model, &model));
    step_on_device(1, DEGREE, &gradient);
    int splat;
    GaussianFieldId field;
    assert_true(opencl_adam_check(at.adam, &splat, &field));
    assert_int_equal(splat, 77);
    assert_int_equal(field, FIELD_LOG_SCALE);
    gaussians_destroy(&model);
    gaussians_destroy(&gradient);
}

// Every third splat is out of view, and all of two groups of sixteen.
static bool is_seen(int i) { return i % 3 != 1 && !(i >= 64 && i < 96); }

static GpuBuffer *boxes_of_seen(void) {
    GpuBuffer *buffer;
    TileBox *box = mem_alloc(SPLATS, sizeof *box);
    for (int i = 0; i < SPLATS; i++)
        if (is_seen(i)) box[i] = (TileBox){i % 5, i % 7, i % 5 + 1 + i % 2, i % 7 + 1};
    const size_t bytes = SPLATS * sizeof *box;
    if (!gpu_buffer_create(at.gpu, "boxes", bytes, &buffer) || !gpu_buffer_write(buffer, box, bytes))
        fail_msg("%s", fail_text());
    mem_free(box);
    return buffer;
}

static void splats_out_of_view_keep_all_their_bits_when_only_those_in_view_are_stepped(void **state) {
    (void)state;
    OpenclAdam *sparse;
    GpuBuffer *box = boxes_of_seen();
    Gaussians model = random_model(), before[3], all[3], seen[3];
    DeviceGaussians *arrays[3] = {&at.model, &at.m, &at.v};
    assert_true(opencl_adam_create(at.gpu, true, &sparse) && device_gaussians_write(&at.model, &model));
    for (int step = 1; step <= 3; step++) { // moments, and the same once more from where it was
        Gaussians gradient = random_gradient((uint32_t)step);
        if (step == 3)
            for (int k = 0; k < 3; k++) before[k] = read_back(arrays[k]);
        step_on_device(step, DEGREE, &gradient);
        gaussians_destroy(&gradient);
    }
    for (int k = 0; k < 3; k++) {
        all[k] = read_back(arrays[k]);
        assert_true(device_gaussians_write(arrays[k], &before[k]));
    }
    assert_true(opencl_adam_step(sparse, 3, RATES, DEGREE, box, &at.gradient, &at.model, &at.m, &at.v));
    for (int k = 0; k < 3; k++) {
        seen[k] = read_back(arrays[k]);
        for (GaussianFieldId f = 0; f < FIELD_COUNT; f++)
            for (int i = 0; i < SPLATS; i++)
                assert_memory_equal(gaussians_at(&seen[k], f, i), gaussians_at(is_seen(i) ? &all[k] : &before[k], f, i),
                                    (size_t)GAUSSIAN_FIELDS[f].width * sizeof(float));
    }
    for (int k = 0; k < 3; k++) {
        gaussians_destroy(&before[k]);
        gaussians_destroy(&all[k]);
        gaussians_destroy(&seen[k]);
    }
    gaussians_destroy(&model);
    gpu_buffer_destroy(box);
    opencl_adam_destroy(sparse);
}

static void a_step_without_splats_does_nothing(void **state) {
    (void)state;
    assert_true(device_gaussians_resize(&at.gradient, 0) && device_gaussians_resize(&at.model, 0) &&
                device_gaussians_resize(&at.m, 0) && device_gaussians_resize(&at.v, 0));
    assert_true(opencl_adam_step(at.adam, 1, RATES, DEGREE, NULL, &at.gradient, &at.model, &at.m, &at.v));
    expect_all_well();
}

#define ADAM_TEST(name) cmocka_unit_test_setup_teardown(name, make_arrays, drop_arrays)

int main(void) {
    const struct CMUnitTest tests[] = {
        ADAM_TEST(many_steps_follow_the_reference_for_gradients_of_every_size),
        ADAM_TEST(the_first_step_of_a_tiny_gradient_is_the_learning_rate),
        ADAM_TEST(degrees_that_are_not_active_keep_their_numbers_and_moments),
        ADAM_TEST(quaternions_are_unit_after_a_step_and_zero_stays_zero),
        ADAM_TEST(a_number_that_is_not_finite_is_left_alone_and_its_splat_is_named),
        ADAM_TEST(of_many_bad_numbers_the_lowest_splat_and_its_first_field_are_named),
        ADAM_TEST(splats_out_of_view_keep_all_their_bits_when_only_those_in_view_are_stepped),
        ADAM_TEST(a_step_without_splats_does_nothing),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
