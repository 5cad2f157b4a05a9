// options.c - one field of an options struct from text and back to text.
#include "lab/base/options.h"

#include "lab/base/fail.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char dash(char c) { return c == '_' ? '-' : c; }

static bool same_name(const char *a, const char *b) {
    while (*a && dash(*a) == dash(*b)) a++, b++;
    return *a == 0 && *b == 0;
}

const OptionField *option_find(const OptionTable *table, const char *name) {
    for (int i = 0; i < table->count; i++)
        if (same_name(table->fields[i].name, name)) return &table->fields[i];
    return NULL;
}

static void *field_of(const OptionField *field, void *options) { return (char *)options + field->offset; }

// " px" or "".
static const char *unit_text(const OptionField *field, char buffer[64]) {
    bool has_unit = field->unit && field->unit[0];
    snprintf(buffer, 64, "%s%s", has_unit ? " " : "", has_unit ? field->unit : "");
    return buffer;
}

static bool fail_range(const OptionField *field, const char *text) {
    char unit[64];
    return fail_usage("--%s %s: want %.15g to %.15g%s", field->name, text, field->low, field->high,
                      unit_text(field, unit));
}

static bool in_range(const OptionField *field, double value) { return value >= field->low && value <= field->high; }

static bool set_int(const OptionField *field, int *value, const char *text) {
    char *end;
    errno = 0;
    long parsed = strtol(text, &end, 10);
    if (end == text || *end != 0) return fail_usage("--%s %s: not a whole number", field->name, text);
    if (errno == ERANGE || parsed < INT_MIN || parsed > INT_MAX || !in_range(field, (double)parsed))
        return fail_range(field, text);
    *value = (int)parsed;
    return true;
}

static bool set_u64(const OptionField *field, uint64_t *value, const char *text) {
    char *end;
    errno = 0;
    unsigned long long parsed = strtoull(text, &end, 10);
    // strtoull takes "-1" for the largest number there is.
    if (end == text || *end != 0 || strchr(text, '-'))
        return fail_usage("--%s %s: not a whole number from 0", field->name, text);
    if (errno == ERANGE || !in_range(field, (double)parsed)) return fail_range(field, text);
    *value = parsed;
    return true;
}

static bool set_double(const OptionField *field, double *value, const char *text) {
    char *end;
    double parsed = strtod(text, &end);
    if (end == text || *end != 0 || !isfinite(parsed)) return fail_usage("--%s %s: not a number", field->name, text);
    if (!in_range(field, parsed)) return fail_range(field, text);
    *value = parsed;
    return true;
}

static bool set_flag(const OptionField *field, bool *value, const char *text) {
    bool yes = strcmp(text, "true") == 0;
    if (!yes && strcmp(text, "false") != 0) return fail_usage("--%s %s: want true or false", field->name, text);
    *value = yes;
    return true;
}

static bool set_text(const OptionField *field, char *value, const char *text) {
    size_t length = strlen(text);
    if (length >= OPTION_TEXT_BYTES)
        return fail_usage("--%s: %zu characters, at most %d are possible", field->name, length, OPTION_TEXT_BYTES - 1);
    memset(value, 0, OPTION_TEXT_BYTES); // the same text gives the same bytes
    memcpy(value, text, length);
    return true;
}

static bool set_choice(const OptionField *field, int *value, const char *text) {
    char known[512] = "";
    for (int i = 0; field->choices[i]; i++) {
        if (strcmp(field->choices[i], text) == 0) {
            *value = i;
            return true;
        }
        size_t length = strlen(known);
        snprintf(known + length, sizeof known - length, "%s%s", i ? ", " : "", field->choices[i]);
    }
    return fail_usage("--%s %s: want one of %s", field->name, text, known);
}

static bool set_size(const OptionField *field, int size[2], const char *text) {
    char *end;
    errno = 0;
    long width = strtol(text, &end, 10), height = 0;
    bool good = end != text && *end == 'x';
    if (good) {
        const char *second = end + 1;
        height = strtol(second, &end, 10);
        good = end != second && *end == 0;
    }
    if (!good) return fail_usage("--%s %s: want WxH, for example 640x480", field->name, text);
    if (errno == ERANGE || !in_range(field, (double)width) || !in_range(field, (double)height))
        return fail_range(field, text);
    size[0] = (int)width;
    size[1] = (int)height;
    return true;
}

bool option_set(const OptionField *field, void *options, const char *text) {
    void *value = field_of(field, options);
    switch (field->type) {
    case OPTION_INT:
        return set_int(field, value, text);
    case OPTION_U64:
        return set_u64(field, value, text);
    case OPTION_DOUBLE:
        return set_double(field, value, text);
    case OPTION_FLAG:
        return set_flag(field, value, text);
    case OPTION_TEXT:
        return set_text(field, value, text);
    case OPTION_CHOICE:
        return set_choice(field, value, text);
    case OPTION_SIZE:
        return set_size(field, value, text);
    }
    return fail("option %s has an unknown type %d", field->name, (int)field->type);
}

// The shortest decimal text that reads back to the same double.
static void double_text(double value, char *buffer, size_t size) {
    for (int digits = 6; digits <= 17; digits++) {
        snprintf(buffer, size, "%.*g", digits, value);
        if (strtod(buffer, NULL) == value) return;
    }
}

const char *option_text(const OptionField *field, const void *options, char *buffer, size_t size) {
    const void *value = (const char *)options + field->offset;
    switch (field->type) {
    case OPTION_INT:
        snprintf(buffer, size, "%d", *(const int *)value);
        break;
    case OPTION_U64:
        snprintf(buffer, size, "%llu", (unsigned long long)*(const uint64_t *)value);
        break;
    case OPTION_DOUBLE:
        double_text(*(const double *)value, buffer, size);
        break;
    case OPTION_FLAG:
        snprintf(buffer, size, "%s", *(const bool *)value ? "true" : "false");
        break;
    case OPTION_TEXT:
        snprintf(buffer, size, "%s", (const char *)value);
        break;
    case OPTION_CHOICE:
        snprintf(buffer, size, "%s", field->choices[*(const int *)value]);
        break;
    case OPTION_SIZE:
        snprintf(buffer, size, "%dx%d", ((const int *)value)[0], ((const int *)value)[1]);
        break;
    }
    return buffer;
}
