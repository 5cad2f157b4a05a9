// log.c - whole lines to stderr, one at a time, never in the middle of a progress line.
#include "lab/base/log.h"

#include "lab/base/progress.h"

#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>

static bool quiet;
static pthread_mutex_t line_lock = PTHREAD_MUTEX_INITIALIZER;

void log_set_quiet(bool value) { quiet = value; }

bool log_is_quiet(void) { return quiet; }

static void print_line(const char *prefix, const char *format, va_list arguments) {
    pthread_mutex_lock(&line_lock);
    progress_leave_line();
    fputs(prefix, stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    pthread_mutex_unlock(&line_lock);
}

void log_info(const char *format, ...) {
    if (quiet) return;
    va_list arguments;
    va_start(arguments, format);
    print_line("", format, arguments);
    va_end(arguments);
}

void log_warn(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    print_line("warning: ", format, arguments);
    va_end(arguments);
}

void log_error(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    print_line("splatlab: ", format, arguments);
    va_end(arguments);
}
