#include "lab/base/interrupt.h"
#include "tests/support/support.h"

#include <signal.h>
#include <stdbool.h>
#include <sys/wait.h>
#include <unistd.h>

static void a_signal_is_noted_and_a_new_installation_forgets_it(void **state) {
    (void)state;
    interrupt_install();
    assert_false(interrupt_requested());
    raise(SIGINT);
    assert_true(interrupt_requested());
    interrupt_install();
    assert_false(interrupt_requested());
    raise(SIGTERM);
    raise(SIGTERM); // as often as a service manager likes
    assert_true(interrupt_requested());
}

static void a_second_ctrl_c_ends_the_program(void **state) {
    (void)state;
    pid_t child = fork();
    if (child == 0) {
        interrupt_install();
        raise(SIGINT);
        raise(SIGINT);
        _exit(0);
    }
    int status;
    waitpid(child, &status, 0);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 130);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_signal_is_noted_and_a_new_installation_forgets_it),
        cmocka_unit_test(a_second_ctrl_c_ends_the_program),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
