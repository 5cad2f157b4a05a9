#include "lab/base/log.h"
#include "tests/support/support.h"

#include <string.h>
#include <unistd.h>

// Sends stderr to a file while `print` runs, and gives back what was written.
static const char *stderr_of(void (*print)(void)) {
    static char said[4096];
    const char *path = support_path(support_scratch(), "stderr");
    fflush(stderr);
    int before = dup(STDERR_FILENO);
    FILE *file = fopen(path, "w+");
    dup2(fileno(file), STDERR_FILENO);
    print();
    fflush(stderr);
    dup2(before, STDERR_FILENO);
    close(before);
    rewind(file);
    said[fread(said, 1, sizeof said - 1, file)] = 0;
    fclose(file);
    return said;
}

static void print_all(void) {
    log_info("read %d views", 3);
    log_warn("no points");
    log_error("cannot read %s", "a.ply");
}

static void messages_are_lines_with_their_prefix(void **state) {
    (void)state;
    log_set_quiet(false);
    assert_string_equal(stderr_of(print_all), "read 3 views\nwarning: no points\nsplatlab: cannot read a.ply\n");
}

static void quiet_keeps_warnings_and_errors(void **state) {
    (void)state;
    log_set_quiet(true);
    assert_true(log_is_quiet());
    assert_string_equal(stderr_of(print_all), "warning: no points\nsplatlab: cannot read a.ply\n");
    log_set_quiet(false);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(messages_are_lines_with_their_prefix),
        cmocka_unit_test(quiet_keeps_warnings_and_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
