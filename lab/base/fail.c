// fail.c - the message of the last failure, one per thread.
#include "lab/base/fail.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

// Long enough for a compiler's log, which one failure may carry.
enum { FAIL_TEXT_BYTES = 16384 };

static _Thread_local char text[FAIL_TEXT_BYTES];
static _Thread_local int exit_code = 1;

// The arguments may point into `text` (a caller that quotes fail_text()), so the new text is made beside it first.
static void record(const char *format, va_list arguments) {
    static _Thread_local char fresh[FAIL_TEXT_BYTES];
    vsnprintf(fresh, sizeof fresh, format, arguments);
    memcpy(text, fresh, strlen(fresh) + 1);
}

bool fail(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    record(format, arguments);
    va_end(arguments);
    exit_code = 1;
    return false;
}

bool fail_usage(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    record(format, arguments);
    va_end(arguments);
    exit_code = 2;
    return false;
}

// What does not fit any more is cut off.
static void append(const char *more) {
    size_t length = strlen(text), room = sizeof text - 1 - length, added = strlen(more);
    if (added > room) added = room;
    memcpy(text + length, more, added);
    text[length + added] = 0;
}

bool fail_context(const char *format, ...) {
    static _Thread_local char before[FAIL_TEXT_BYTES];
    memcpy(before, text, strlen(text) + 1);
    va_list arguments;
    va_start(arguments, format);
    record(format, arguments);
    va_end(arguments);
    append(": ");
    append(before);
    return false;
}

const char *fail_text(void) { return text; }

int fail_exit_code(void) { return exit_code; }

void fail_clear(void) {
    text[0] = 0;
    exit_code = 1;
}
