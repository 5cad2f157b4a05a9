#include "lab/base/fail.h"
#include "lab/base/parallel.h"
#include "tests/support/support.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// cmocka's macro of the same name hides ours.
#undef fail

enum { COUNT = 500 };

static void count_visit(void *context, int index) { atomic_fetch_add(&((atomic_int *)context)[index], 1); }

static void every_index_is_visited_once(void **state) {
    (void)state;
    for (int threads = 1; threads <= 9; threads += 4) {
        char text[16];
        snprintf(text, sizeof text, "%d", threads);
        setenv("SPLATLAB_THREADS", text, 1);
        atomic_int visits[COUNT] = {0};
        parallel_for(COUNT, count_visit, visits);
        for (int i = 0; i < COUNT; i++) assert_int_equal(visits[i], 1);
    }
    parallel_for(0, count_visit, NULL);
    unsetenv("SPLATLAB_THREADS");
}

// Fails at 13, 14, 40 and 100; the lower the index, the later in time.
static bool fail_at_some(void *context, int index) {
    (void)context;
    if (index == 13) {
        usleep(20000);
        return fail_usage("index %d", index);
    }
    if (index == 14) usleep(10000);
    return index == 14 || index == 40 || index == 100 ? fail("index %d", index) : true;
}

static void the_failure_of_the_lowest_index_is_reported(void **state) {
    (void)state;
    for (int threads = 1; threads <= 8; threads++) {
        char text[16];
        snprintf(text, sizeof text, "%d", threads);
        setenv("SPLATLAB_THREADS", text, 1);
        fail_clear();
        assert_false(parallel_try(COUNT, fail_at_some, NULL));
        assert_string_equal(fail_text(), "index 13");
        assert_int_equal(fail_exit_code(), 2);
    }
    unsetenv("SPLATLAB_THREADS");
}

static bool succeed(void *context, int index) {
    count_visit(context, index);
    return true;
}

static void success_of_all_is_success(void **state) {
    (void)state;
    atomic_int visits[COUNT] = {0};
    assert_true(parallel_try(COUNT, succeed, visits));
    for (int i = 0; i < COUNT; i++) assert_int_equal(visits[i], 1);
}

static void the_number_of_threads_comes_from_the_environment_when_it_makes_sense(void **state) {
    (void)state;
    unsetenv("SPLATLAB_THREADS");
    int cores = parallel_threads();
    assert_true(cores >= 1);
    static const struct {
        const char *text;
        int threads; // 0: the machine's cores
    } cases[] = {{"1", 1}, {"7", 7}, {"256", 256}, {"257", 0}, {"0", 0}, {"-3", 0}, {"many", 0}, {"3x", 0}, {"", 0}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        setenv("SPLATLAB_THREADS", cases[i].text, 1);
        assert_int_equal(parallel_threads(), cases[i].threads ? cases[i].threads : cores);
    }
    unsetenv("SPLATLAB_THREADS");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_index_is_visited_once),
        cmocka_unit_test(the_failure_of_the_lowest_index_is_reported),
        cmocka_unit_test(success_of_all_is_success),
        cmocka_unit_test(the_number_of_threads_comes_from_the_environment_when_it_makes_sense),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
