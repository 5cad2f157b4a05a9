#include "lab/base/nearest.h"
#include "tests/support/support.h"

static void edits_are_counted(void **state) {
    (void)state;
    assert_int_equal(nearest_distance("", ""), 0);
    assert_int_equal(nearest_distance("train", "train"), 0);
    assert_int_equal(nearest_distance("Train", "tRAIN"), 0);
    assert_int_equal(nearest_distance("trian", "train"), 1);  // swapped
    assert_int_equal(nearest_distance("tran", "train"), 1);   // missing
    assert_int_equal(nearest_distance("traain", "train"), 1); // too much
    assert_int_equal(nearest_distance("trein", "train"), 1);  // another
    assert_int_equal(nearest_distance("kitten", "sitting"), 3);
    assert_int_equal(nearest_distance("abc", ""), 3);
    assert_int_equal(nearest_distance("", "abc"), 3);
    assert_int_equal(nearest_distance("iter", "iterations"), 1); // the beginning of it
}

static const char *const NAMES[] = {"train", "eval", "render", "trail", "info"};

static void the_nearest_come_first(void **state) {
    (void)state;
    int best[5];
    assert_int_equal(nearest_find("trail", NAMES, 5, best, 5), 2);
    assert_int_equal(best[0], 3);
    assert_int_equal(best[1], 0);
    assert_int_equal(nearest_find("trai", NAMES, 5, best, 1), 1);
    assert_int_equal(best[0], 0); // as near as "trail", but earlier
}

static void nothing_is_near_to_something_else(void **state) {
    (void)state;
    int best[5];
    assert_int_equal(nearest_find("zzzzzz", NAMES, 5, best, 5), 0);
    assert_int_equal(nearest_find("", NAMES, 5, best, 5), 0);
    char huge[1000];
    for (int i = 0; i < 999; i++) huge[i] = 'a';
    huge[999] = 0;
    const char *names[] = {huge};
    nearest_find(huge, names, 1, best, 5); // must not overrun its table
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edits_are_counted),
        cmocka_unit_test(the_nearest_come_first),
        cmocka_unit_test(nothing_is_near_to_something_else),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
