// test_png_check.c - a PNG that is cut off or changed anywhere is noticed.
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "lab/io/image_io.h"
#include "lab/io/png_check.h"
#include "tests/support/support.h"

#include <string.h>

// Without file_write()'s sync to the disk, which would take most of the time here.
static void write_bytes(const char *path, const char *data, size_t size) {
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    fclose(file);
}

static void every_cut_and_every_changed_byte_is_noticed(void **state) {
    (void)state;
    char *path = file_join(support_scratch(), "a.png");
    Image8 image = image8_create(9, 7, 3);
    assert_true(image_save8(path, &image));
    assert_true(png_check(path));
    char *data;
    size_t size;
    assert_true(file_read(path, &data, &size));
    for (size_t cut = 8; cut < size; cut++) {
        write_bytes(path, data, cut);
        if (png_check(path)) fail_msg("cut after %zu of %zu bytes", cut, size);
        assert_non_null(strstr(fail_text(), path));
    }
    for (size_t at = 8; at < size; at++) {
        data[at] ^= 0x10;
        write_bytes(path, data, size);
        if (png_check(path)) fail_msg("byte %zu of %zu was changed", at, size);
        data[at] ^= 0x10;
    }
    mem_free(data);
    mem_free(path);
    image8_destroy(&image);
}

static void what_does_not_begin_as_a_png_passes(void **state) {
    (void)state;
    const char *path = support_path(support_scratch(), "a.txt");
    write_bytes(path, "text", 4);
    assert_true(png_check(path));
    assert_false(png_check("no/such/file.png"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_cut_and_every_changed_byte_is_noticed),
        cmocka_unit_test(what_does_not_begin_as_a_png_passes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
