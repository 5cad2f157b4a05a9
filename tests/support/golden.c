#include "tests/support/golden.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "lab/io/image_io.h"
#include "tests/support/support.h"

#include <stdlib.h>
#include <string.h>

static const char GOLDEN_FOLDER[] = "tests/golden", FAILED_FOLDER[] = "build/golden";
enum { DIFFERENCE_GAIN = 8 };

static bool is_writing(void) {
    const char *wish = getenv("SPLATLAB_GOLDEN");
    return wish && strcmp(wish, "write") == 0;
}

static Image8 difference_of(const Image8 *yours, const Image8 *expected) {
    Image8 difference = image8_create(yours->width, yours->height, 3);
    for (int i = 0; i < yours->width * yours->height * 3; i++) {
        int gained = DIFFERENCE_GAIN * abs(yours->bytes[i] - expected->bytes[i]);
        difference.bytes[i] = (uint8_t)(gained < 255 ? gained : 255);
    }
    return difference;
}

static void write_one(const char *name, const char *what, const Image8 *image) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s_%s.png", FAILED_FOLDER, name, what);
    if (file_make_folder(FAILED_FOLDER) && image_save8(path, image))
        print_message("    %s: %s\n", what, path);
    else
        print_message("    %s\n", fail_text());
}

static bool compare(const Image8 *yours, const Image8 *expected, const char *name) {
    double most = 0, sum = 0;
    int numbers = yours->width * yours->height * 3;
    bool same_size = yours->width == expected->width && yours->height == expected->height;
    for (int i = 0; same_size && i < numbers; i++) {
        double off = abs(yours->bytes[i] - expected->bytes[i]);
        sum += off;
        if (off > most) most = off;
    }
    if (same_size && most <= GOLDEN_MOST && sum / numbers <= GOLDEN_MEAN) return true;
    print_message("%s is not as it was: %d x %d px, differs by at most %g (%g is allowed), on the mean by %.3f (%g)\n",
                  name, yours->width, yours->height, most, GOLDEN_MOST, sum / numbers, GOLDEN_MEAN);
    write_one(name, "yours", yours);
    write_one(name, "expected", expected);
    if (!same_size) return false;
    Image8 difference = difference_of(yours, expected);
    write_one(name, "difference", &difference);
    image8_destroy(&difference);
    return false;
}

bool golden_matches(const char *path, const char *name) {
    char golden[4096];
    Image8 picture = {0}, expected = {0};
    snprintf(golden, sizeof golden, "%s/%s.png", GOLDEN_FOLDER, name);
    if (!image_load8(path, &picture)) fail_msg("%s", fail_text());
    Image8 yours = image8_downscale(&picture, GOLDEN_SHRINK);
    bool good = true;
    if (is_writing())
        good = file_make_folder(GOLDEN_FOLDER) && image_save8(golden, &yours);
    else if (image_load8(golden, &expected))
        good = compare(&yours, &expected, name);
    else
        good = false;
    if (!good && !expected.bytes) print_message("%s\n", fail_text());
    image8_destroy(&picture);
    image8_destroy(&yours);
    image8_destroy(&expected);
    return good;
}

bool golden_text_matches(const char *text, const char *name) {
    char golden[4096], failed[4096], *expected = NULL;
    size_t size;
    snprintf(golden, sizeof golden, "%s/%s", GOLDEN_FOLDER, name);
    snprintf(failed, sizeof failed, "%s/%s", FAILED_FOLDER, name);
    if (is_writing()) return file_make_folder(GOLDEN_FOLDER) && file_write(golden, text, strlen(text));
    bool good = file_read(golden, &expected, &size) && strcmp(text, expected) == 0;
    mem_free(expected);
    if (good) return true;
    print_message("%s is not as it was\n", name);
    if (file_make_folder(FAILED_FOLDER) && file_write(failed, text, strlen(text)))
        print_message("    yours: %s\n    expected: %s\n", failed, golden);
    return false;
}
