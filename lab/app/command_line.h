// command_line.h - from argv to an options struct, by popt and the struct's option table; --help comes from the same table.
#ifndef SPLATLAB_LAB_APP_COMMAND_LINE_H
#define SPLATLAB_LAB_APP_COMMAND_LINE_H

#include "lab/base/options.h"

#include <stdbool.h>

// The options that many commands have, as the beginning of a field of their tables: T is the command's options struct, with
// members of these names. `{OPTION_DEVICE_OF(Options), .section = "Device"}`.
#define OPTION_DEVICE_OF(T)                                                                                            \
    .name = "device", .type = OPTION_TEXT, .offset = offsetof(T, device),                                              \
    .help = "auto, cpu, gpu, a number or a part of a name of `splatlab devices`"
#define OPTION_KERNELS_OF(T)                                                                                           \
    .name = "kernels", .type = OPTION_TEXT, .offset = offsetof(T, kernels),                                            \
    .help = "folder of the OpenCL kernels, when not those beside the program"
#define OPTION_QUIET_OF(T)                                                                                             \
    .name = "quiet", .letter = 'q', .type = OPTION_FLAG, .offset = offsetof(T, quiet),                                 \
    .help = "no progress, only warnings and errors"
#define OPTION_JSON_OF(T, WHAT)                                                                                        \
    .name = "json", .type = OPTION_FLAG, .offset = offsetof(T, json), .help = WHAT " as one JSON document on stdout"

typedef struct {
    const char *name;                  // "train"
    const char *arguments;             // "SCENE -o RUN"; as --help shows it
    const char *summary;               // one line
    const char *details;               // paragraphs and examples for --help, or NULL
    int (*run)(int argc, char **argv); // argv[0] is the command's name; returns the exit code
} Command;

// Parses; *options must hold the defaults beforehand. Arguments that are no options go to positional[0..max-1] (borrowed from argv), their number to
// *count. Returns false when the command is over: *exit_code is 0 after --help, 2 after wrong usage (message printed, with the nearest known option).
bool command_line_parse(const Command *command, const OptionTable *table, int argc, char **argv, void *options,
                        const char **positional, int max, int *count, int *exit_code);

// Prints fail_text() as an error and returns fail_exit_code(): `return command_failed();`
int command_failed(void);

#endif
