// json_io.c - Jansson, with errors that say where.
#include "lab/io/json_io.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *type_name(const json_t *value) {
    switch (json_typeof(value)) {
    case JSON_OBJECT:
        return "an object";
    case JSON_ARRAY:
        return "a list";
    case JSON_STRING:
        return "a text";
    case JSON_INTEGER:
    case JSON_REAL:
        return "a number";
    case JSON_TRUE:
    case JSON_FALSE:
        return "true or false";
    case JSON_NULL:
        break;
    }
    return "null";
}

// ---- files ----

// What wrote NaN or Infinity into a file had a fault of its own; the parser only says "invalid token".
static const char *parse_hint(const json_error_t *error, const char *rest) {
    bool not_finite = strstr(error->text, "NaN") || strstr(error->text, "nan") || strstr(error->text, "Inf") ||
                      strstr(error->text, "overflow") || strncmp(rest, "Inf", 3) == 0;
    return not_finite ? "JSON knows only finite numbers: what wrote the file had none to write"
                      : "is the file complete, and is it JSON?";
}

bool json_read(const char *path, json_t **root) {
    char *text;
    size_t size;
    *root = NULL;
    if (!file_read(path, &text, &size)) return false;
    size_t start = size >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0; // a byte order mark, as Windows writes it
    json_error_t error;
    *root = json_loadb(text + start, size - start, JSON_REJECT_DUPLICATES, &error);
    if (!*root) {
        size_t position = start + (error.position > 0 ? (size_t)error.position : 0);
        fail("cannot read %s, line %d, column %d: %s; %s", path, error.line, error.column, error.text,
             parse_hint(&error, text + (position < size ? position : size)));
    }
    mem_free(text);
    return *root != NULL;
}

bool json_write(const char *path, const json_t *root) {
    FileWriter writer;
    if (!file_begin(&writer, path)) return false;
    // A failed write is seen by file_commit().
    json_dumpf(root, writer.stream, JSON_INDENT(2) | JSON_ENCODE_ANY);
    fputc('\n', writer.stream);
    return file_commit(&writer);
}

void json_print(const json_t *root) {
    json_dumpf(root, stdout, JSON_INDENT(2) | JSON_ENCODE_ANY);
    putchar('\n');
}

// ---- values ----

static bool get(const json_t *object, const char *key, const char *where, json_t **value) {
    *value = NULL;
    if (!json_is_object(object)) return fail("%s: %s stands where an object is wanted", where, type_name(object));
    *value = json_object_get(object, key);
    return *value ? true : fail("%s: \"%s\" is missing", where, key);
}

static bool as_number(const json_t *value, const char *key, const char *where, double *number) {
    if (!json_is_number(value)) return fail("%s: \"%s\" is %s, want a number", where, key, type_name(value));
    *number = json_number_value(value);
    return isfinite(*number) ? true : fail("%s: \"%s\" is not finite", where, key);
}

bool json_has(const json_t *object, const char *key) { return json_object_get(object, key) != NULL; }

bool json_get_number(const json_t *object, const char *key, const char *where, double *value) {
    json_t *found;
    return get(object, key, where, &found) && as_number(found, key, where, value);
}

static bool read_list(const json_t *list, const char *key, const char *where, double *values, int count) {
    if (!json_is_array(list))
        return fail("%s: \"%s\" is %s, want a list of %d numbers", where, key, type_name(list), count);
    if (json_array_size(list) != (size_t)count)
        return fail("%s: \"%s\" has %zu entries, want %d", where, key, json_array_size(list), count);
    for (int i = 0; i < count; i++)
        if (!as_number(json_array_get(list, (size_t)i), key, where, &values[i]))
            return fail_context("entry %d of a list", i + 1);
    return true;
}

bool json_get_numbers(const json_t *object, const char *key, const char *where, double *values, int count) {
    json_t *found;
    return get(object, key, where, &found) && read_list(found, key, where, values, count);
}

bool json_get_text(const json_t *object, const char *key, const char *where, const char **text) {
    json_t *found;
    if (!get(object, key, where, &found)) return false;
    if (!json_is_string(found)) return fail("%s: \"%s\" is %s, want a text", where, key, type_name(found));
    *text = json_string_value(found);
    return true;
}

json_t *json_text(const char *text) {
    json_t *value = json_string(text);
    if (value) return value;
    char *ascii = mem_text(text);
    for (char *c = ascii; *c; c++)
        if ((unsigned char)*c >= 128) *c = '?';
    value = json_string(ascii);
    mem_free(ascii);
    return value;
}

bool json_get_matrix4(const json_t *object, const char *key, const char *where, double values[16]) {
    json_t *found;
    if (!get(object, key, where, &found)) return false;
    if (!json_is_array(found) || json_array_size(found) != 4) return read_list(found, key, where, values, 16);
    for (int row = 0; row < 4; row++)
        if (!read_list(json_array_get(found, (size_t)row), key, where, values + 4 * row, 4))
            return fail_context("row %d of a matrix", row + 1);
    return true;
}

// ---- options ----

// "max-splats" -> "max_splats".
static void json_key(const OptionField *field, char key[64]) {
    snprintf(key, 64, "%s", field->name);
    for (char *c = key; *c; c++)
        if (*c == '-') *c = '_';
}

static json_t *option_value(const OptionField *field, const void *options) {
    const char *at = (const char *)options + field->offset;
    char text[OPTION_TEXT_BYTES + 64];
    switch (field->type) {
    case OPTION_INT:
        return json_integer(*(const int *)at);
    case OPTION_DOUBLE:
        return json_real(*(const double *)at);
    case OPTION_FLAG:
        return json_boolean(*(const bool *)at);
    case OPTION_U64:
        if (*(const uint64_t *)at <= INT64_MAX) return json_integer((json_int_t) * (const uint64_t *)at);
        break; // too large for JSON's integers: as text
    case OPTION_TEXT:
    case OPTION_CHOICE:
    case OPTION_SIZE:
        break;
    }
    return json_text(option_text(field, options, text, sizeof text));
}

json_t *json_from_options(const OptionTable *table, const void *options) {
    json_t *object = json_object();
    for (int i = 0; i < table->count; i++) {
        char key[64];
        json_key(&table->fields[i], key);
        json_t *value = option_value(&table->fields[i], options);
        assert(value); // only a number that is not finite has none, and option_set() lets none in
        json_object_set_new(object, key, value);
    }
    return object;
}

// The text that the command line would give for this value; false when the type is not the field's.
static bool option_value_text(const OptionField *field, const json_t *value, char *text, size_t size) {
    bool integer = json_is_integer(value);
    bool whole = field->type == OPTION_INT || field->type == OPTION_U64;
    bool written = field->type == OPTION_TEXT || field->type == OPTION_CHOICE || field->type == OPTION_SIZE ||
                   field->type == OPTION_U64;
    if (integer && (whole || field->type == OPTION_DOUBLE))
        snprintf(text, size, "%lld", (long long)json_integer_value(value));
    else if (json_is_real(value) && field->type == OPTION_DOUBLE)
        snprintf(text, size, "%.17g", json_real_value(value));
    else if (json_is_string(value) && written)
        snprintf(text, size, "%s", json_string_value(value));
    else
        return false;
    return true;
}

static bool set_option(const OptionField *field, const char *key, const json_t *value, const char *where,
                       void *options) {
    if (field->type == OPTION_FLAG && json_is_boolean(value)) {
        *(bool *)((char *)options + field->offset) = json_is_true(value);
        return true;
    }
    char text[2 * OPTION_TEXT_BYTES];
    if (!option_value_text(field, value, text, sizeof text))
        return fail("%s: \"%s\" is %s, which does not fit this option", where, key, type_name(value));
    if (option_set(field, options, text)) return true;
    char *reason = mem_text(fail_text()); // a wrong file is a failure (exit code 1), not wrong usage
    fail("%s: %s", where, reason);
    mem_free(reason);
    return false;
}

bool json_to_options(const json_t *object, const OptionTable *table, const char *where, void *options) {
    if (!json_is_object(object)) return fail("%s: %s stands where an object is wanted", where, type_name(object));
    const char *key;
    json_t *value;
    json_object_foreach((json_t *)object, key, value) {
        const OptionField *field = option_find(table, key);
        if (!field) return fail("%s: there is no option \"%s\"; was it written by another version?", where, key);
        if (!set_option(field, key, value, where, options)) return false;
    }
    return true;
}
