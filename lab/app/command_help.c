// command_help.c - the help text of one command.
#include "lab/app/command_help.h"

#include <stdio.h>
#include <string.h>

enum {
    LEFT_COLUMNS = 28, // "  -o, --output PATH"
    LINE_COLUMNS = 110
};

// What stands behind the option's name: "N", "WxH", "" for a flag.
static const char *placeholder(const OptionField *field) {
    switch (field->type) {
    case OPTION_INT:
    case OPTION_U64:
        return " N";
    case OPTION_DOUBLE:
        return " X";
    case OPTION_TEXT:
        return " TEXT";
    case OPTION_CHOICE:
        return " NAME";
    case OPTION_SIZE:
        return " WxH";
    case OPTION_FLAG:
        break;
    }
    return "";
}

// Adds to a text in a buffer; what does not fit is cut off.
static void append(char *buffer, size_t size, const char *separator, const char *more) {
    size_t length = strlen(buffer);
    snprintf(buffer + length, size - length, "%s%s", length ? separator : "", more);
}

// "steps, 1 to 10000000, default 7000"
static const char *facts(const OptionField *field, const void *defaults, char *buffer, size_t size) {
    char part[OPTION_TEXT_BYTES + 64], value[OPTION_TEXT_BYTES];
    buffer[0] = 0;
    if (field->unit && field->unit[0]) append(buffer, size, ", ", field->unit);
    bool has_range = field->type == OPTION_INT || field->type == OPTION_DOUBLE || field->type == OPTION_SIZE;
    if (has_range) {
        snprintf(part, sizeof part, "%.10g to %.10g", field->low, field->high);
        append(buffer, size, ", ", part);
    }
    for (int i = 0; field->type == OPTION_CHOICE && field->choices[i]; i++)
        append(buffer, size, i ? " | " : ", ", field->choices[i]);
    option_text(field, defaults, value, sizeof value);
    bool is_off = field->type == OPTION_FLAG && strcmp(value, "false") == 0;
    if (value[0] && !is_off) {
        snprintf(part, sizeof part, "default %s", field->type == OPTION_FLAG ? "on" : value);
        append(buffer, size, ", ", part);
    }
    return buffer;
}

// Prints words from column `at` on, and further lines from column `indent` on.
static void print_wrapped(const char *text, int at, int indent) {
    while (*text) {
        int word = (int)strcspn(text, " ");
        if (at > indent && at + 1 + word > LINE_COLUMNS) {
            printf("\n%*s", indent, "");
            at = indent;
        } else if (at > indent) {
            putchar(' ');
            at++;
        }
        printf("%.*s", word, text);
        at += word;
        text += word;
        text += strspn(text, " ");
    }
    putchar('\n');
}

static void print_left(const char *left) {
    int printed = printf("%s", left);
    if (printed < LEFT_COLUMNS)
        printf("%*s", LEFT_COLUMNS - printed, "");
    else
        printf("\n%*s", LEFT_COLUMNS, "");
}

static void print_option(const OptionField *field, const void *defaults) {
    char left[128], known[2 * OPTION_TEXT_BYTES], right[3 * OPTION_TEXT_BYTES];
    char letter[8] = "    ";
    if (field->letter) snprintf(letter, sizeof letter, "-%c, ", field->letter);
    snprintf(left, sizeof left, "  %s--%s%s", letter, field->name, placeholder(field));
    facts(field, defaults, known, sizeof known);
    snprintf(right, sizeof right, "%s%s%s%s", field->help, known[0] ? " (" : "", known, known[0] ? ")" : "");
    print_left(left);
    print_wrapped(right, LEFT_COLUMNS, LEFT_COLUMNS);
}

void command_help(const Command *command, const OptionTable *table) {
    printf("Usage: splatlab %s%s%s [OPTIONS]\n", command->name, command->arguments[0] ? " " : "", command->arguments);
    printf("\n%s\n", command->summary);
    for (int i = 0; i < table->count; i++) {
        const OptionField *field = &table->fields[i];
        if (i == 0 || field->section) printf("\n%s:\n", field->section ? field->section : "Options");
        print_option(field, table->defaults);
    }
    putchar('\n');
    print_left("  -h, --help");
    printf("this text\n");
    if (command->details) printf("\n%s\n", command->details);
}
