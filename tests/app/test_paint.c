#include "lab/app/paint.h"
#include "lab/base/rng.h"
#include "tests/support/support.h"

#include <string.h>

enum { SIDE = 32 };

static const int WHOLE[4] = {0, 0, SIDE, SIDE};

static Image8 white_texture(void) {
    Image8 white = image8_create(1, 1, 3);
    memset(white.bytes, 255, 3);
    return white;
}

static PaintVertex vertex(double x, double y, double u, double v, int alpha) {
    return (PaintVertex){(float)x, (float)y, (float)u, (float)v, {255, 255, 255, (uint8_t)alpha}};
}

// A rectangle cut at random into two triangles, half transparent: were the seam drawn twice or not at all, it would show.
static void two_triangles_share_their_edge(void **state) {
    (void)state;
    Rng rng = rng_at(1, RNG_TEST, 0, 0);
    Image8 white = white_texture();
    for (int round = 0; round < 100; round++) {
        Image8 image = image8_create(SIDE, SIDE, 3);
        // in half pixels: many edges go through centres
        double x0 = rng_below(&rng, 20) / 2.0, y0 = rng_below(&rng, 20) / 2.0, x1 = 20 + rng_below(&rng, 20) / 2.0,
               y1 = 20 + rng_below(&rng, 20) / 2.0;
        PaintVertex corners[4] = {vertex(x0, y0, 0, 0, 128), vertex(x1, y0, 0, 0, 128), vertex(x1, y1, 0, 0, 128),
                                  vertex(x0, y1, 0, 0, 128)};
        static const uint16_t cuts[2][6] = {{0, 1, 2, 0, 2, 3}, {1, 2, 3, 3, 1, 0}};
        paint_triangles(&image, WHOLE, (PaintTexture){&white, false}, corners, cuts[rng_below(&rng, 2)], 6);
        for (int y = 0; y < SIDE; y++)
            for (int x = 0; x < SIDE; x++) {
                bool inside = x + 0.5 >= x0 && x + 0.5 < x1 && y + 0.5 >= y0 && y + 0.5 < y1;
                assert_int_equal(image.bytes[3 * (y * SIDE + x)], inside ? 128 : 0);
            }
        image8_destroy(&image);
    }
    image8_destroy(&white);
}

static void a_picture_at_its_own_size_is_copied(void **state) {
    (void)state;
    static const uint16_t indices[6] = {0, 1, 2, 0, 2, 3};
    Rng rng = rng_at(2, RNG_TEST, 0, 0);
    Image8 picture = image8_create(8, 8, 3), image = image8_create(SIDE, SIDE, 3);
    for (int i = 0; i < 8 * 8 * 3; i++) picture.bytes[i] = (uint8_t)rng_below(&rng, 256);
    PaintVertex corners[4] = {vertex(5, 6, 0, 0, 255), vertex(13, 6, 1, 0, 255), vertex(13, 14, 1, 1, 255),
                              vertex(5, 14, 0, 1, 255)};
    for (int smooth = 0; smooth < 2; smooth++) {
        paint_triangles(&image, WHOLE, (PaintTexture){&picture, smooth}, corners, indices, 6);
        for (int y = 0; y < 8; y++)
            assert_memory_equal(image.bytes + 3 * ((y + 6) * SIDE + 5), picture.bytes + 3 * y * 8, 24);
    }
    image8_destroy(&picture);
    image8_destroy(&image);
}

static void nothing_is_drawn_outside_the_clip_or_the_image(void **state) {
    (void)state;
    static const uint16_t indices[3] = {0, 1, 2};
    const int clip[4] = {4, 5, 20, 10};
    Image8 white = white_texture(), image = image8_create(SIDE, SIDE, 3);
    PaintVertex huge[3] = {vertex(-1e5, -1e5, 0, 0, 255), vertex(1e5, -1e5, 0, 0, 255), vertex(0, 1e5, 0, 0, 255)};
    paint_triangles(&image, clip, (PaintTexture){&white, false}, huge, indices, 3);
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
            assert_int_equal(image.bytes[3 * (y * SIDE + x)], x >= 4 && x < 20 && y >= 5 && y < 10 ? 255 : 0);
    const int beyond[4] = {-100, -100, 1000, 1000};
    paint_triangles(&image, beyond, (PaintTexture){&white, false}, huge, indices, 3);
    assert_int_equal(image.bytes[0], 255);
    image8_destroy(&white);
    image8_destroy(&image);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_triangles_share_their_edge),
        cmocka_unit_test(a_picture_at_its_own_size_is_copied),
        cmocka_unit_test(nothing_is_drawn_outside_the_clip_or_the_image),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
