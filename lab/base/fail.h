// fail.h - how a function says that the world did not do what was asked.
//
// A function that can fail returns bool and, where the cause is known, ends with
//     return fail("cannot read %s, line %d: %d fields, want 8; is this a COLMAP file?", path, line, n);
// Its callers return false and add at most one line of context. The command line prints fail_text() once.
// The text names what failed, which object, the values, and ends with a hint: the next action of the person.
#ifndef SPLATLAB_LAB_BASE_FAIL_H
#define SPLATLAB_LAB_BASE_FAIL_H

#include <stdbool.h>

// Records the message (printf style, one line, no newline at its end) for this thread and returns false.
bool fail(const char *format, ...) __attribute__((format(printf, 1, 2)));

// As fail(), for wrong usage: the exit code of the program becomes 2 instead of 1.
bool fail_usage(const char *format, ...) __attribute__((format(printf, 1, 2)));

// Puts "context: " before the message that is already recorded and returns false.
bool fail_context(const char *format, ...) __attribute__((format(printf, 1, 2)));

// The message recorded last on this thread; "" when there is none. Valid until the next call of this file.
const char *fail_text(void);

// 2 when the last failure was fail_usage(), else 1.
int fail_exit_code(void);

// Forgets the recorded message.
void fail_clear(void);

#endif
