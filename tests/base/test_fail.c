#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "tests/support/support.h"

#include <pthread.h>
#include <stdbool.h>
#include <string.h>

// cmocka's macro of the same name hides ours.
#undef fail

static void a_failure_is_false_and_keeps_its_text(void **state) {
    (void)state;
    fail_clear();
    assert_string_equal(fail_text(), "");
    assert_false(fail("cannot read %s, line %d", "a.ply", 7));
    assert_string_equal(fail_text(), "cannot read a.ply, line 7");
    assert_int_equal(fail_exit_code(), 1);
}

static void context_stands_before_the_message_and_keeps_the_exit_code(void **state) {
    (void)state;
    fail_usage("want %d", 3);
    assert_false(fail_context("frame %d", 12));
    assert_string_equal(fail_text(), "frame 12: want 3");
    assert_int_equal(fail_exit_code(), 2);
    fail("other");
    assert_int_equal(fail_exit_code(), 1);
}

static void a_message_may_quote_the_one_before(void **state) {
    (void)state;
    fail("inner");
    fail("outer (%s)", fail_text());
    assert_string_equal(fail_text(), "outer (inner)");
}

static void a_very_long_message_is_cut_not_overrun(void **state) {
    (void)state;
    char *text = mem_alloc(100001, 1);
    memset(text, 'x', 100000);
    fail("%s", text);
    size_t length = strlen(fail_text());
    assert_true(length > 1000 && length < 100000);
    fail_context("%s", text);
    assert_int_equal(strlen(fail_text()), length);
    mem_free(text);
}

static void *fail_elsewhere(void *unused) {
    (void)unused;
    fail("of the other thread");
    return NULL;
}

static void each_thread_has_its_own_message(void **state) {
    (void)state;
    fail("mine");
    pthread_t thread;
    assert_int_equal(pthread_create(&thread, NULL, fail_elsewhere, NULL), 0);
    pthread_join(thread, NULL);
    assert_string_equal(fail_text(), "mine");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_failure_is_false_and_keeps_its_text),
        cmocka_unit_test(context_stands_before_the_message_and_keeps_the_exit_code),
        cmocka_unit_test(a_message_may_quote_the_one_before),
        cmocka_unit_test(a_very_long_message_is_cut_not_overrun),
        cmocka_unit_test(each_thread_has_its_own_message),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
