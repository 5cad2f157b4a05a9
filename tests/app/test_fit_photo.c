#include "lab/app/fit_photo.h"

#include "lab/base/fail.h"
#include "lab/io/image_io.h"
#include "tests/support/support.h"

#include <string.h>

static const char *scratch(const char *name) { return support_path(support_scratch(), name); }

static ImageF ramp(int width, int height) {
    ImageF image = imagef_create(width, height, 3);
    for (int i = 0; i < width * height; i++)
        for (int c = 0; c < 3; c++) image.values[3 * i + c] = (float)(i % width) + 100.0f * (float)(i / width);
    return image;
}

static void shrinking_averages_the_area_that_a_pixel_covers(void **state) {
    (void)state;
    ImageF image = ramp(5, 3), small = fit_photo_shrink(&image, 2, 3);
    // Pixel 0 covers source pixels 0, 1 and half of 2; pixel 1 the other half, 3 and 4.
    for (int y = 0; y < 3; y++) {
        support_near((double)small.values[6 * y], 100 * y + (0 + 1 + 0.5 * 2) / 2.5, 1e-5, "left");
        support_near((double)small.values[6 * y + 3], 100 * y + (0.5 * 2 + 3 + 4) / 2.5, 1e-5, "right");
    }
    imagef_destroy(&small);
    small = fit_photo_shrink(&image, 5, 3); // the same size: the same picture
    assert_memory_equal(small.values, image.values, 5 * 3 * 3 * sizeof(float));
    imagef_destroy(&small);
    small = fit_photo_shrink(&image, 1, 1);
    support_near((double)small.values[0], 102, 1e-4, "mean of all");
    imagef_destroy(&small);
    imagef_destroy(&image);
}

static void what_is_transparent_becomes_white(void **state) {
    (void)state;
    Image8 file = image8_create(4, 4, 4);
    file.bytes[3] = 255; // one black pixel, opaque
    assert_true(image_save8(scratch("alpha.png"), &file));
    ImageF photo;
    if (!fit_photo_load(scratch("alpha.png"), 1, 0, 0, &photo)) fail_msg("%s", fail_text());
    assert_int_equal(photo.channels, 3);
    assert_true(photo.values[0] == 0 && photo.values[3] == 1);
    imagef_destroy(&photo);
    image8_destroy(&file);
}

static void a_size_is_a_limit_and_never_enlarges(void **state) {
    (void)state;
    Image8 file = image8_create(60, 30, 3);
    assert_true(image_save8(scratch("wide.png"), &file));
    static const int cases[][5] = {// downscale, limit, result
                                   {1, 20, 20, 20, 10}, {1, 100, 15, 30, 15}, {1, 600, 600, 60, 30},
                                   {2, 0, 0, 30, 15},   {2, 10, 10, 10, 5},   {1, 1, 1, 1, 1}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        ImageF photo;
        if (!fit_photo_load(scratch("wide.png"), cases[i][0], cases[i][1], cases[i][2], &photo))
            fail_msg("%s", fail_text());
        assert_int_equal(photo.width, cases[i][3]);
        assert_int_equal(photo.height, cases[i][4]);
        imagef_destroy(&photo);
    }
    ImageF photo;
    assert_false(fit_photo_load(scratch("wide.png"), 31, 0, 0, &photo));
    assert_non_null(strstr(fail_text(), "1/31"));
    image8_destroy(&file);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shrinking_averages_the_area_that_a_pixel_covers),
        cmocka_unit_test(what_is_transparent_becomes_white),
        cmocka_unit_test(a_size_is_a_limit_and_never_enlarges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
