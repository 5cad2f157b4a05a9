#include "exercises/harness/ewa_picture.h"

#include "tests/support/support.h"

#include <math.h>

static const float *pixel_at(const ImageF *image, double part_x, double part_y) {
    int x = (int)(part_x * image->width), y = (int)(part_y * image->height);
    return &image->values[(y * image->width + x) * image->channels];
}

// Ten px to each side of EWA's centre; a ring of radius 5 px lies a quarter of the width from it.
static void the_gaussian_stands_where_its_mean_lies(void **state) {
    (void)state;
    ImageF image = ewa_picture((Sym2){25, 0, 25}, 6, -4, (Sym2){1, 0, 1}, 10);
    assert_int_equal(image.channels, 3);
    const float *mean = pixel_at(&image, 0.8, 0.3), *centre = pixel_at(&image, 0.5, 0.5);
    assert_true(mean[0] > 0.99f && mean[2] > 0.99f);
    assert_true(centre[0] < 0.01f);
    const float *blue = pixel_at(&image, 0.25, 0.5);
    assert_true(blue[2] > 2 * blue[0]);
    imagef_destroy(&image);
}

static void its_own_ring_is_orange(void **state) {
    (void)state;
    ImageF image = ewa_picture((Sym2){1, 0, 1}, 0, 0, (Sym2){25, 0, 4}, 10);
    const float *side = pixel_at(&image, 0.75, 0.5), *top = pixel_at(&image, 0.5, 0.6);
    assert_true(side[0] > 2 * side[2] && top[0] > 2 * top[2]);
    imagef_destroy(&image);
}

static void what_is_no_covariance_is_left_out(void **state) {
    (void)state;
    ImageF image = ewa_picture((Sym2){25, 0, 25}, 0, 0, (Sym2){NAN, NAN, NAN}, 10);
    for (int i = 0; i < image.width * image.height; i++) {
        const float *rgb = &image.values[3 * i];
        assert_true(isfinite(rgb[0]) && rgb[0] <= 0.21f);
    }
    imagef_destroy(&image);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_gaussian_stands_where_its_mean_lies),
        cmocka_unit_test(its_own_ring_is_orange),
        cmocka_unit_test(what_is_no_covariance_is_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
