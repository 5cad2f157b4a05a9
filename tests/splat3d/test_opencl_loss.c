#include "splat3d/opencl_loss.h"

#include "kernels/ssim.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/base/rng.h"
#include "splat2d/loss.h"
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SEED = 20240607 };

static struct {
    Gpu *gpu;
    OpenclLoss *shape[2]; // BLEND_CPU, BLEND_GPU
    OpenclLoss *loss;     // the one under test
} at;

static int set_up(void **state) {
    (void)state;
    bool good = gpu_open("", &at.gpu) && opencl_loss_create(at.gpu, BLEND_CPU, &at.shape[0]) &&
                opencl_loss_create(at.gpu, BLEND_GPU, &at.shape[1]);
    if (!good) print_message("%s\n", fail_text());
    return good ? 0 : -1;
}

static int tear_down(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) opencl_loss_destroy(at.shape[i]);
    gpu_close(at.gpu);
    return 0;
}

// One comparison: what goes in, and what came out on the device.
typedef struct {
    ImageF picture; // (H, W, 3)
    Image8 photo;
    float background[3];
    float lambda;
    LossValues values;
    double *gradient;       // (H, W, 3)
    int dirty_padding;      // numbers of the gradient's padding that are not zero
    uint64_t gradient_hash; // of all its bits
} Case;

static Case case_create(int width, int height, int channels) {
    Case c = {.picture = imagef_create(width, height, 3),
              .photo = image8_create(width, height, channels),
              .background = {0.2f, 0.7f, 1.0f},
              .lambda = 0.2f};
    c.gradient = mem_alloc((size_t)width * (size_t)height * 3, sizeof(double));
    return c;
}

static void case_destroy(Case *c) {
    imagef_destroy(&c->picture);
    image8_destroy(&c->photo);
    mem_free(c->gradient);
}

// Noise round a slope, the picture partly outside [0, 1].
static void case_fill_noise(Case *c, uint32_t number) {
    Rng rng = rng_at(SEED, RNG_TEST, number, 0);
    int width = c->picture.width, height = c->picture.height;
    for (int i = 0; i < width * height; i++) {
        for (int k = 0; k < 3; k++)
            c->picture.values[3 * i + k] = (float)(rng_range(&rng, -0.3, 0.5) + 0.8 * (i % width) / width);
        for (int k = 0; k < c->photo.channels; k++)
            c->photo.bytes[c->photo.channels * i + k] = (uint8_t)rng_below(&rng, 256);
    }
}

// The picture with garbage in its padding, so that a kernel that reads it is found out.
static void put_planes(const Case *c, int stride, int rows, float *planes) {
    for (int i = 0; i < 3 * rows * stride; i++) planes[i] = i % 7 ? NAN : 1e30f;
    for (int k = 0; k < 3; k++)
        for (int y = 0; y < c->picture.height; y++)
            for (int x = 0; x < c->picture.width; x++)
                planes[(k * rows + y) * stride + x] = c->picture.values[(y * c->picture.width + x) * 3 + k];
}

static void take_gradient(Case *c, int stride, int rows, const float *planes) {
    int width = c->picture.width, height = c->picture.height;
    c->dirty_padding = 0;
    c->gradient_hash = 14695981039346656037u;
    for (int k = 0; k < 3; k++)
        for (int y = 0; y < rows; y++)
            for (int x = 0; x < stride; x++) {
                float value = planes[(k * rows + y) * stride + x];
                uint32_t bits;
                memcpy(&bits, &value, sizeof bits);
                c->gradient_hash = (c->gradient_hash ^ bits) * 1099511628211u;
                if (x < width && y < height)
                    c->gradient[(y * width + x) * 3 + k] = value;
                else
                    c->dirty_padding += value != 0.0f;
            }
}

static int padded(int n) { return (n + TILE_SIZE - 1) / TILE_SIZE * TILE_SIZE; }

static void case_run(Case *c) {
    int stride = padded(c->picture.width), rows = padded(c->picture.height);
    size_t bytes = sizeof(float) * 3 * (size_t)stride * (size_t)rows;
    DevicePicture p = {.width = c->picture.width, .height = c->picture.height, .stride = stride, .rows = rows};
    GpuBuffer *photo;
    void *mapped;
    assert_true(gpu_buffer_create(at.gpu, "rgb", bytes, &p.rgb) && gpu_buffer_create(at.gpu, "d_rgb", bytes, &p.d_rgb));
    assert_true(opencl_photo_create(at.gpu, &c->photo, &photo));
    assert_true(gpu_buffer_map(p.rgb, GPU_WRITE, &mapped));
    put_planes(c, stride, rows, mapped);
    assert_true(gpu_buffer_unmap(p.rgb));
    assert_true(gpu_buffer_map(p.d_rgb, GPU_WRITE, &mapped));
    put_planes(c, stride, rows, mapped);
    assert_true(gpu_buffer_unmap(p.d_rgb));
    if (!opencl_loss_run(at.loss, p, photo, c->background, c->lambda) || !opencl_loss_read(at.loss, &c->values))
        fail_msg("%s", fail_text());
    assert_true(gpu_buffer_map(p.d_rgb, GPU_READ, &mapped));
    take_gradient(c, stride, rows, mapped);
    assert_true(gpu_buffer_unmap(p.d_rgb));
    gpu_buffer_destroy(photo);
    gpu_buffer_destroy(p.rgb);
    gpu_buffer_destroy(p.d_rgb);
}

// Some times the errors that rounding was seen to make; the gradient's is relative to its largest number.
typedef struct {
    double loss, ssim, gradient;
} Tolerance;

static const Tolerance NOISY = {2e-7, 1e-6, 3e-6};
static const Tolerance FLAT = {4e-5, 2e-4, 2e-4}; // variances are zero there: their rounding is divided by C2 = 9e-4

// Runs the case on the device and holds it against the double-precision reference.
static void case_check(Case *c, const char *what, Tolerance tolerance) {
    int count = 3 * c->picture.width * c->picture.height;
    double *expected = mem_alloc((size_t)count, sizeof(double));
    ImageF photo = imagef_over(&c->photo, c->background);
    Loss reference = loss_l1_dssim(&c->picture, &photo, (double)c->lambda, expected);
    case_run(c);
    double largest = 0, worst = 0, squares = 0;
    for (int i = 0; i < count; i++) {
        double clipped = fmin(fmax((double)c->picture.values[i], 0), 1);
        squares += (clipped - (double)photo.values[i]) * (clipped - (double)photo.values[i]);
        largest = fmax(largest, fabs(expected[i]));
        worst = fmax(worst, fabs(expected[i] - c->gradient[i]));
    }
    print_message("%-28s loss %.6f (error %.1e), SSIM error %.1e, gradient error %.1e of the largest\n", what,
                  reference.total, c->values.total - reference.total, c->values.ssim - reference.ssim, worst / largest);
    support_near(c->values.l1, reference.l1, 2e-7, "L1");
    support_near(c->values.ssim, reference.ssim, tolerance.ssim, "SSIM");
    support_near(c->values.total, reference.total, tolerance.loss, "loss");
    support_near(c->values.mse, squares / count, 1e-6, "mean squared error");
    support_near(worst / largest, 0, tolerance.gradient, "largest error of the gradient");
    assert_int_equal(c->dirty_padding, 0);
    mem_free(expected);
    imagef_destroy(&photo);
}

static void noise_of_every_size_gives_the_references_loss_and_gradient(void **state) {
    (void)state;
    const int sizes[][2] = {{37, 53}, {16, 16},  {123, 82}, {5, 7},   {1, 1},
                            {64, 33}, {17, 100}, {31, 64},  {32, 65}, {1100, 90}};
    for (unsigned i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        char what[64];
        snprintf(what, sizeof what, "%d x %d", sizes[i][0], sizes[i][1]);
        Case c = case_create(sizes[i][0], sizes[i][1], 3);
        case_fill_noise(&c, i);
        case_check(&c, what, NOISY);
        case_destroy(&c);
    }
}

static void a_photo_with_alpha_is_laid_over_the_background(void **state) {
    (void)state;
    Case c = case_create(50, 41, 4);
    case_fill_noise(&c, 100);
    for (int i = 0; i < 300; i++) c.photo.bytes[4 * i + 3] = i % 2 ? 0 : 255;
    case_check(&c, "alpha", NOISY);
    case_destroy(&c);
}

static void a_grey_photo_counts_as_three_equal_channels(void **state) {
    (void)state;
    Case grey = case_create(20, 20, 1), colour = case_create(20, 20, 3);
    case_fill_noise(&grey, 101);
    memcpy(colour.picture.values, grey.picture.values, sizeof(float) * 3 * 400);
    for (int i = 0; i < 1200; i++) colour.photo.bytes[i] = grey.photo.bytes[i / 3];
    case_run(&grey);
    case_check(&colour, "grey", NOISY);
    assert_true(grey.gradient_hash == colour.gradient_hash);
    case_destroy(&grey);
    case_destroy(&colour);
}

static void flat_areas_and_faint_slopes_keep_their_gradient(void **state) {
    (void)state;
    const float level[] = {0.0f, 0.03f, 0.5f, 0.98f};
    for (int k = 0; k < 4; k++) {
        Case c = case_create(70, 45, 3);
        for (int i = 0; i < 3 * 70 * 45; i++) {
            int x = i / 3 % 70;
            c.picture.values[i] = level[k] + (x < 35 ? 0.0f : 1e-3f * (float)x / 70);
            c.photo.bytes[i] = (uint8_t)(255 * level[k] + (x < 50 ? 2 : 0));
        }
        char what[64];
        snprintf(what, sizeof what, "flat at %.2f", (double)level[k]);
        case_check(&c, what, FLAT);
        case_destroy(&c);
    }
}

static void an_identical_picture_has_loss_zero(void **state) {
    (void)state;
    Case c = case_create(47, 39, 3);
    case_fill_noise(&c, 102);
    for (int i = 0; i < 3 * 47 * 39; i++) c.picture.values[i] = (float)c.photo.bytes[i] / 255.0f;
    case_run(&c);
    support_near(c.values.l1, 0, 0, "L1");
    support_near(c.values.mse, 0, 0, "mean squared error");
    support_near(c.values.ssim, 1, 1e-6, "SSIM");
    case_destroy(&c);
}

static void lambda_0_and_1_give_l1_and_ssim_alone(void **state) {
    (void)state;
    for (int lambda = 0; lambda <= 1; lambda++) {
        Case c = case_create(40, 40, 3);
        c.lambda = (float)lambda;
        case_fill_noise(&c, 103);
        case_check(&c, lambda ? "SSIM alone" : "L1 alone", NOISY);
        case_destroy(&c);
    }
}

static void a_smaller_picture_after_a_larger_one_sees_nothing_of_it(void **state) {
    (void)state;
    Case large = case_create(150, 90, 3), small = case_create(33, 21, 3);
    case_fill_noise(&large, 104);
    case_fill_noise(&small, 105);
    case_run(&large);
    case_check(&small, "small after large", NOISY);
    case_check(&large, "large after small", NOISY);
    case_destroy(&large);
    case_destroy(&small);
}

static void two_runs_give_the_same_bits(void **state) {
    (void)state;
    Case c = case_create(200, 131, 3);
    case_fill_noise(&c, 106);
    case_run(&c);
    uint64_t hash = c.gradient_hash;
    double total = c.values.total;
    case_run(&c);
    assert_true(hash == c.gradient_hash);
    support_near(c.values.total, total, 0, "loss of the second run");
    case_destroy(&c);
}

static int cpu_shape(void **state) {
    (void)state;
    at.loss = at.shape[0];
    return 0;
}

static int gpu_shape(void **state) {
    (void)state;
    at.loss = at.shape[1];
    return 0;
}

#define BOTH_SHAPES(test)                                                                                              \
    {"CPU's kernel: " #test, test, cpu_shape, NULL, NULL}, { "GPU's kernels: " #test, test, gpu_shape, NULL, NULL }

int main(void) {
    const struct CMUnitTest tests[] = {
        BOTH_SHAPES(noise_of_every_size_gives_the_references_loss_and_gradient),
        BOTH_SHAPES(a_photo_with_alpha_is_laid_over_the_background),
        BOTH_SHAPES(a_grey_photo_counts_as_three_equal_channels),
        BOTH_SHAPES(flat_areas_and_faint_slopes_keep_their_gradient),
        BOTH_SHAPES(an_identical_picture_has_loss_zero),
        BOTH_SHAPES(lambda_0_and_1_give_l1_and_ssim_alone),
        BOTH_SHAPES(a_smaller_picture_after_a_larger_one_sees_nothing_of_it),
        BOTH_SHAPES(two_runs_give_the_same_bits),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
