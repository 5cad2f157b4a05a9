// command.h - runs the built program as a person would: arguments in, exit code and both outputs back.
#ifndef SPLATLAB_TESTS_SUPPORT_COMMAND_H
#define SPLATLAB_TESTS_SUPPORT_COMMAND_H

typedef struct {
    int exit_code; // -1 when a signal ended it
    char *out;     // stdout, valid until the next call
    char *err;     // stderr, likewise
} CommandResult;

// The program is $SPLATLAB, else ./splatlab. Arguments end with NULL: command_run("info", path, NULL).
CommandResult command_run(const char *first, ...) __attribute__((sentinel));

// Fails the test, showing both outputs, unless the program ended with that exit code.
void command_expect(const CommandResult *result, int exit_code);

// Fails the test unless stderr is one line that begins with "splatlab: " and contains each of the texts (NULL at the end).
void command_expect_error(const CommandResult *result, int exit_code, ...) __attribute__((sentinel));

#endif
