// The trainer on a scene made in memory: three small pictures of known splats.

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/base/rng.h"
#include "splat2d/adam.h"
#include "splat2d/loss.h"
#include "splat3d/first_splats.h"
#include "splat3d/reference.h"
#include "splat3d/schedule.h"
#include "splat3d/trainer.h"
#include "tests/support/support.h"

#include <dlfcn.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { VIEWS = 3, WIDTH = 45, HEIGHT = 34, TRUTH = 40, POINTS = 25 };

static Gpu *gpu;

static void check(bool done) {
    if (!done) fail_msg("%s", fail_text());
}

static int open_device(void **state) {
    (void)state;
    if (!gpu_open("auto", &gpu)) print_error("%s\n", fail_text());
    return gpu ? 0 : -1;
}

static int close_device(void **state) {
    (void)state;
    gpu_close(gpu);
    return 0;
}

// Coloured splats in a box round the origin.
static Gaussians truth_splats(void) {
    Gaussians g = gaussians_create(TRUTH, 1);
    for (int i = 0; i < TRUTH; i++) {
        Rng rng = rng_at(11, RNG_TEST, (uint32_t)i, 0);
        for (int a = 0; a < 3; a++) {
            gaussians_at(&g, FIELD_MEAN, i)[a] = (float)rng_range(&rng, -1, 1);
            gaussians_at(&g, FIELD_LOG_SCALE, i)[a] = (float)rng_range(&rng, log(0.1), log(0.4));
            gaussians_at(&g, FIELD_SH0, i)[a] = (float)rng_range(&rng, -1.5, 1.5);
        }
        for (int a = 0; a < 4; a++) gaussians_at(&g, FIELD_QUAT, i)[a] = (float)rng_normal(&rng);
        *gaussians_at(&g, FIELD_OPACITY_LOGIT, i) = (float)rng_range(&rng, 0, 3);
    }
    return g;
}

// A data set whose photographs the reference took of the true splats.
static Dataset make_dataset(void) {
    Dataset d = {
        .path = mem_text("memory"), .kind = "made in memory", .downscale = 1, .view_count = VIEWS, .extent = 3};
    d.views = mem_alloc(VIEWS, sizeof *d.views);
    Gaussians truth = truth_splats();
    Rasterizer *reference = reference_rasterizer_create();
    RenderSettings settings = render_settings_default();
    for (int v = 0; v < VIEWS; v++) {
        View *view = &d.views[v];
        Vec3 eye = vec3(4 * cos(2.0 * v), 0.5, 4 * sin(2.0 * v));
        *view = (View){.name = mem_format("view_%d", v), .path = mem_format("memory/view_%d", v), .channels = 3};
        view->camera = camera_look_at(eye, vec3(0, 0, 0), vec3(0, 1, 0), 0.9, WIDTH, HEIGHT);
        Picture picture;
        check(rasterizer_render(reference, &truth, &view->camera, &settings, &picture));
        view->image = image8_from_float(&picture.rgb);
        picture_destroy(&picture);
    }
    d.points = points_create(POINTS);
    for (int i = 0; i < POINTS; i++)
        for (int a = 0; a < 3; a++) {
            d.points.xyz[3 * i + a] = gaussians_at(&truth, FIELD_MEAN, i)[a] + 0.05;
            d.points.rgb[3 * i + a] = (uint8_t)(40 * a + 5 * i);
        }
    rasterizer_destroy(reference);
    gaussians_destroy(&truth);
    return d;
}

static TrainOptions small_options(int iterations) {
    TrainOptions o = train_options_default();
    o.iterations = iterations;
    o.seed = 3;
    o.sh_degree = 1;
    o.sh_every = 4; // the second degree comes into play within the trace
    return o;
}

// ---- the trace: the same ten steps, by the double-precision reference ----

typedef struct {
    TrainOptions options;
    Dataset dataset;
    ImageF photos[VIEWS];
    GaussiansD model, m, v;
    int order[VIEWS], epoch;
} ReferenceTrainer;

static double reference_step(ReferenceTrainer *t, int step) {
    const Camera *camera;
    int view = schedule_view(&t->options, step, VIEWS, t->order, &t->epoch);
    RenderSettings settings = render_settings_default();
    settings.sh_degree = schedule_sh_degree(&t->options, step);
    camera = &t->dataset.views[view].camera;
    PictureD picture;
    reference_render_forward(&t->model, camera, &settings, &picture);
    ImageF rounded = imagef_create(WIDTH, HEIGHT, 3);
    for (int i = 0; i < WIDTH * HEIGHT * 3; i++) rounded.values[i] = (float)picture.rgb[i];
    double *d_rgb = mem_alloc(WIDTH * HEIGHT * 3, sizeof *d_rgb);
    Loss loss = loss_l1_dssim(&rounded, &t->photos[view], t->options.dssim_weight, d_rgb);
    GaussiansD d_model;
    reference_render_backward(&t->model, camera, &settings, d_rgb, &d_model);
    float rate[FIELD_COUNT];
    schedule_learning_rates(&t->options, step, t->dataset.extent, rate);
    for (GaussianFieldId f = 0; f < FIELD_COUNT; f++) {
        if (!t->model.field[f] || GAUSSIAN_FIELDS[f].sh_degree > settings.sh_degree) continue;
        AdamRule rule = adam_rule_default(rate[f]);
        adam_step(&rule, step, t->model.count * GAUSSIAN_FIELDS[f].width, d_model.field[f], t->model.field[f],
                  t->m.field[f], t->v.field[f]);
    }
    for (int i = 0; i < t->model.count; i++) {
        double *q = t->model.field[FIELD_QUAT] + 4 * i;
        double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
        for (int a = 0; a < 4; a++) q[a] /= length;
    }
    gaussiansd_destroy(&d_model);
    pictured_destroy(&picture);
    imagef_destroy(&rounded);
    mem_free(d_rgb);
    return loss.total;
}

static void ten_steps_lose_what_the_reference_loses(void **state) {
    (void)state;
    enum { STEPS = 10 };
    TrainOptions o = small_options(STEPS);
    o.densify_until = 0;
    Dataset d = make_dataset();
    ReferenceTrainer r = {.options = o, .dataset = make_dataset(), .epoch = -1};
    for (int v = 0; v < VIEWS; v++) r.photos[v] = imagef_from_8(&r.dataset.views[v].image);
    Gaussians first = first_splats_from_points(&r.dataset.points, o.sh_degree, o.init_opacity);
    r.model = gaussiansd_from(&first);
    r.m = gaussiansd_create(first.count, first.sh_degree);
    r.v = gaussiansd_create(first.count, first.sh_degree);
    Trainer *trainer;
    check(trainer_create(gpu, BLEND_AUTO, &o, &d, &trainer));
    double first_epoch = 0, third_epoch = 0; // both see every view once
    for (int step = 1; step <= STEPS; step++) {
        StepReport report;
        double expected = reference_step(&r, step);
        check(trainer_step(trainer, &report));
        support_near(report.loss.total, expected, 2e-5 * expected, "loss");
        if (step <= VIEWS) first_epoch += expected;
        if (step > 2 * VIEWS && step <= 3 * VIEWS) third_epoch += expected;
    }
    assert_true(third_epoch < 0.97 * first_epoch);
    trainer_destroy(trainer);
    for (int v = 0; v < VIEWS; v++) imagef_destroy(&r.photos[v]);
    gaussiansd_destroy(&r.model);
    gaussiansd_destroy(&r.m);
    gaussiansd_destroy(&r.v);
    gaussians_destroy(&first);
    dataset_destroy(&r.dataset);
    dataset_destroy(&d);
}

// ---- determinism ----

// Density control every 5 steps from the 11th on, resets every 20: all that changes the model happens within 60 steps.
static TrainOptions busy_options(void) {
    TrainOptions o = small_options(60);
    o.densify_from = 10, o.densify_every = 5, o.densify_until = 0.9, o.reset_every = 20, o.densify_gradient = 5e-5;
    strcpy(o.background, "random");
    o.coarse_levels = 1, o.coarse_until = 0.3, o.coarse_least = 16; // full size from step 19 on
    return o;
}

static TrainingState train_steps(const TrainOptions *o, const TrainingState *from, int until) {
    Dataset d = make_dataset();
    Trainer *trainer;
    TrainingState state;
    check(trainer_create(gpu, BLEND_AUTO, o, &d, &trainer));
    if (from) check(trainer_set_state(trainer, from));
    while (trainer_steps_done(trainer) < until) {
        StepReport report;
        check(trainer_step(trainer, &report));
    }
    check(trainer_get_state(trainer, &state));
    trainer_destroy(trainer);
    dataset_destroy(&d);
    return state;
}

static void assert_same_model(const TrainingState *a, const TrainingState *b) {
    assert_int_equal(a->model.count, b->model.count);
    for (GaussianFieldId f = 0; f < FIELD_COUNT; f++)
        if (a->model.field[f]) {
            size_t bytes = (size_t)a->model.count * (size_t)GAUSSIAN_FIELDS[f].width * sizeof(float);
            assert_memory_equal(a->model.field[f], b->model.field[f], bytes);
            assert_memory_equal(a->v.field[f], b->v.field[f], bytes);
        }
    assert_memory_equal(a->id, b->id, (size_t)a->model.count * sizeof *a->id);
}

static void the_same_seed_gives_the_same_bytes_and_another_does_not(void **state) {
    (void)state;
    TrainOptions o = busy_options();
    TrainingState a = train_steps(&o, NULL, 60), b = train_steps(&o, NULL, 60);
    assert_true(a.next_id > POINTS); // density control has grown something
    assert_same_model(&a, &b);
    o.seed++;
    TrainingState c = train_steps(&o, NULL, 60);
    assert_true(a.model.count != c.model.count ||
                memcmp(a.model.field[0], c.model.field[0], (size_t)a.model.count * 12) != 0);
    training_state_destroy(&a);
    training_state_destroy(&b);
    training_state_destroy(&c);
}

static void an_interrupted_run_ends_with_the_bytes_of_an_uninterrupted_one(void **state) {
    (void)state;
    TrainOptions o = busy_options();
    o.sparse_adam = true;
    TrainingState whole = train_steps(&o, NULL, 60);
    const int stops[] = {1, 15, 17, 20,
                         59}; // at the start, coarse, at and between density control, at a reset, at the end
    for (size_t i = 0; i < sizeof stops / sizeof stops[0]; i++) {
        const char *path = support_path(support_scratch(), "checkpoint.bin");
        TrainingState half = train_steps(&o, NULL, stops[i]), loaded;
        check(training_state_save(&half, path) && training_state_load(path, &loaded));
        TrainingState resumed = train_steps(&o, &loaded, 60);
        assert_same_model(&resumed, &whole);
        training_state_destroy(&half);
        training_state_destroy(&loaded);
        training_state_destroy(&resumed);
    }
    training_state_destroy(&whole);
}

// Every third splat is moved out of sight, with the moments that it has.
static void sparse_adam_steps_the_splats_in_view_alone(void **state) {
    (void)state;
    TrainOptions o = small_options(12);
    o.densify_until = 0;
    for (int sparse = 0; sparse < 2; sparse++) {
        o.sparse_adam = sparse;
        TrainingState before = train_steps(&o, NULL, 11);
        for (int i = 0; i < before.model.count; i += 3) gaussians_at(&before.model, FIELD_MEAN, i)[0] += 1000;
        TrainingState after = train_steps(&o, &before, 12);
        for (int i = 0; i < after.model.count; i++) {
            const bool stayed = memcmp(gaussians_at(&before.model, FIELD_SH0, i),
                                       gaussians_at(&after.model, FIELD_SH0, i), 3 * sizeof(float)) == 0;
            assert_int_equal(stayed, sparse && i % 3 == 0);
        }
        training_state_destroy(&before);
        training_state_destroy(&after);
    }
}

// ---- coarse to fine ----

// What a trainer does in a step with pictures of 1/4 is what another does whose photographs are so small.
static void a_coarse_step_is_a_step_on_smaller_photographs(void **state) {
    (void)state;
    TrainOptions o = small_options(9);
    o.densify_until = 0;
    Dataset small = make_dataset(), d = make_dataset();
    for (int v = 0; v < VIEWS; v++) {
        View *view = &small.views[v];
        Image8 half = image8_downscale(&view->image, 2), quarter = image8_downscale(&half, 2);
        image8_destroy(&half);
        image8_destroy(&view->image);
        view->image = quarter;
        view->camera = camera_shrunk(&view->camera, 4);
    }
    Trainer *expected, *actual;
    check(trainer_create(gpu, BLEND_AUTO, &o, &small, &expected));
    o.coarse_levels = 2, o.coarse_until = 2 / 3.0, o.coarse_least = 8;
    check(trainer_create(gpu, BLEND_AUTO, &o, &d, &actual));
    static const int shrinks[] = {4, 4, 4, 2, 2, 2, 1, 1, 1};
    for (int step = 1; step <= 9; step++) {
        StepReport a, e;
        check(trainer_step(actual, &a) && trainer_step(expected, &e));
        assert_int_equal(a.shrink, shrinks[step - 1]);
        assert_int_equal(e.shrink, 1);
        assert_true((a.loss.total == e.loss.total) == (step <= 3));
    }
    trainer_destroy(actual);
    trainer_destroy(expected);
    dataset_destroy(&small);
    dataset_destroy(&d);
}

static void no_picture_is_halved_below_the_least_side(void **state) {
    (void)state;
    TrainOptions o = small_options(10);
    o.coarse_levels = 4, o.coarse_until = 1;
    const int least[] = {8, 9, 17, 18, 34, 35}, shrinks[] = {4, 2, 2, 1, 1, 1}; // of 45 x 34 px
    for (size_t i = 0; i < sizeof least / sizeof least[0]; i++) {
        o.coarse_least = least[i];
        Dataset d = make_dataset();
        Trainer *trainer;
        StepReport report;
        check(trainer_create(gpu, BLEND_AUTO, &o, &d, &trainer));
        check(trainer_step(trainer, &report));
        assert_int_equal(report.shrink, shrinks[i]);
        trainer_destroy(trainer);
        dataset_destroy(&d);
    }
}

// ---- what a step costs besides its work ----

// The two functions below stand before those of the libraries, for the whole program; calls from its own code are counted.
static int allocations;

static bool is_own_code(void *address) {
    Dl_info caller, own;
    return dladdr(address, &caller) && dladdr(&allocations, &own) && caller.dli_fbase == own.dli_fbase;
}

void *aligned_alloc(size_t alignment, size_t bytes) { // behind mem_alloc()
    static void *(*real)(size_t, size_t);
    if (!real) real = (void *(*)(size_t, size_t))dlsym(RTLD_NEXT, "aligned_alloc");
    allocations += is_own_code(__builtin_return_address(0));
    return real(alignment, bytes);
}

void *clCreateBuffer(void *context, uint64_t flags, size_t bytes, void *host, int32_t *code); // as CL/cl.h has it
void *clCreateBuffer(void *context, uint64_t flags, size_t bytes, void *host, int32_t *code) {
    static void *(*real)(void *, uint64_t, size_t, void *, int32_t *);
    if (!real) real = (void *(*)(void *, uint64_t, size_t, void *, int32_t *))dlsym(RTLD_NEXT, "clCreateBuffer");
    allocations++;
    return real(context, flags, bytes, host, code);
}

static void a_warm_step_allocates_nothing(void **state) {
    (void)state;
    enum { WARM = 10 * VIEWS, STEPS = 10 * VIEWS };
    TrainOptions o = small_options(WARM + STEPS + 1);
    o.densify_from = WARM + STEPS, o.densify_until = 1; // its statistics are gathered, as in a real run
    Dataset d = make_dataset();
    Trainer *trainer;
    StepReport report;
    allocations = 0;
    check(trainer_create(gpu, BLEND_AUTO, &o, &d, &trainer));
    assert_true(allocations > 40); // they are noticed: a buffer for each field of four sets, arrays on the host
    for (int step = 1; step <= WARM; step++) check(trainer_step(trainer, &report));
    allocations = 0;
    for (int step = 1; step <= STEPS; step++) check(trainer_step(trainer, &report));
    assert_int_equal(allocations, 0);
    trainer_destroy(trainer);
    dataset_destroy(&d);
}

// ---- what goes wrong is named ----

static void a_number_that_is_not_finite_stops_training_by_name(void **state) {
    (void)state;
    TrainOptions o = small_options(10);
    Dataset d = make_dataset();
    Trainer *trainer;
    check(trainer_create(gpu, BLEND_AUTO, &o, &d, &trainer));
    TrainingState s;
    check(trainer_get_state(trainer, &s));
    gaussians_at(&s.model, FIELD_SH0, 7)[1] = NAN;
    check(trainer_set_state(trainer, &s));
    StepReport report;
    assert_false(trainer_step(trainer, &report));
    assert_non_null(strstr(fail_text(), "step 1, view view_"));
    assert_non_null(strstr(fail_text(), "has a gradient or parameter '"));
    training_state_destroy(&s);

    // What the damage would have spread to has kept its numbers.
    int splat;
    GaussianFieldId field;
    check(trainer_get_state(trainer, &s));
    assert_false(gaussians_are_finite(&s.model, &splat, &field));
    assert_int_equal(splat, 7);
    gaussians_at(&s.model, FIELD_SH0, 7)[1] = 0;
    assert_true(gaussians_are_finite(&s.model, &splat, &field));
    assert_true(gaussians_are_finite(&s.m, &splat, &field) && gaussians_are_finite(&s.v, &splat, &field));
    training_state_destroy(&s);
    trainer_destroy(trainer);
    dataset_destroy(&d);
}

static void a_state_of_another_scene_is_refused(void **state) {
    (void)state;
    TrainOptions o = small_options(10);
    Dataset d = make_dataset(), other = make_dataset();
    other.views[1].camera.fx += 1;
    Trainer *trainer;
    TrainingState s;
    check(trainer_create(gpu, BLEND_AUTO, &o, &d, &trainer));
    check(trainer_get_state(trainer, &s));
    trainer_destroy(trainer);
    check(trainer_create(gpu, BLEND_AUTO, &o, &other, &trainer));
    assert_false(trainer_set_state(trainer, &s));
    assert_non_null(strstr(fail_text(), "memory is no longer what the state was trained on"));
    training_state_destroy(&s);
    trainer_destroy(trainer);
    dataset_destroy(&d);
    dataset_destroy(&other);
}

static void density_control_that_would_leave_nothing_stops_with_the_model_it_had(void **state) {
    (void)state;
    TrainOptions o = small_options(10);
    o.densify_from = 0, o.densify_every = 2, o.prune_opacity = 1;
    Dataset d = make_dataset();
    Trainer *trainer;
    StepReport report;
    TrainingState kept;
    check(trainer_create(gpu, BLEND_AUTO, &o, &d, &trainer));
    check(trainer_step(trainer, &report));
    assert_false(trainer_step(trainer, &report));
    assert_non_null(strstr(fail_text(), "step 2: density control would remove every splat"));
    check(trainer_get_state(trainer, &kept));
    assert_int_equal(kept.model.count, POINTS);
    assert_int_equal(trainer_splat_count(trainer), POINTS);
    training_state_destroy(&kept);
    trainer_destroy(trainer);
    dataset_destroy(&d);
}

// Children are drawn from parents of a size near the largest float: some means overflow.
static void density_control_that_would_make_a_splat_that_is_not_finite_stops_by_name(void **state) {
    (void)state;
    TrainOptions o = small_options(10);
    o.densify_from = 0, o.densify_every = 2;
    Dataset d = make_dataset();
    Trainer *trainer;
    StepReport report;
    TrainingState huge, kept;
    check(trainer_create(gpu, BLEND_AUTO, &o, &d, &trainer));
    check(trainer_step(trainer, &report));
    check(trainer_get_state(trainer, &huge));
    for (int i = 0; i < 20; i++) {
        for (int a = 0; a < 3; a++) gaussians_at(&huge.model, FIELD_LOG_SCALE, i)[a] = 88.5f;
        huge.gradient_sum[i] = 1, huge.seen[i] = 1;
    }
    check(trainer_set_state(trainer, &huge));
    assert_false(trainer_step(trainer, &report));
    assert_non_null(strstr(fail_text(), "step 2: density control would make a splat whose 'mean' is not finite"));
    check(trainer_get_state(trainer, &kept));
    assert_int_equal(kept.model.count, POINTS);
    training_state_destroy(&huge);
    training_state_destroy(&kept);
    trainer_destroy(trainer);
    dataset_destroy(&d);
}

static void a_warm_step_allocates_builds_and_copies_nothing(void **state) {
    (void)state;
    enum { WARM_UP = 12, STEPS = 6, NOTE_BYTES = 4 }; // Adam's word of what was not finite
    Dataset dataset = make_dataset();
    TrainOptions options = small_options(WARM_UP + STEPS);
    Trainer *trainer;
    StepReport report;
    check(trainer_create(gpu, BLEND_AUTO, &options, &dataset, &trainer));
    for (int i = 0; i < WARM_UP; i++) check(trainer_step(trainer, &report));
    const GpuCounts before = gpu_counts(gpu);
    for (int i = 0; i < STEPS; i++) check(trainer_step(trainer, &report));
    const GpuCounts after = gpu_counts(gpu);
    print_message("a step: %ld launches, %ld waits\n", (after.launches - before.launches) / STEPS,
                  (after.waits - before.waits) / STEPS);
    assert_true(before.allocations > 0 && before.builds > 0);
    assert_int_equal(after.allocations, before.allocations);
    assert_int_equal(after.builds, before.builds);
    assert_int_equal(after.copied_bytes - before.copied_bytes, STEPS * NOTE_BYTES);
    // A GPU takes the loss and the step in parts, one for each field.
    assert_true(after.launches - before.launches <= (gpu_info(gpu)->is_cpu ? 10 : 20) * STEPS);
    assert_true(after.waits - before.waits <= 4 * STEPS);
    trainer_destroy(trainer);
    dataset_destroy(&dataset);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ten_steps_lose_what_the_reference_loses),
        cmocka_unit_test(the_same_seed_gives_the_same_bytes_and_another_does_not),
        cmocka_unit_test(sparse_adam_steps_the_splats_in_view_alone),
        cmocka_unit_test(an_interrupted_run_ends_with_the_bytes_of_an_uninterrupted_one),
        cmocka_unit_test(a_coarse_step_is_a_step_on_smaller_photographs),
        cmocka_unit_test(no_picture_is_halved_below_the_least_side),
        cmocka_unit_test(a_warm_step_allocates_nothing),
        cmocka_unit_test(a_number_that_is_not_finite_stops_training_by_name),
        cmocka_unit_test(a_state_of_another_scene_is_refused),
        cmocka_unit_test(a_warm_step_allocates_builds_and_copies_nothing),
        cmocka_unit_test(density_control_that_would_leave_nothing_stops_with_the_model_it_had),
        cmocka_unit_test(density_control_that_would_make_a_splat_that_is_not_finite_stops_by_name),
    };
    return cmocka_run_group_tests_name("trainer", tests, open_device, close_device);
}
