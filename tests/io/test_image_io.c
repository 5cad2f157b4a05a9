// test_image_io.c - pictures there and back in every format, upright, with straight alpha; broken ones named.
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/base/rng.h"
#include "lab/io/file.h"
#include "lab/io/image_io.h"
#include "tests/support/support.h"

#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

static const char *scratch(const char *name) { return support_path(support_scratch(), name); }

static Image8 noise(int width, int height, int channels) {
    Image8 image = image8_create(width, height, channels);
    Rng rng = rng_at(1, RNG_TEST, (uint32_t)channels, 0);
    for (int i = 0; i < width * height * channels; i++) image.bytes[i] = (uint8_t)rng_below(&rng, 256);
    return image;
}

static void assert_same8(const Image8 *a, const Image8 *b) {
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    assert_int_equal(a->channels, b->channels);
    assert_memory_equal(a->bytes, b->bytes, (size_t)a->width * (size_t)a->height * (size_t)a->channels);
}

static Image8 load8(const char *path) {
    Image8 image;
    if (!image_load8(path, &image)) fail_msg("%s", fail_text());
    return image;
}

static ImageF loadf(const char *path) {
    ImageF image;
    if (!image_loadf(path, &image)) fail_msg("%s", fail_text());
    return image;
}

static void save8(const char *path, const Image8 *image) {
    if (!image_save8(path, image)) fail_msg("%s", fail_text());
}

static void rgb_png_comes_back_to_the_byte(void **state) {
    (void)state;
    Image8 image = noise(37, 11, 3);
    save8(scratch("rgb.png"), &image);
    Image8 copy = load8(scratch("rgb.png"));
    assert_same8(&copy, &image);
    image8_destroy(&copy);
    image8_destroy(&image);
}

// All 256 values at every alpha: none may be touched, not even where alpha is 0.
static void rgba_comes_back_to_the_byte_at_every_alpha(void **state) {
    (void)state;
    Image8 image = image8_create(256, 256, 4);
    for (int alpha = 0; alpha < 256; alpha++)
        for (int value = 0; value < 256; value++) {
            uint8_t *pixel = image.bytes + 4 * (256 * alpha + value);
            pixel[0] = (uint8_t)value;
            pixel[1] = (uint8_t)(255 - value);
            pixel[2] = (uint8_t)(value * 7);
            pixel[3] = (uint8_t)alpha;
        }
    const char *names[] = {"rgba.png", "rgba.tif"};
    for (int i = 0; i < 2; i++) {
        save8(scratch(names[i]), &image);
        Image8 copy = load8(scratch(names[i]));
        assert_same8(&copy, &image);
        image8_destroy(&copy);
        ImageF values = loadf(scratch(names[i]));
        assert_int_equal(values.channels, 4);
        for (int k = 0; k < 256 * 256 * 4; k++)
            support_near(values.values[k], image.bytes[k] / 255.0, 1e-6, "straight value");
        imagef_destroy(&values);
    }
    image8_destroy(&image);
}

static void rgba_exr_keeps_its_colours_where_they_can_be_seen(void **state) {
    (void)state;
    Image8 image = noise(32, 32, 4);
    for (int i = 0; i < 32 * 32; i++)
        if (image.bytes[4 * i + 3] == 0) image.bytes[4 * i + 3] = 1;
    save8(scratch("rgba.exr"), &image);
    Image8 copy = load8(scratch("rgba.exr"));
    assert_same8(&copy, &image);
    image8_destroy(&copy);
    image8_destroy(&image);
}

static void jpeg_comes_back_nearly(void **state) {
    (void)state;
    Image8 image = image8_create(64, 48, 3);
    for (int y = 0; y < 48; y++)
        for (int x = 0; x < 64; x++) {
            uint8_t *pixel = image.bytes + 3 * (64 * y + x);
            pixel[0] = (uint8_t)(4 * x), pixel[1] = (uint8_t)(5 * y), pixel[2] = 100;
        }
    save8(scratch("a.jpg"), &image);
    Image8 copy = load8(scratch("a.jpg"));
    assert_int_equal(copy.width, 64);
    assert_int_equal(copy.height, 48);
    for (int i = 0; i < 64 * 48 * 3; i++) assert_true(abs(copy.bytes[i] - image.bytes[i]) <= 8);
    image8_destroy(&copy);
    image8_destroy(&image);
}

static void float_files_keep_their_values(void **state) {
    (void)state;
    const float wanted[] = {-2.5f, 0, 1e-6f, 1.0f / 3, 1, 60000};
    const char *names[] = {"f.exr", "f.tif"};
    for (int channels = 1; channels <= 3; channels += 2)
        for (int i = 0; i < 2; i++) {
            ImageF image = imagef_create(6 / channels, 1, channels);
            memcpy(image.values, wanted, sizeof wanted);
            assert_true(image_savef(scratch(names[i]), &image));
            ImageF copy = loadf(scratch(names[i]));
            assert_int_equal(copy.channels, channels);
            assert_memory_equal(copy.values, wanted, sizeof wanted);
            imagef_destroy(&copy);
            imagef_destroy(&image);
        }
}

static void float_to_png_is_rounded_and_clipped(void **state) {
    (void)state;
    ImageF image = imagef_create(2, 1, 3);
    const float values[] = {-1, 0.25f, 2, 0.5f, 1, NAN};
    memcpy(image.values, values, sizeof values);
    assert_true(image_savef(scratch("clip.png"), &image));
    Image8 copy = load8(scratch("clip.png"));
    const uint8_t wanted[] = {0, 64, 255, 128, 255, 0};
    assert_memory_equal(copy.bytes, wanted, 6);
    image8_destroy(&copy);
    imagef_destroy(&image);
}

static void grey_becomes_rgb_as_bytes_and_stays_grey_as_float(void **state) {
    (void)state;
    Image8 image = noise(5, 4, 1);
    save8(scratch("grey.png"), &image);
    int width, height, channels;
    assert_true(image_probe(scratch("grey.png"), &width, &height, &channels));
    assert_int_equal(channels, 3);
    Image8 copy = load8(scratch("grey.png"));
    assert_int_equal(copy.channels, 3);
    for (int i = 0; i < 20; i++)
        for (int c = 0; c < 3; c++) assert_int_equal(copy.bytes[3 * i + c], image.bytes[i]);
    ImageF values = loadf(scratch("grey.png"));
    assert_int_equal(values.channels, 1);
    imagef_destroy(&values);
    image8_destroy(&copy);
    image8_destroy(&image);
}

// Made outside of our own writer: 16 bit, grey with alpha, EXIF. oiiotool comes with OpenImageIO's tools.
static bool oiiotool(const char *arguments) {
    char *command = mem_format("cd '%s' && oiiotool %s", support_scratch(), arguments);
    bool ok = system("command -v oiiotool > /dev/null") == 0 && system(command) == 0;
    mem_free(command);
    if (!ok) {
        print_message("skipped: no oiiotool (Debian: openimageio-tools)\n");
        skip();
    }
    return ok;
}

static void sixteen_bits_become_float_and_are_rounded_to_eight(void **state) {
    (void)state;
    ImageF image = imagef_create(4, 1, 3);
    for (int i = 0; i < 12; i++) image.values[i] = (float)(i * 5000 + 123) / 65535.0f;
    assert_true(image_savef(scratch("deep.tif"), &image));
    if (!oiiotool("deep.tif -d uint16 -o deep.png")) return;
    ImageF copy = loadf(scratch("deep.png"));
    Image8 bytes = load8(scratch("deep.png"));
    for (int i = 0; i < 12; i++) {
        support_near(copy.values[i], (i * 5000 + 123) / 65535.0, 1e-7, "16-bit value");
        assert_int_equal(bytes.bytes[i], (int)lround(255.0 * (i * 5000 + 123) / 65535));
    }
    image8_destroy(&bytes);
    imagef_destroy(&copy);
    imagef_destroy(&image);
}

static void grey_with_alpha_becomes_rgba(void **state) {
    (void)state;
    Image8 image = noise(6, 5, 4);
    save8(scratch("source.png"), &image);
    if (!oiiotool("-iconfig oiio:UnassociatedAlpha 1 -i source.png --ch R,A --chnames Y,A -o ya.png")) return;
    Image8 copy = load8(scratch("ya.png"));
    assert_int_equal(copy.channels, 4);
    for (int i = 0; i < 30; i++) {
        assert_int_equal(copy.bytes[4 * i], copy.bytes[4 * i + 2]);
        assert_int_equal(copy.bytes[4 * i + 3], image.bytes[4 * i + 3]);
    }
    image8_destroy(&copy);
    image8_destroy(&image);
}

// A picture of 3 x 2 whose pixels differ; each EXIF orientation says how to turn what is stored.
static void every_orientation_stands_upright(void **state) {
    (void)state;
    // Of the stored pixels 0 1 2 / 3 4 5, what the upright picture holds, row by row (EXIF 2.3, tag 0112).
    static const int upright[8][6] = {{0, 1, 2, 3, 4, 5}, {2, 1, 0, 5, 4, 3}, {5, 4, 3, 2, 1, 0}, {3, 4, 5, 0, 1, 2},
                                      {0, 3, 1, 4, 2, 5}, {3, 0, 4, 1, 5, 2}, {5, 2, 4, 1, 3, 0}, {2, 5, 1, 4, 0, 3}};
    Image8 image = image8_create(3, 2, 3);
    for (int i = 0; i < 6; i++)
        for (int c = 0; c < 3; c++) image.bytes[3 * i + c] = (uint8_t)(40 * i);
    save8(scratch("flat.tif"), &image);
    for (int k = 0; k < 8; k++) {
        char *arguments = mem_format("flat.tif -d uint8 --orientation %d -o turned.tif", k + 1);
        if (!oiiotool(arguments)) return;
        mem_free(arguments);
        int width, height, channels;
        assert_true(image_probe(scratch("turned.tif"), &width, &height, &channels));
        assert_int_equal(width, k < 4 ? 3 : 2);
        assert_int_equal(height, k < 4 ? 2 : 3);
        Image8 turned = load8(scratch("turned.tif"));
        assert_int_equal(turned.width, width);
        for (int i = 0; i < 6; i++) assert_int_equal(turned.bytes[3 * i], 40 * upright[k][i]);
        image8_destroy(&turned);
        assert_true(image_probe_stored(scratch("turned.tif"), &width, &height, &channels));
        assert_int_equal(width, 3);
        Image8 stored;
        assert_true(image_load8_stored(scratch("turned.tif"), &stored));
        assert_int_equal(stored.height, 2);
        for (int i = 0; i < 6; i++) assert_int_equal(stored.bytes[3 * i], 40 * i);
        image8_destroy(&stored);
    }
    image8_destroy(&image);
}

static void the_same_pixels_give_the_same_file(void **state) {
    (void)state;
    const char *endings[] = {"jpg", "exr", "tif", "png"};
    Image8 image = noise(16, 16, 3);
    char hex[2][65], today[16];
    time_t now = time(NULL);
    strftime(today, sizeof today, "%Y:%m:%d", localtime(&now));
    for (int i = 0; i < 4; i++) {
        char name[2][16];
        for (int k = 0; k < 2; k++) {
            snprintf(name[k], sizeof name[k], "same%d.%s", k, endings[i]);
            save8(scratch(name[k]), &image);
        }
        for (int k = 0; k < 2; k++) assert_true(file_sha256(scratch(name[k]), hex[k]));
        assert_string_equal(hex[0], hex[1]);
        char *data;
        size_t size;
        assert_true(file_read(scratch(name[0]), &data, &size));
        if (memmem(data, size, today, strlen(today))) fail_msg("%s holds the date of writing", name[0]);
        mem_free(data);
    }
    image8_destroy(&image);
}

static void refuses(const char *path, const char *reason) {
    Image8 image = {0};
    ImageF values = {0};
    if (image_load8(path, &image)) fail_msg("was read: %s", path);
    if (!strstr(fail_text(), path) || !strstr(fail_text(), reason) || strchr(fail_text(), '\n'))
        fail_msg("for %s: %s", path, fail_text());
    assert_false(image_loadf(path, &values));
    assert_null(image.bytes);
    assert_null(values.values);
}

static void a_file_that_was_cut_off_is_an_error(void **state) {
    (void)state;
    const char *endings[] = {"jpg", "exr", "tif", "png"};
    Image8 image = noise(100, 80, 3);
    for (int i = 0; i < 4; i++) {
        char name[16];
        snprintf(name, sizeof name, "cut.%s", endings[i]);
        save8(scratch(name), &image);
        char *data;
        size_t size;
        assert_true(file_read(scratch(name), &data, &size));
        const double parts[] = {0.9, 0.5, 0.1, 0.001};
        for (int k = 0; k < 4; k++) {
            assert_true(file_write(scratch(name), data, (size_t)(parts[k] * (double)size)));
            refuses(scratch(name), "cannot read image");
        }
        mem_free(data);
    }
    image8_destroy(&image);
}

static void what_is_no_picture_is_an_error(void **state) {
    (void)state;
    refuses("no/such/picture.png", "no such file");
    refuses(support_scratch(), "folder");
    assert_true(file_write(scratch("text.png"), "hello, this is text", 19));
    refuses(scratch("text.png"), "cannot read image");
    assert_true(file_write(scratch("empty.jpg"), "", 0));
    refuses(scratch("empty.jpg"), "cannot read image");
    assert_true(file_write(scratch("text.xyz"), "hello, this is text", 19));
    refuses(scratch("text.xyz"), "cannot read image");
}

static void a_picture_that_cannot_be_written_is_an_error(void **state) {
    (void)state;
    Image8 image = noise(4, 4, 4);
    assert_false(image_save8(scratch("a.xyz"), &image));
    assert_non_null(strstr(fail_text(), ".png, .jpg, .exr or .tif"));
    assert_false(image_save8(scratch("a.jpg"), &image));
    assert_non_null(strstr(fail_text(), "no alpha"));
    assert_false(image_save8("no/such/folder/a.png", &image));
    assert_non_null(strstr(fail_text(), "no/such/folder"));
    assert_false(image_save8("/proc/a.png", &image));
    assert_non_null(strstr(fail_text(), "/proc/a.png"));
    image8_destroy(&image);
}

static void a_full_disk_leaves_the_old_picture(void **state) {
    (void)state;
    const char *endings[] = {"jpg", "exr", "tif", "png"};
    Image8 small = noise(4, 4, 3), large = noise(200, 200, 3);
    char *folder = file_join(support_scratch(), "limit");
    assert_true(file_make_folder(folder));
    for (int i = 0; i < 4; i++) {
        char *path = mem_format("%s/a.%s", folder, endings[i]);
        save8(path, &small);
        char before[65], after[65];
        assert_true(file_sha256(path, before));
        struct rlimit old, tiny;
        getrlimit(RLIMIT_FSIZE, &old);
        tiny = old;
        tiny.rlim_cur = 3000;
        signal(SIGXFSZ, SIG_IGN);
        setrlimit(RLIMIT_FSIZE, &tiny);
        bool written = image_save8(path, &large);
        setrlimit(RLIMIT_FSIZE, &old);
        if (written) fail_msg("%s: the error was not noticed", path);
        assert_non_null(strstr(fail_text(), path));
        assert_true(file_sha256(path, after));
        assert_string_equal(before, after);
        char **names;
        int count;
        assert_true(file_list(folder, &names, &count));
        assert_int_equal(count, i + 1);
        file_list_free(names, count);
        mem_free(path);
    }
    mem_free(folder);
    image8_destroy(&small);
    image8_destroy(&large);
}

static void photographs_of_others_are_read(void **state) {
    (void)state;
    int width, height, channels;
    const char *path = support_data("banana/images/DSC_0423.JPG");
    assert_true(image_probe(path, &width, &height, &channels));
    assert_int_equal(width, 640);
    assert_int_equal(height, 426);
    assert_int_equal(channels, 3);
    Image8 image = load8(path);
    assert_int_equal(image.height, 426);
    image8_destroy(&image);
    image = load8(support_data("chair/train/r_0.png"));
    assert_int_equal(image.channels, 4);
    assert_int_equal(image.bytes[3], 0); // the chair stands in the middle, before nothing
    assert_int_equal(image.bytes[4 * (200 * 400 + 200) + 3], 255);
    image8_destroy(&image);
}

// How often a byte sequence occurs in a file.
static int occurrences(const char *path, const char *bytes, size_t length) {
    char *data;
    size_t size;
    int found = 0;
    if (!file_read(path, &data, &size)) fail_msg("%s", fail_text());
    for (size_t i = 0; i + length <= size; i++) found += memcmp(data + i, bytes, length) == 0;
    mem_free(data);
    return found;
}

static void a_film_has_its_frames_its_delay_and_no_end(void **state) {
    (void)state;
    enum { FRAMES = 3 };
    Image8 frames[FRAMES];
    for (int i = 0; i < FRAMES; i++) {
        frames[i] = image8_create(33, 17, 3);
        memset(frames[i].bytes, 100 * i + 20, 33 * 17 * 3);
    }
    const char *path = scratch("film.gif"), *again = scratch("again.gif");
    if (!image_save_gif(path, frames, FRAMES, 80)) fail_msg("%s", fail_text());
    // A graphic control block begins each frame: introducer, label, size, flags, then the delay in 1/100 s.
    assert_int_equal(occurrences(path, "\x21\xF9\x04\x05\x08\x00", 6), FRAMES);
    assert_int_equal(occurrences(path, "NETSCAPE2.0\x03\x01\x00\x00", 15), 1); // repeated without end
    Image8 first = load8(path);
    assert_int_equal(first.width, 33);
    assert_int_equal(first.height, 17);
    assert_int_equal(first.bytes[0], 20);
    image8_destroy(&first);

    if (!image_save_gif(again, frames, FRAMES, 80)) fail_msg("%s", fail_text());
    char sums[2][65];
    assert_true(file_sha256(path, sums[0]) && file_sha256(again, sums[1]));
    assert_string_equal(sums[0], sums[1]);
    for (int i = 0; i < FRAMES; i++) image8_destroy(&frames[i]);
}

static void a_film_of_different_sizes_is_refused(void **state) {
    (void)state;
    Image8 frames[2] = {noise(8, 8, 3), noise(8, 9, 3)};
    assert_false(image_save_gif(scratch("mixed.gif"), frames, 2, 100));
    assert_non_null(strstr(fail_text(), "frame 1 is 8 x 9"));
    assert_false(file_exists(scratch("mixed.gif")));
    assert_false(image_save_gif(scratch("film.png"), frames, 1, 100));
    assert_non_null(strstr(fail_text(), ".gif"));
    assert_false(image_save_gif(scratch("none.gif"), frames, 0, 100));
    for (int i = 0; i < 2; i++) image8_destroy(&frames[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rgb_png_comes_back_to_the_byte),
        cmocka_unit_test(rgba_comes_back_to_the_byte_at_every_alpha),
        cmocka_unit_test(rgba_exr_keeps_its_colours_where_they_can_be_seen),
        cmocka_unit_test(jpeg_comes_back_nearly),
        cmocka_unit_test(float_files_keep_their_values),
        cmocka_unit_test(float_to_png_is_rounded_and_clipped),
        cmocka_unit_test(grey_becomes_rgb_as_bytes_and_stays_grey_as_float),
        cmocka_unit_test(sixteen_bits_become_float_and_are_rounded_to_eight),
        cmocka_unit_test(grey_with_alpha_becomes_rgba),
        cmocka_unit_test(every_orientation_stands_upright),
        cmocka_unit_test(the_same_pixels_give_the_same_file),
        cmocka_unit_test(a_file_that_was_cut_off_is_an_error),
        cmocka_unit_test(what_is_no_picture_is_an_error),
        cmocka_unit_test(a_picture_that_cannot_be_written_is_an_error),
        cmocka_unit_test(a_full_disk_leaves_the_old_picture),
        cmocka_unit_test(photographs_of_others_are_read),
        cmocka_unit_test(a_film_has_its_frames_its_delay_and_no_end),
        cmocka_unit_test(a_film_of_different_sizes_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
