#include "lab/io/file.h"
#include "lab/io/image_io.h"
#include "tests/support/command.h"
#include "tests/support/support.h"

#include <jansson.h>
#include <stdbool.h>
#include <string.h>

static const char *const NAMES[] = {"cov2", "conic", "psd",    "composite", "popping",   "nerf",
                                    "quat", "cov3",  "camera", "ewa",       "ewa-error", "sh"};
enum { NAME_COUNT = sizeof NAMES / sizeof NAMES[0], WIDTH_MAX = 800 };

static json_t *numbers_of(const char *name) {
    CommandResult r = command_run("figure", name, "--json", NULL);
    command_expect(&r, 0);
    json_t *root = json_loads(r.out, 0, NULL); // exactly one document: anything behind it is refused
    assert_non_null(root);
    return root;
}

static double number(const json_t *root, const char *key) {
    const json_t *value = json_object_get(root, key);
    assert_true(json_is_number(value));
    return json_number_value(value);
}

// How many different colours a picture has, up to a few.
static int colours_of(const Image8 *image) {
    enum { MOST = 32 };
    uint8_t seen[MOST][3];
    int count = 0;
    for (int i = 0; i < image->width * image->height && count < MOST; i++) {
        bool known = false;
        for (int k = 0; k < count && !known; k++) known = memcmp(seen[k], image->bytes + 3 * i, 3) == 0;
        if (!known) memcpy(seen[count++], image->bytes + 3 * i, 3);
    }
    return count;
}

static void each_figure_is_a_picture_with_something_on_it(void **state) {
    (void)state;
    for (int i = 0; i < NAME_COUNT; i++) {
        const char *path = support_path(support_scratch(), "figure.png");
        Image8 image = {0};
        CommandResult r = command_run("figure", NAMES[i], "-o", path, NULL);
        command_expect(&r, 0);
        assert_true(image_load8(path, &image));
        assert_true(image.width <= WIDTH_MAX && image.height >= 200);
        assert_true(colours_of(&image) >= 32);
        image8_destroy(&image);
    }
}

static void a_figure_is_the_same_each_time(void **state) {
    (void)state;
    Image8 images[2] = {{0}, {0}};
    for (int i = 0; i < 2; i++) {
        const char *path = support_path(support_scratch(), "again.png");
        CommandResult r = command_run("figure", "ewa", "-o", path, NULL);
        command_expect(&r, 0);
        assert_true(image_load8(path, &images[i]));
    }
    assert_int_equal(images[0].height, images[1].height);
    assert_memory_equal(images[0].bytes, images[1].bytes, (size_t)images[0].width * images[0].height * 3);
    image8_destroy(&images[0]);
    image8_destroy(&images[1]);
}

static void the_numbers_are_those_of_the_lesson(void **state) {
    (void)state;
    json_t *root = numbers_of("nerf");
    support_near(number(json_object_get(root, "exponential"), "order"), 2, 0.05, "order of 1 - exp");
    support_near(number(json_object_get(root, "linear"), "order"), 1, 0.05, "order of sigma delta");
    json_decref(root);
    root = numbers_of("quat");
    support_near(number(json_object_get(root, "with_normalisation"), "largest_part_along_q"), 0, 1e-14, "q . dq");
    assert_true(number(json_object_get(root, "without"), "largest_part_along_q") > 0.5);
    json_decref(root);
    root = numbers_of("composite");
    double sum = number(root, "transmittance");
    for (size_t i = 0; i < json_array_size(json_object_get(root, "weights")); i++)
        sum += json_number_value(json_array_get(json_object_get(root, "weights"), i));
    support_near(sum, 1, 1e-12, "weights + T");
    json_decref(root);
}

static void the_table_of_errors_grows_with_size_and_angle(void **state) {
    (void)state;
    enum { SIZES = 4 };
    json_t *root = numbers_of("ewa-error"), *table = json_object_get(root, "table");
    assert_int_equal(json_array_size(table), 16);
    for (size_t i = 0; i < 16; i++) {
        double here = number(json_array_get(table, i), "covariance_error");
        if (i % SIZES) assert_true(here > number(json_array_get(table, i - 1), "covariance_error"));
        if (i >= SIZES) assert_true(here > number(json_array_get(table, i - SIZES), "covariance_error"));
    }
    json_decref(root);
}

static void help_lists_the_figures(void **state) {
    (void)state;
    CommandResult r = command_run("figure", "--help", NULL);
    command_expect(&r, 0);
    for (int i = 0; i < NAME_COUNT; i++) assert_non_null(strstr(r.out, NAMES[i]));
}

static void wrong_usage_ends_with_exit_code_2(void **state) {
    (void)state;
    CommandResult r = command_run("figure", NULL);
    command_expect_error(&r, 2, "which one", NULL);
    r = command_run("figure", "cov", "--json", NULL);
    command_expect_error(&r, 2, "no figure 'cov'", "did you mean cov", NULL);
    r = command_run("figure", "moon", "--json", NULL);
    command_expect_error(&r, 2, "no figure 'moon'", "--help", NULL);
    r = command_run("figure", "cov2", NULL);
    command_expect_error(&r, 2, "-o FILE.png", NULL);
    r = command_run("figure", "cov2", "-o", "cov2.gif", NULL);
    command_expect_error(&r, 2, "cov2.gif", ".png", NULL);
    assert_false(file_exists("cov2.gif"));
    r = command_run("figure", "cov2", "-o", "no/such/folder/cov2.png", NULL);
    command_expect_error(&r, 1, "no/such/folder", NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_figure_is_a_picture_with_something_on_it),
        cmocka_unit_test(a_figure_is_the_same_each_time),
        cmocka_unit_test(the_numbers_are_those_of_the_lesson),
        cmocka_unit_test(the_table_of_errors_grows_with_size_and_angle),
        cmocka_unit_test(help_lists_the_figures),
        cmocka_unit_test(wrong_usage_ends_with_exit_code_2),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
