// log.h - messages for the person, on stderr; results go to stdout and never through here.
#ifndef SPLATLAB_LAB_BASE_LOG_H
#define SPLATLAB_LAB_BASE_LOG_H

#include <stdbool.h>

// With quiet, log_info and the progress line print nothing; warnings and errors are still shown.
void log_set_quiet(bool quiet);
bool log_is_quiet(void);

// One line each; the newline is added. They first finish a progress line that stands on the terminal.
void log_info(const char *format, ...) __attribute__((format(printf, 1, 2)));
void log_warn(const char *format, ...) __attribute__((format(printf, 1, 2)));  // "warning: ..."
void log_error(const char *format, ...) __attribute__((format(printf, 1, 2))); // "splatlab: ..."

#endif
