// command_line.c - the options struct filled by popt; popt knows each option's name and whether a value follows, the
// table parses the value.
#include "lab/app/command_line.h"

#include "lab/app/command_help.h"
#include "lab/base/fail.h"
#include "lab/base/log.h"
#include "lab/base/mem.h"
#include "lab/base/nearest.h"

#include <popt.h>
#include <stdlib.h>
#include <string.h>

// popt returns these numbers: two for each field (--name, and --no-name of a flag), then --help.
enum { VAL_FIRST = 1, VALS_PER_FIELD = 2 };

static int help_val(const OptionTable *table) { return VAL_FIRST + VALS_PER_FIELD * table->count; }

// What popt is told: one entry per name. The texts "no-..." are owned by the caller, free_entries().
static struct poptOption *make_entries(const OptionTable *table) {
    size_t most = (size_t)(VALS_PER_FIELD * table->count) + 2; // --help, and the end
    struct poptOption *entries = mem_alloc(most, sizeof *entries);
    struct poptOption *next = entries;
    for (int i = 0; i < table->count; i++) {
        const OptionField *field = &table->fields[i];
        bool is_flag = field->type == OPTION_FLAG;
        *next++ = (struct poptOption){.longName = mem_text(field->name),
                                      .shortName = field->letter,
                                      .argInfo = is_flag ? POPT_ARG_NONE : POPT_ARG_STRING,
                                      .val = VAL_FIRST + VALS_PER_FIELD * i};
        if (is_flag)
            *next++ = (struct poptOption){.longName = mem_format("no-%s", field->name),
                                          .argInfo = POPT_ARG_NONE,
                                          .val = VAL_FIRST + VALS_PER_FIELD * i + 1};
    }
    *next = (struct poptOption){
        .longName = mem_text("help"), .shortName = 'h', .argInfo = POPT_ARG_NONE, .val = help_val(table)};
    return entries;
}

static void free_entries(struct poptOption *entries) {
    for (struct poptOption *e = entries; e->longName; e++) mem_free((void *)e->longName);
    mem_free(entries);
}

static bool fail_unknown(const char *text, const struct poptOption *entries) {
    int count = 0;
    while (entries[count].longName) count++;
    const char **names = mem_alloc((size_t)count, sizeof *names);
    for (int i = 0; i < count; i++) names[i] = entries[i].longName;
    const char *bare = text + strspn(text, "-");
    int best;
    bool near = strlen(bare) > 1 && nearest_find(bare, names, count, &best, 1) == 1;
    if (near)
        fail_usage("there is no option %s; did you mean --%s?", text, names[best]);
    else
        fail_usage("there is no option %s; --help lists them", text);
    mem_free(names);
    return false;
}

static bool fail_popt(poptContext context, int code, const struct poptOption *entries) {
    const char *text = poptBadOption(context, POPT_BADOPTION_NOALIAS);
    if (code == POPT_ERROR_BADOPT) return fail_unknown(text, entries);
    if (code == POPT_ERROR_NOARG) return fail_usage("%s: a value is missing behind it", text);
    if (code == POPT_ERROR_UNWANTEDARG) return fail_usage("%s takes no value", text);
    return fail_usage("%s: %s", text, poptStrerror(code));
}

// One option as popt found it. text: its value, NULL for flags.
static bool take(const OptionTable *table, int val, const char *text, void *options) {
    const OptionField *field = &table->fields[(val - VAL_FIRST) / VALS_PER_FIELD];
    bool is_negated = (val - VAL_FIRST) % VALS_PER_FIELD == 1;
    if (field->type == OPTION_FLAG) return option_set(field, options, is_negated ? "false" : "true");
    if (field->type == OPTION_TEXT && text[0] == '-' && text[1])
        return fail_usage("--%s: a value is missing before %s (a name that begins with '-' is written ./%s)",
                          field->name, text, text);
    return option_set(field, options, text);
}

// Takes options until the end (true), --help (*wants_help, true) or the first wrong one.
static bool take_all(poptContext context, const OptionTable *table, const struct poptOption *entries, void *options,
                     bool *wants_help) {
    int val;
    bool good = true;
    *wants_help = false;
    while (good && (val = poptGetNextOpt(context)) > 0) {
        char *text = poptGetOptArg(context);
        *wants_help = val == help_val(table);
        if (!*wants_help) good = take(table, val, text, options);
        free(text); // popt's own
        if (*wants_help) return true;
    }
    if (!good) return false;
    return val == -1 || fail_popt(context, val, entries); // -1: no more options
}

// popt keeps its own copies of what is no option, in the order of argv; the caller gets argv's.
static bool take_positional(poptContext context, char **argv, const char **positional, int max, int *count) {
    const char **left = poptGetArgs(context);
    char **from = argv + 1;
    *count = 0;
    for (; left && *left; left++) {
        while (*from && strcmp(*from, *left) != 0) from++;
        if (*count == max || !*from) return fail_usage("'%s' is one argument too many; --help shows the usage", *left);
        positional[(*count)++] = *from++;
    }
    return true;
}

bool command_line_parse(const Command *command, const OptionTable *table, int argc, char **argv, void *options,
                        const char **positional, int max, int *count, int *exit_code) {
    struct poptOption *entries = make_entries(table);
    poptContext context = poptGetContext("splatlab", argc, (const char **)argv, entries, 0);
    bool wants_help;
    *count = 0;
    bool good = take_all(context, table, entries, options, &wants_help);
    if (good && !wants_help) good = take_positional(context, argv, positional, max, count);
    poptFreeContext(context);
    free_entries(entries);
    *exit_code = 0;
    if (!good) {
        fail_context("%s", command->name);
        *exit_code = command_failed();
    } else if (wants_help) {
        command_help(command, table);
    }
    return good && !wants_help;
}

int command_failed(void) {
    log_error("%s", fail_text());
    return fail_exit_code();
}
