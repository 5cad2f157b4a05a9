#include "lab/app/command_line.h"
#include "lab/base/fail.h"
#include "tests/support/support.h"

#include <stdbool.h>
#include <string.h>
#include <unistd.h>

typedef struct {
    int count;
    double rate;
    bool fast, tidy;
    char path[OPTION_TEXT_BYTES];
    int colour;
    int size[2];
} Sample;

static const char *const COLOURS[] = {"red", "green", NULL};
static const Sample DEFAULTS = {.count = 3, .rate = 0.5, .tidy = true, .path = "here", .size = {640, 480}};
static const OptionField FIELDS[] = {
    {"max-count", 'c', OPTION_INT, offsetof(Sample, count), -10, 1000, "splats", NULL, "how many", "Numbers"},
    {"rate", 0, OPTION_DOUBLE, offsetof(Sample, rate), 0, 1, "", NULL, "how fast", NULL},
    {"fast", 'f', OPTION_FLAG, offsetof(Sample, fast), 0, 0, "", NULL, "hurry", "Others"},
    {"tidy", 0, OPTION_FLAG, offsetof(Sample, tidy), 0, 0, "", NULL, "tidy up", NULL},
    {"path", 'p', OPTION_TEXT, offsetof(Sample, path), 0, 0, "", NULL, "where", NULL},
    {"colour", 0, OPTION_CHOICE, offsetof(Sample, colour), 0, 0, "", COLOURS, "which", NULL},
    {"size", 0, OPTION_SIZE, offsetof(Sample, size), 16, 8192, "px", NULL, "how large", NULL},
};
static const OptionTable TABLE = {FIELDS, sizeof FIELDS / sizeof FIELDS[0], &DEFAULTS};
static const Command COMMAND = {
    .name = "sample", .arguments = "THING", .summary = "tries things", .details = "  splatlab sample x"};

enum { POSITIONAL_MAX = 2 };

typedef struct {
    bool goes_on;
    int exit_code, count;
    const char *positional[POSITIONAL_MAX];
    Sample options;
} Parsed;

// Words of the text are the arguments behind the command's name. What it prints goes to the scratch folder.
static Parsed parse(const char *text) {
    static char words[512];
    char name[] = "sample";
    char *argv[16] = {name};
    int argc = 1;
    snprintf(words, sizeof words, "%s", text);
    for (char *word = strtok(words, " "); word; word = strtok(NULL, " ")) argv[argc++] = word;
    Parsed p = {.options = DEFAULTS, .exit_code = -1};
    int before = dup(STDERR_FILENO);
    assert_non_null(freopen(support_path(support_scratch(), "stderr"), "w", stderr));
    p.goes_on = command_line_parse(&COMMAND, &TABLE, argc, argv, &p.options, p.positional, POSITIONAL_MAX, &p.count,
                                   &p.exit_code);
    fflush(stderr);
    dup2(before, STDERR_FILENO);
    close(before);
    return p;
}

static void without_arguments_the_defaults_stay(void **state) {
    (void)state;
    Parsed p = parse("");
    assert_true(p.goes_on);
    assert_int_equal(p.count, 0);
    assert_memory_equal(&p.options, &DEFAULTS, sizeof DEFAULTS);
}

static void every_way_to_write_an_option_is_understood(void **state) {
    (void)state;
    Parsed p = parse("--max-count 7 --rate=0.25 --fast --no-tidy -p x/y --colour green --size 32x16");
    assert_true(p.goes_on);
    assert_int_equal(p.options.count, 7);
    assert_true(p.options.rate == 0.25);
    assert_true(p.options.fast);
    assert_false(p.options.tidy);
    assert_string_equal(p.options.path, "x/y");
    assert_int_equal(p.options.colour, 1);
    assert_int_equal(p.options.size[0], 32);
    p = parse("-fc-5 --no-fast");
    assert_true(p.goes_on);
    assert_int_equal(p.options.count, -5);
    assert_false(p.options.fast);
    p = parse("--rate 0.1 --rate 0.2"); // the last one counts
    assert_true(p.options.rate == 0.2);
}

static void arguments_may_stand_anywhere_between_options(void **state) {
    (void)state;
    Parsed p = parse("one --max-count 7 two -f");
    assert_true(p.goes_on);
    assert_int_equal(p.count, 2);
    assert_string_equal(p.positional[0], "one");
    assert_string_equal(p.positional[1], "two");
    p = parse("-f -- --fast one");
    assert_true(p.goes_on);
    assert_string_equal(p.positional[0], "--fast");
    assert_string_equal(p.positional[1], "one");
    p = parse("-p x x"); // an argument that looks like a value
    assert_int_equal(p.count, 1);
    assert_string_equal(p.positional[0], "x");
}

static void wrong_usage_ends_with_exit_code_2_and_says_why(void **state) {
    (void)state;
    static const char *const cases[][2] = {
        {"--max-cuont 3", "no option --max-cuont; did you mean --max-count?"},
        {"--max 3", "did you mean --max-count?"},
        {"--max-cuont=3", "did you mean --max-count?"},
        {"--zzzzzz", "no option --zzzzzz; --help lists them"},
        {"-z", "no option -z"},
        {"--max-count", "--max-count: a value is missing"},
        {"x -c", "-c: a value is missing"},
        {"--max-count many", "--max-count many: not a whole number"},
        {"--max-count 1001", "--max-count 1001: want -10 to 1000 splats"},
        {"--rate nan", "not a number"},
        {"--colour blue", "want one of red, green"},
        {"--size 640", "WxH"},
        {"--fast=yes", "takes no value"},
        {"--path --fast", "a value is missing before --fast"},
        {"one two three", "'three' is one argument too many"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        fail_clear();
        Parsed p = parse(cases[i][0]);
        if (p.goes_on || p.exit_code != 2 || !strstr(fail_text(), cases[i][1]) ||
            strncmp(fail_text(), "sample: ", 8) != 0)
            fail_msg("'%s': exit code %d, says: %s", cases[i][0], p.exit_code, fail_text());
    }
}

// What --help prints.
static const char *help_text(void) {
    static char text[8192];
    const char *path = support_path(support_scratch(), "stdout");
    fflush(stdout);
    int before = dup(STDOUT_FILENO);
    FILE *file = fopen(path, "w+");
    dup2(fileno(file), STDOUT_FILENO);
    Parsed p = parse("--max-count 5 --help");
    fflush(stdout);
    dup2(before, STDOUT_FILENO);
    close(before);
    assert_false(p.goes_on);
    assert_int_equal(p.exit_code, 0);
    rewind(file);
    text[fread(text, 1, sizeof text - 1, file)] = 0;
    fclose(file);
    return text;
}

static void help_shows_names_units_ranges_and_defaults(void **state) {
    (void)state;
    const char *text = help_text();
    static const char *const parts[] = {
        "Usage: splatlab sample THING [OPTIONS]\n",
        "\ntries things\n",
        "\nNumbers:\n",
        "\nOthers:\n",
        "-c, --max-count N",
        "how many (splats, -10 to 1000, default 3)",
        "--rate X",
        "how fast (0 to 1, default 0.5)",
        "-f, --fast ",
        "hurry\n",
        "--tidy ",
        "tidy up (default on)\n",
        "-p, --path TEXT",
        "where (default here)\n",
        "--colour NAME",
        "which (red | green, default red)",
        "--size WxH",
        "how large (px, 16 to 8192, default 640x480)",
        "-h, --help",
        "\n  splatlab sample x\n",
    };
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++)
        if (!strstr(text, parts[i])) fail_msg("--help does not show '%s':\n%s", parts[i], text);
    assert_true(strstr(text, "Numbers:") < strstr(text, "Others:"));
}

static void a_failed_command_has_the_exit_code_of_its_failure(void **state) {
    (void)state;
    int before = dup(STDERR_FILENO);
    assert_non_null(freopen("/dev/null", "w", stderr));
    (fail)("broken"); // in brackets: cmocka has a macro of that name
    int failed = command_failed();
    fail_usage("wrong");
    int wrong = command_failed();
    fflush(stderr);
    dup2(before, STDERR_FILENO);
    close(before);
    assert_int_equal(failed, 1);
    assert_int_equal(wrong, 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_arguments_the_defaults_stay),
        cmocka_unit_test(every_way_to_write_an_option_is_understood),
        cmocka_unit_test(arguments_may_stand_anywhere_between_options),
        cmocka_unit_test(wrong_usage_ends_with_exit_code_2_and_says_why),
        cmocka_unit_test(help_shows_names_units_ranges_and_defaults),
        cmocka_unit_test(a_failed_command_has_the_exit_code_of_its_failure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
