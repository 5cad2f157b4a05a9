#include "lab/base/clock.h"
#include "tests/support/support.h"

#include <unistd.h>

static void the_clock_runs_forward_in_seconds(void **state) {
    (void)state;
    double before = clock_seconds();
    usleep(20000);
    double passed = clock_seconds() - before;
    assert_true(passed >= 0.02 && passed < 10);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_clock_runs_forward_in_seconds)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
