// progress.c - the progress line: when to print it, and the time that is left.
#include "lab/base/progress.h"

#include "lab/base/clock.h"
#include "lab/base/log.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <unistd.h>

static const double SILENT_S = 0.5;         // work shorter than this prints nothing
static const double TERMINAL_EVERY_S = 0.1; // between two lines on a terminal
static const double PLAIN_EVERY_S = 10;     // and elsewhere

static bool line_stands; // an unfinished line stands on the terminal

void progress_leave_line(void) {
    if (line_stands) fputc('\n', stderr);
    line_stands = false;
}

Progress progress_begin(const char *what, long start, long total) {
    double now = clock_seconds();
    return (Progress){.what = what, .total = total, .start = start, .began_s = now, .printed_s = now};
}

// "1:02:03" or "4:05".
static void time_text(double seconds, char *buffer, size_t size) {
    long whole = lround(seconds);
    long hours = whole / 3600, minutes = whole / 60 % 60;
    if (hours)
        snprintf(buffer, size, "%ld:%02ld:%02ld", hours, minutes, whole % 60);
    else
        snprintf(buffer, size, "%ld:%02ld", minutes, whole % 60);
}

// "train 1200/7000 17%  loss 0.03  0:12 gone, 0:58 left"
static void line_text(const Progress *progress, long done, const char *note, char *buffer, size_t size) {
    double gone_s = clock_seconds() - progress->began_s;
    char gone[32], left[64] = "";
    time_text(gone_s, gone, sizeof gone);
    long worked = done - progress->start;
    if (worked > 0 && done < progress->total) {
        char time[32];
        time_text(gone_s / (double)worked * (double)(progress->total - done), time, sizeof time);
        snprintf(left, sizeof left, ", %s left", time);
    }
    long percent = progress->total > 0 ? 100 * done / progress->total : 100;
    snprintf(buffer, size, "%s %ld/%ld %ld%%  %s%s%s gone%s", progress->what, done, progress->total, percent,
             note ? note : "", note ? "  " : "", gone, left);
}

void progress_update(Progress *progress, long done, const char *note) {
    if (log_is_quiet()) return;
    bool terminal = isatty(STDERR_FILENO);
    double now = clock_seconds();
    double every_s = terminal ? TERMINAL_EVERY_S : PLAIN_EVERY_S;
    if (now - progress->began_s < SILENT_S || now - progress->printed_s < every_s) return;
    char line[512];
    line_text(progress, done, note, line, sizeof line);
    progress->printed_s = now;
    if (!terminal) {
        fprintf(stderr, "%s\n", line);
        return;
    }
    fprintf(stderr, "\r\033[K%s", line); // back to the first column, erase, write
    fflush(stderr);
    line_stands = true;
}

void progress_end(Progress *progress, const char *note) {
    double gone_s = clock_seconds() - progress->began_s;
    if (log_is_quiet() || gone_s < SILENT_S) return;
    char gone[32];
    time_text(gone_s, gone, sizeof gone);
    fprintf(stderr, "%s%s: %s%sdone in %s\n", line_stands ? "\r\033[K" : "", progress->what, note ? note : "",
            note ? ", " : "", gone);
    line_stands = false;
}
