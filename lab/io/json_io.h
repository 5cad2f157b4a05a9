// json_io.h - JSON files and documents, by Jansson, with errors that name file, line and field.
#ifndef SPLATLAB_LAB_IO_JSON_IO_H
#define SPLATLAB_LAB_IO_JSON_IO_H

#include "lab/base/options.h"

#include <jansson.h>
#include <stdbool.h>

// Parses the file; *root is owned by the caller (json_decref). Errors give line and column.
bool json_read(const char *path, json_t **root);

// Writes indented text to the path, atomically.
bool json_write(const char *path, const json_t *root);

// One document to stdout, with a newline: the answer to --json.
void json_print(const json_t *root);

// A finite number (or an array of `count` finite numbers) under `key`. `where` names the object in the error,
// e.g. "transforms.json, frame 12". A missing key fails too; json_has() asks beforehand.
bool json_get_number(const json_t *object, const char *key, const char *where, double *value);
bool json_get_numbers(const json_t *object, const char *key, const char *where, double *values, int count);
bool json_get_text(const json_t *object, const char *key, const char *where, const char **text); // borrowed from object
bool json_has(const json_t *object, const char *key);

// A text for JSON, which holds UTF-8 only: where a path is not, what is no ASCII becomes '?'. Never NULL.
json_t *json_text(const char *text);

// A 4x4 matrix as nested rows ([[..4..] x 4]) or as 16 numbers in a row, row-major.
bool json_get_matrix4(const json_t *object, const char *key, const char *where, double values[16]);

// An options struct as an object and back, by its table; unknown keys and wrong types fail with the key's name.
json_t *json_from_options(const OptionTable *table, const void *options);
bool json_to_options(const json_t *object, const OptionTable *table, const char *where, void *options);

#endif
