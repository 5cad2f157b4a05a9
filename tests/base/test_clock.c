#include "lab/base/clock.h"
#include "tests/support/support.h"

#include <math.h>
#include <unistd.h>

static void the_clock_runs_forward_in_seconds(void **state) {
    (void)state;
    double before = clock_seconds();
    usleep(20000);
    double passed = clock_seconds() - before;
    assert_true(passed >= 0.02 && passed < 10);
}

static void time_asleep_is_no_cpu_time(void **state) {
    (void)state;
    double before = clock_cpu_seconds();
    usleep(50000);
    assert_true(clock_cpu_seconds() - before < 0.04);
    double began = clock_seconds(), worked = clock_cpu_seconds();
    while (clock_cpu_seconds() < worked + 0.01 && clock_seconds() < began + 5) {}
    assert_true(clock_cpu_seconds() - worked >= 0.01);
}

static void a_process_is_as_old_as_its_start_says(void **state) {
    (void)state;
    double young = clock_process_age_seconds(), before = clock_seconds();
    assert_true(young > -0.02 && young < 60); // the start is rounded to a tick
    usleep(100000);
    double passed = clock_seconds() - before;
    assert_true(fabs(clock_process_age_seconds() - young - passed) < 0.02);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_clock_runs_forward_in_seconds),
        cmocka_unit_test(time_asleep_is_no_cpu_time),
        cmocka_unit_test(a_process_is_as_old_as_its_start_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
