// test_exercise_watch.c - `splatlab exercise watch` on a pseudo-terminal: saves of every kind, keys, Ctrl-C, and the terminal as it
// was; and without a terminal.
#include "lab/base/clock.h"
#include "lab/base/mem.h"
#include "tests/support/exercise_files.h"
#include "tests/support/support.h"

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

static const char *root;
static pid_t watcher;
static int terminal; // our end, or that of a pipe
static char seen[1 << 18];
static size_t seen_bytes;
static const double WAIT_S = 30;

static const char *program(void) {
    const char *path = getenv("SPLATLAB");
    return path ? path : "./splatlab";
}

static void start(const char *number) {
    root = exercise_files_fresh();
    struct winsize size = {.ws_row = 40, .ws_col = 80};
    seen_bytes = 0;
    setenv("TERM", "xterm", 1);
    watcher = forkpty(&terminal, NULL, NULL, &size);
    if (watcher == 0) {
        execl(program(), program(), "exercise", "watch", number, (char *)NULL);
        _exit(127);
    }
    fcntl(terminal, F_SETFL, O_NONBLOCK);
}

static void read_more(void) {
    struct pollfd fd = {terminal, POLLIN, 0};
    poll(&fd, 1, 50);
    ssize_t got = read(terminal, seen + seen_bytes, sizeof seen - 1 - seen_bytes);
    if (got > 0) seen_bytes += (size_t)got;
    seen[seen_bytes] = 0;
}

// Waits until the text appears behind what was seen before, and forgets all up to it.
static void await(const char *text) {
    double until_s = clock_seconds() + WAIT_S;
    for (;;) {
        char *found = strstr(seen, text);
        if (found) {
            size_t rest = strlen(found + strlen(text));
            memmove(seen, found + strlen(text), rest + 1);
            seen_bytes = rest;
            return;
        }
        if (clock_seconds() > until_s) fail_msg("'%s' does not appear in\n%s", text, seen);
        read_more();
    }
}

static void press(const char *keys) { assert_int_equal(write(terminal, keys, strlen(keys)), (ssize_t)strlen(keys)); }

static int stop(void **state) {
    (void)state;
    if (watcher > 0) {
        kill(watcher, SIGKILL);
        waitpid(watcher, NULL, 0);
        close(terminal);
    }
    watcher = 0;
    return 0;
}

static void await_end(int exit_code) {
    int status = 0;
    double until_s = clock_seconds() + WAIT_S;
    while (waitpid(watcher, &status, WNOHANG) == 0 && clock_seconds() < until_s) read_more();
    watcher = 0;
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), exit_code);
}

static void is_as_before(void) {
    struct termios now;
    assert_int_equal(tcgetattr(terminal, &now), 0);
    assert_true((now.c_lflag & ICANON) && (now.c_lflag & ECHO));
}

static void a_save_is_seen_and_keys_lead_on(void **state) {
    (void)state;
    start("1");
    await("not started yet");
    await("[q]uit");
    exercise_files_copy("01_cov2/mutants/degrees.c", "01_cov2/cov2.c"); // written beside and renamed
    await("the angle is taken for");
    await("[q]uit");
    FILE *out = fopen(support_path(root, "01_cov2/cov2.c"), "w"); // written in place
    fputs("oops\n", out);
    fclose(out);
    await("does not compile yet");
    await("[q]uit");
    exercise_files_copy("solutions/cov2.c", "01_cov2/cov2.c");
    await("passed");
    await("key n: E");
    press("h");
    await("(hint 1 of 4)");
    press("h");
    await("(hint 2 of 4)");
    press("r");
    await("passed");
    await("[q]uit");
    press("p");
    await("this is the first exercise");
    press("s");
    await("pictures: ");
    press("q");
    await_end(0);
    is_as_before();
    close(terminal);
}

static void the_next_one_follows_and_the_first_open_one_begins(void **state) {
    (void)state;
    start("1");
    await("not started yet");
    await("[q]uit");
    press("n");
    await("not started yet");
    await("watching ");
    assert_non_null(strstr(exercise_files_text("progress.json"), "01_cov2"));
    press("p");
    await("watching 01_cov2");
    press("\003"); // Ctrl-C
    await_end(0);
    is_as_before();
    close(terminal);
}

static void without_a_terminal_each_verdict_is_printed(void **state) {
    (void)state;
    root = exercise_files_fresh();
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    seen_bytes = 0;
    seen[0] = 0;
    unsetenv("DISPLAY");
    watcher = fork();
    if (watcher == 0) {
        dup2(open("/dev/null", O_RDONLY), 0);
        dup2(ends[1], 1);
        close(ends[0]);
        execl(program(), program(), "exercise", "watch", (char *)NULL);
        _exit(127);
    }
    close(ends[1]);
    terminal = ends[0];
    fcntl(terminal, F_SETFL, O_NONBLOCK);
    await("not started yet");
    usleep(300000);
    exercise_files_copy("solutions/cov2.c", "01_cov2/cov2.c");
    await("passed");
    assert_null(strchr(seen, '\033'));
    kill(watcher, SIGTERM);
    await_end(0);
    close(terminal);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_save_is_seen_and_keys_lead_on, stop),
        cmocka_unit_test_teardown(the_next_one_follows_and_the_first_open_one_begins, stop),
        cmocka_unit_test_teardown(without_a_terminal_each_verdict_is_printed, stop),
    };
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
