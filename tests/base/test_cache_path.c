#include "lab/base/cache_path.h"

#include "lab/base/mem.h"
#include "tests/support/support.h"

#include <stdlib.h>

static void expect(const char *cache, const char *home, const char *path) {
    cache ? setenv("XDG_CACHE_HOME", cache, 1) : unsetenv("XDG_CACHE_HOME");
    home ? setenv("HOME", home, 1) : unsetenv("HOME");
    char *actual = cache_path("things");
    if (path)
        assert_string_equal(actual, path);
    else
        assert_null(actual);
    mem_free(actual);
}

static void the_cache_comes_before_home_and_relative_paths_do_not_count(void **state) {
    (void)state;
    expect("/c", "/h", "/c/splatlab/things");
    expect(NULL, "/h", "/h/.cache/splatlab/things");
    expect("", "/h", "/h/.cache/splatlab/things");
    expect("c", "/h", "/h/.cache/splatlab/things");
    expect(NULL, NULL, NULL);
    expect("c", "h", NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_cache_comes_before_home_and_relative_paths_do_not_count),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
