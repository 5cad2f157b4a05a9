#include "lab/base/mem.h"
#include "splat3d/bench_scene.h"
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>

enum { COUNT = 4000, WIDTH = 640, HEIGHT = 480 };

static int compare_numbers(const void *left, const void *right) {
    const double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

// Standard deviation along the screen of axis k of splat i, px.
static double sigma_px(const Gaussians *g, const Camera *camera, int i, int k) {
    return exp((double)gaussians_at(g, FIELD_LOG_SCALE, i)[k]) * camera->fx / (double)gaussians_at(g, FIELD_MEAN, i)[2];
}

static void sizes_and_places_on_the_screen_are_those_of_the_standard_scene(void **state) {
    (void)state;
    const Camera camera = bench_scene_camera(WIDTH, HEIGHT);
    Gaussians g = bench_scene_gaussians(1, COUNT, &camera);
    double *longer = mem_alloc(COUNT, sizeof *longer), *ln_ratio = mem_alloc(COUNT, sizeof *ln_ratio);
    double sum_x = 0, sum_y = 0;
    for (int i = 0; i < COUNT; i++) {
        const float *m = gaussians_at(&g, FIELD_MEAN, i);
        double x, y, depth;
        assert_true(camera_project(&camera, vec3((double)m[0], (double)m[1], (double)m[2]), &x, &y, &depth));
        assert_true(x >= -0.01 && x <= WIDTH + 0.01 && y >= -0.01 && y <= HEIGHT + 0.01);
        sum_x += x / COUNT, sum_y += y / COUNT;
        longer[i] = sigma_px(&g, &camera, i, 0);
        ln_ratio[i] = log(sigma_px(&g, &camera, i, 1) / longer[i]);
        assert_true(longer[i] < 50.01 && ln_ratio[i] < 1e-4);
    }
    qsort(longer, COUNT, sizeof *longer, compare_numbers);
    qsort(ln_ratio, COUNT, sizeof *ln_ratio, compare_numbers);
    support_near(sum_x, WIDTH / 2.0, 10, "mean x, px");
    support_near(sum_y, HEIGHT / 2.0, 8, "mean y, px");
    support_near(log(longer[COUNT / 2]), log(3), 0.05, "median of ln sigma");
    support_near(log(longer[COUNT * 84 / 100]), log(3) + 0.75, 0.08, "one deviation above");
    support_near(ln_ratio[COUNT / 2], -0.6745 * 0.6, 0.04, "median of ln ratio");
    mem_free(longer);
    mem_free(ln_ratio);
    gaussians_destroy(&g);
}

static void a_splat_does_not_depend_on_how_many_there_are(void **state) {
    (void)state;
    const Camera camera = bench_scene_camera(270, 480);
    Gaussians few = bench_scene_gaussians(7, 10, &camera), many = bench_scene_gaussians(7, 20, &camera),
              other = bench_scene_gaussians(8, 10, &camera);
    for (int id = 0; id < FIELD_COUNT; id++)
        assert_memory_equal(few.field[id], many.field[id], 10 * (size_t)GAUSSIAN_FIELDS[id].width * sizeof(float));
    assert_memory_not_equal(few.field[FIELD_MEAN], other.field[FIELD_MEAN], 30 * sizeof(float));
    gaussians_destroy(&few);
    gaussians_destroy(&many);
    gaussians_destroy(&other);
}

static void the_photo_is_seeded_noise(void **state) {
    (void)state;
    Image8 a = bench_scene_photo(1, 64, 48), b = bench_scene_photo(1, 64, 48), c = bench_scene_photo(2, 64, 48);
    double mean = 0;
    for (int k = 0; k < 64 * 48 * 3; k++) mean += a.bytes[k] / (64.0 * 48 * 3);
    assert_memory_equal(a.bytes, b.bytes, 64 * 48 * 3);
    assert_memory_not_equal(a.bytes, c.bytes, 64 * 48 * 3);
    support_near(mean, 127.5, 4, "mean byte");
    image8_destroy(&a);
    image8_destroy(&b);
    image8_destroy(&c);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sizes_and_places_on_the_screen_are_those_of_the_standard_scene),
        cmocka_unit_test(a_splat_does_not_depend_on_how_many_there_are),
        cmocka_unit_test(the_photo_is_seeded_noise),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
