// facts_print.c - a JSON object as lines for the eye.
#include "lab/app/facts.h"

#include <stdio.h>
#include <string.h>

enum { NAME_COLUMNS = 26 };

static bool is_bytes(const char *key) {
    size_t length = strlen(key), ending = strlen("_bytes");
    return length > ending && strcmp(key + length - ending, "_bytes") == 0;
}

// "held_out" -> "held out", after the indentation of its depth; returns the columns used.
static int print_name(const char *key, int depth) {
    int printed = printf("%*s", 2 * depth, "");
    for (const char *c = key; *c; c++, printed++) putchar(*c == '_' ? ' ' : *c);
    return printed;
}

static void print_value(const char *key, const json_t *value) {
    if (json_is_integer(value) && is_bytes(key) && json_integer_value(value) >= 1 << 20)
        printf("%lld (%.1f MiB)", (long long)json_integer_value(value),
               (double)json_integer_value(value) / (double)(1 << 20));
    else if (json_is_integer(value))
        printf("%lld", (long long)json_integer_value(value));
    else if (json_is_real(value))
        printf("%.6g", json_real_value(value));
    else if (json_is_boolean(value))
        printf("%s", json_is_true(value) ? "yes" : "no");
    else if (json_is_string(value))
        printf("%s", json_string_value(value));
    for (size_t i = 0; i < json_array_size(value); i++) {
        if (i) putchar(' ');
        print_value(key, json_array_get(value, i));
    }
}

static void print_object(const json_t *object, int depth) {
    const char *key;
    json_t *value;
    json_object_foreach((json_t *)object, key, value) {
        int printed = print_name(key, depth);
        if (json_is_object(value)) {
            putchar('\n');
            print_object(value, depth + 1);
        } else {
            printf("%*s", printed < NAME_COLUMNS ? NAME_COLUMNS - printed : 1, "");
            print_value(key, value);
            putchar('\n');
        }
    }
}

void facts_print(const json_t *object) { print_object(object, 0); }
