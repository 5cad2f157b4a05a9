#include "lab/base/image.h"
#include "tests/support/support.h"

#include <math.h>
#include <string.h>

static void floats_are_clipped_and_rounded_to_the_nearest_byte(void **state) {
    (void)state;
    const float values[] = {-1, 0, 0.4999f / 255, 0.5001f / 255, 1, 7, NAN, INFINITY, -INFINITY};
    const int bytes[] = {0, 0, 0, 1, 255, 255, 0, 255, 0};
    ImageF image = imagef_create(9, 1, 1);
    memcpy(image.values, values, sizeof values);
    Image8 out = image8_from_float(&image);
    for (int i = 0; i < 9; i++) assert_int_equal(out.bytes[i], bytes[i]);
    image8_destroy(&out);
    imagef_destroy(&image);
}

static void every_byte_survives_the_way_through_float(void **state) {
    (void)state;
    Image8 image = image8_create(16, 16, 1);
    for (int i = 0; i < 256; i++) image.bytes[i] = (uint8_t)i;
    ImageF floats = imagef_from_8(&image);
    Image8 back = image8_from_float(&floats);
    assert_memory_equal(back.bytes, image.bytes, 256);
    image8_destroy(&back);
    imagef_destroy(&floats);
    image8_destroy(&image);
}

static void a_straight_alpha_picture_is_laid_over_the_background(void **state) {
    (void)state;
    Image8 image = image8_create(2, 1, 4);
    const uint8_t bytes[] = {255, 0, 0, 51, /* opaque: */ 10, 20, 30, 255};
    memcpy(image.bytes, bytes, sizeof bytes);
    const float background[3] = {0, 0.5f, 1};
    ImageF out = imagef_over(&image, background);
    assert_int_equal(out.channels, 3);
    const double expected[] = {0.2, 0.4, 0.8, 10 / 255.0, 20 / 255.0, 30 / 255.0};
    for (int i = 0; i < 6; i++) support_near(out.values[i], expected[i], 1e-6, "value");
    imagef_destroy(&out);
    image8_destroy(&image);
}

static void without_alpha_the_background_does_not_show(void **state) {
    (void)state;
    Image8 image = image8_create(1, 1, 3);
    image.bytes[1] = 255;
    ImageF out = imagef_over(&image, (const float[3]){1, 1, 1});
    assert_true(out.values[0] == 0 && out.values[1] == 1 && out.values[2] == 0);
    imagef_destroy(&out);
    image8_destroy(&image);
}

static void downscaling_takes_the_mean_of_blocks_and_cuts_the_remainder(void **state) {
    (void)state;
    Image8 image = image8_create(5, 3, 1); // 2 x 1 blocks of 2 x 2; the last column and row are cut
    for (int i = 0; i < 15; i++) image.bytes[i] = (uint8_t)(10 * i);
    Image8 out = image8_downscale(&image, 2);
    assert_int_equal(out.width, 2);
    assert_int_equal(out.height, 1);
    assert_int_equal(out.bytes[0], (0 + 10 + 50 + 60) / 4);
    assert_int_equal(out.bytes[1], (20 + 30 + 70 + 80) / 4);
    image8_destroy(&out);
    out = image8_downscale(&image, 1);
    assert_memory_equal(out.bytes, image.bytes, 15);
    image8_destroy(&out);
    image8_destroy(&image);
}

static void transparent_pixels_do_not_bleed_their_colour(void **state) {
    (void)state;
    Image8 image = image8_create(4, 2, 4);
    memset(image.bytes, 0, 4 * 2 * 4);
    for (int y = 0; y < 2; y++) { // left block: one column green and transparent, one column red and opaque
        const uint8_t green[] = {0, 255, 0, 0}, red[] = {200, 0, 0, 255};
        memcpy(image.bytes + (y * 4 + 0) * 4, green, 4);
        memcpy(image.bytes + (y * 4 + 1) * 4, red, 4);
    }
    Image8 out = image8_downscale(&image, 2);
    const uint8_t expected[] = {200, 0, 0, 128, 0, 0, 0, 0}; // alpha 127.5 rounds up; the right block is empty
    assert_memory_equal(out.bytes, expected, 8);
    image8_destroy(&out);
    image8_destroy(&image);
}

static void pasting_leaves_out_what_falls_outside(void **state) {
    (void)state;
    static const int corners[][2] = {{-2, -1}, {3, 3}, {1, 1}, {-5, 0}, {9, 9}, {0, -7}, {-2147483647, 0}};
    for (size_t k = 0; k < sizeof corners / sizeof corners[0]; k++) {
        ImageF target = imagef_create(5, 4, 3), source = imagef_create(3, 2, 3);
        for (int i = 0; i < 3 * 2 * 3; i++) source.values[i] = (float)(i + 1);
        int x0 = corners[k][0], y0 = corners[k][1];
        imagef_paste(&target, &source, x0, y0);
        for (int y = 0; y < 4; y++)
            for (int x = 0; x < 5; x++)
                for (int c = 0; c < 3; c++) {
                    long sx = (long)x - x0, sy = (long)y - y0;
                    int inside = sx >= 0 && sx < 3 && sy >= 0 && sy < 2;
                    float expected = inside ? (float)((sy * 3 + sx) * 3 + c + 1) : 0;
                    assert_true(target.values[(y * 5 + x) * 3 + c] == expected);
                }
        imagef_destroy(&target);
        imagef_destroy(&source);
    }
}

static void destroying_twice_is_harmless(void **state) {
    (void)state;
    Image8 a = image8_create(1, 1, 3), zero = {0};
    image8_destroy(&a);
    image8_destroy(&a);
    image8_destroy(&zero);
    assert_null(a.bytes);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(floats_are_clipped_and_rounded_to_the_nearest_byte),
        cmocka_unit_test(every_byte_survives_the_way_through_float),
        cmocka_unit_test(a_straight_alpha_picture_is_laid_over_the_background),
        cmocka_unit_test(without_alpha_the_background_does_not_show),
        cmocka_unit_test(downscaling_takes_the_mean_of_blocks_and_cuts_the_remainder),
        cmocka_unit_test(transparent_pixels_do_not_bleed_their_colour),
        cmocka_unit_test(pasting_leaves_out_what_falls_outside),
        cmocka_unit_test(destroying_twice_is_harmless),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
