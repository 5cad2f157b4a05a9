// options.h - one table per options struct: it feeds the command line, --help, the run's log and, later, sliders.
//
// An options struct is a plain struct of double, int, bool, text and enumerations. Its table names each field once:
// name, type, offset, range, unit, help. Defaults come from the struct that xxx_options_default() returns, so they
// stand in one place. Zero is a value, never "default".
#ifndef SPLATLAB_LAB_BASE_OPTIONS_H
#define SPLATLAB_LAB_BASE_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum {
    OPTION_INT,    // int
    OPTION_U64,    // uint64_t
    OPTION_DOUBLE, // double
    OPTION_FLAG,   // bool; on the command line a bare --name or --no-name
    OPTION_TEXT,   // char[OPTION_TEXT_BYTES], a path or a name
    OPTION_CHOICE, // int, an index into `choices`
    OPTION_SIZE,   // int[2], written WxH
} OptionType;

enum { OPTION_TEXT_BYTES = 1024 };

typedef struct {
    const char *name; // "max-splats": the command line's --max-splats, JSON's "max_splats"
    char letter;      // 'o' for -o, or 0
    OptionType type;
    size_t offset;              // offsetof(struct, field)
    double low, high;           // allowed range of numbers, both ends included
    const char *unit;           // "px", "iterations", "" ; shown in --help
    const char *const *choices; // OPTION_CHOICE: NULL-terminated names
    const char *help;           // one line, without the default (which is added)
    const char *section;        // heading under which --help shows it from here on; NULL: as the one before
} OptionField;

// The table of one options struct; `defaults` points to a struct of that type holding the defaults.
typedef struct {
    const OptionField *fields;
    int count;
    const void *defaults;
} OptionTable;

// The field of that name ('-' and '_' are the same), or NULL.
const OptionField *option_find(const OptionTable *table, const char *name);

// Parses text into the field of *options. Fails (fail_usage) with name, text, range and unit.
bool option_set(const OptionField *field, void *options, const char *text);

// Writes the value as text, such that option_set() reads it back to the same bytes; returns buffer.
const char *option_text(const OptionField *field, const void *options, char *buffer, size_t size);

#endif
