#include "lab/base/log.h"
#include "lab/base/progress.h"
#include "tests/support/support.h"

#include <fcntl.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// Reads the far end of stderr while the body runs, so that a terminal's small buffer never fills up.
typedef struct {
    int descriptor;
    char said[65536];
    size_t length;
} Listener;

static void *listen_to(void *argument) {
    Listener *listener = argument;
    ssize_t got;
    while ((got = read(listener->descriptor, listener->said + listener->length,
                       sizeof listener->said - 1 - listener->length)) > 0)
        listener->length += (size_t)got;
    return NULL;
}

// What body() writes to stderr when that is a terminal, or a pipe.
static const char *stderr_of(void (*body)(void), bool terminal) {
    static Listener listener;
    memset(&listener, 0, sizeof listener);
    int near_end;
    if (terminal) {
        listener.descriptor = posix_openpt(O_RDWR | O_NOCTTY);
        grantpt(listener.descriptor);
        unlockpt(listener.descriptor);
        near_end = open(ptsname(listener.descriptor), O_RDWR | O_NOCTTY);
    } else {
        int ends[2];
        assert_int_equal(pipe(ends), 0);
        listener.descriptor = ends[0];
        near_end = ends[1];
    }
    int before = dup(STDERR_FILENO);
    dup2(near_end, STDERR_FILENO);
    close(near_end);
    pthread_t thread;
    pthread_create(&thread, NULL, listen_to, &listener);
    body();
    fflush(stderr);
    dup2(before, STDERR_FILENO); // closes the last near end: the listener comes to its end
    close(before);
    pthread_join(thread, NULL);
    close(listener.descriptor);
    return listener.said;
}

static void work_that_began(double seconds_ago, bool with_message) {
    Progress progress = progress_begin("render", 10, 50);
    progress.began_s -= seconds_ago;
    progress.printed_s -= seconds_ago;
    for (long done = 10; done < 50; done++) {
        progress_update(&progress, done, "psnr 27");
        if (with_message && done == 30) log_warn("odd");
    }
    progress_end(&progress, "40 frames");
}

static void long_work(void) { work_that_began(20, false); }
static void long_work_with_message(void) { work_that_began(20, true); }
static void short_work(void) { work_that_began(0, false); }

static int count(const char *text, const char *part) {
    int found = 0;
    for (const char *p = text; (p = strstr(p, part)); p++) found++;
    return found;
}

static void quiet_prints_nothing(void **state) {
    (void)state;
    log_set_quiet(true);
    assert_string_equal(stderr_of(long_work, true), "");
    assert_string_equal(stderr_of(long_work, false), "");
    log_set_quiet(false);
}

static void short_work_prints_nothing(void **state) {
    (void)state;
    assert_string_equal(stderr_of(short_work, true), "");
    assert_string_equal(stderr_of(short_work, false), "");
}

static void away_from_a_terminal_there_are_plain_lines(void **state) {
    (void)state;
    const char *said = stderr_of(long_work, false);
    assert_null(strchr(said, '\r'));
    assert_null(strchr(said, '\033'));
    assert_int_equal(count(said, "\n"), 2); // one update within ten seconds, one end
    assert_non_null(strstr(said, "render: 40 frames, done in 0:20\n"));
}

static void a_terminal_line_is_rewritten_and_ended(void **state) {
    (void)state;
    const char *said = stderr_of(long_work, true);
    assert_non_null(strstr(said, "\r\033[Krender 10/50 20%  psnr 27  0:20 gone"));
    assert_int_equal(count(said, "render 1"), 1); // the others came within a tenth of a second
    assert_int_equal(count(said, "\n"), 1);
}

static void a_message_gets_its_own_line(void **state) {
    (void)state;
    const char *said = stderr_of(long_work_with_message, true);
    assert_non_null(strstr(said, "gone\r\nwarning: odd\r\n")); // the terminal makes \r\n of \n
}

static void resumed_work_half_done(void) {
    Progress progress = progress_begin("train", 100, 300);
    progress.began_s -= 30;
    progress.printed_s -= 30;
    progress_update(&progress, 200, NULL); // 100 in 30 s: another 30 s to go
}

static void the_time_left_counts_only_what_this_run_did(void **state) {
    (void)state;
    assert_non_null(strstr(stderr_of(resumed_work_half_done, false), "train 200/300 66%  0:30 gone, 0:30 left\n"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quiet_prints_nothing),
        cmocka_unit_test(short_work_prints_nothing),
        cmocka_unit_test(away_from_a_terminal_there_are_plain_lines),
        cmocka_unit_test(a_terminal_line_is_rewritten_and_ended),
        cmocka_unit_test(a_message_gets_its_own_line),
        cmocka_unit_test(the_time_left_counts_only_what_this_run_did),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
