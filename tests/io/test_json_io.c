// test_json_io.c - documents that are read and refused, numbers and matrices, options there and back.
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "lab/io/json_io.h"
#include "tests/support/support.h"

#include <string.h>

static bool read_text(const char *text, json_t **root) {
    const char *path = support_path(support_scratch(), "a.json");
    assert_true(file_write(path, text, strlen(text)));
    return json_read(path, root);
}

static void refuses(const char *text, const char *place, const char *reason) {
    json_t *root;
    if (read_text(text, &root)) fail_msg("was read: %s", text);
    assert_null(root);
    const char *wanted[] = {"a.json", place, reason};
    for (int i = 0; i < 3; i++)
        if (!strstr(fail_text(), wanted[i])) fail_msg("\"%s\" is not in: %s", wanted[i], fail_text());
}

static void a_document_is_written_and_read_back(void **state) {
    (void)state;
    json_t *root = json_pack("{s:f, s:[i,i], s:s}", "third", 1.0 / 3.0, "list", 1, 2, "text", "a\"\n\u00e9");
    const char *path = support_path(support_scratch(), "round.json");
    assert_true(json_write(path, root));
    json_t *copy;
    assert_true(json_read(path, &copy));
    assert_true(json_equal(root, copy));
    json_decref(copy);
    json_decref(root);
}

static void a_byte_order_mark_is_skipped(void **state) {
    (void)state;
    json_t *root;
    assert_true(read_text("\xEF\xBB\xBF{\"a\": 1}", &root));
    assert_true(json_has(root, "a"));
    json_decref(root);
}

static void errors_give_line_and_column(void **state) {
    (void)state;
    refuses("{\n  \"a\": 1,\n  \"b\" 2\n}", "line 3, column 7", "':' expected");
    refuses("", "line 1", "is it JSON?");
    refuses("{\"a\": [1, 2", "line 1, column 11", "is the file complete");
    refuses("{\"a\": 1} x", "line 1", "end of file expected");
    refuses("{\"a\": 1, \"a\": 2}", "line 1", "duplicate");
    refuses("{\"a\": \"\xff\"}", "line 1", "unable to decode byte 0xff");
}

static void numbers_that_are_not_finite_are_refused(void **state) {
    (void)state;
    refuses("{\n\"a\": NaN}", "line 2", "only finite numbers");
    refuses("{\n\"a\": Infinity}", "line 2", "only finite numbers");
    refuses("{\n\"a\": -Infinity}", "line 2", "only finite numbers");
    refuses("{\n\"a\": nan}", "line 2", "only finite numbers");
    refuses("{\"a\": 1e999}", "line 1", "only finite numbers");
}

static void numbers_are_fetched_by_key(void **state) {
    (void)state;
    json_t *root;
    assert_true(read_text("{\"i\": 3, \"r\": 0.5, \"t\": \"x\", \"l\": [1, 2.5, 3], \"bad\": [1, null]}", &root));
    double value, list[3];
    const char *text;
    assert_true(json_get_number(root, "i", "here", &value));
    assert_true(value == 3);
    assert_true(json_get_number(root, "r", "here", &value));
    assert_true(value == 0.5);
    assert_true(json_get_numbers(root, "l", "here", list, 3));
    assert_true(list[0] == 1 && list[1] == 2.5 && list[2] == 3);
    assert_true(json_get_text(root, "t", "here", &text));
    assert_string_equal(text, "x");

    assert_false(json_get_number(root, "none", "frame 12", &value));
    assert_string_equal(fail_text(), "frame 12: \"none\" is missing");
    assert_false(json_get_number(root, "t", "frame 12", &value));
    assert_string_equal(fail_text(), "frame 12: \"t\" is a text, want a number");
    assert_false(json_get_text(root, "i", "frame 12", &text));
    assert_false(json_get_numbers(root, "l", "frame 12", list, 2));
    assert_string_equal(fail_text(), "frame 12: \"l\" has 3 entries, want 2");
    assert_false(json_get_numbers(root, "bad", "frame 12", list, 2));
    assert_non_null(strstr(fail_text(), "entry 2"));
    assert_false(json_get_numbers(root, "i", "frame 12", list, 2));
    json_decref(root);

    root = json_pack("[i]", 1);
    assert_false(json_get_number(root, "i", "here", &value));
    assert_string_equal(fail_text(), "here: a list stands where an object is wanted");
    json_decref(root);
}

static void a_matrix_stands_nested_or_in_a_row(void **state) {
    (void)state;
    json_t *root;
    double m[16];
    assert_true(
        read_text("{\"n\": [[1,2,3,4],[5,6,7,8],[9,10,11,12],[13,14,15,16]],"
                  " \"f\": [1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16], \"three\": [[1,2,3,4],[5,6,7,8],[9,10,11,12]],"
                  " \"short\": [[1,2,3,4],[5,6,7,8],[9,10,11,12],[13,14,15]], \"fifteen\": "
                  "[1,2,3,4,5,6,7,8,9,10,11,12,13,14,15]}",
                  &root));
    const char *good[] = {"n", "f"}, *bad[] = {"three", "short", "fifteen", "none"};
    for (int k = 0; k < 2; k++) {
        memset(m, 0, sizeof m);
        assert_true(json_get_matrix4(root, good[k], "here", m));
        for (int i = 0; i < 16; i++) assert_true(m[i] == i + 1);
    }
    for (int k = 0; k < 4; k++) {
        assert_false(json_get_matrix4(root, bad[k], "frame 7", m));
        assert_non_null(strstr(fail_text(), "frame 7"));
        assert_non_null(strstr(fail_text(), bad[k]));
    }
    json_decref(root);
}

typedef struct {
    int splats;
    double rate;
    uint64_t seed;
    bool loud;
    int kind;
    int size[2];
    char out[OPTION_TEXT_BYTES];
} Options;

static const Options OPTIONS_DEFAULT = {.splats = 7, .rate = 0.1, .size = {640, 480}};
static const char *const KINDS[] = {"plain", "fancy", NULL};
static const OptionField FIELDS[] = {
    {"max-splats", 0, OPTION_INT, offsetof(Options, splats), 1, 100, "", NULL, "", NULL},
    {"rate", 0, OPTION_DOUBLE, offsetof(Options, rate), 0, 1, "", NULL, "", NULL},
    {"seed", 0, OPTION_U64, offsetof(Options, seed), 0, 1.9e19, "", NULL, "", NULL},
    {"loud", 0, OPTION_FLAG, offsetof(Options, loud), 0, 1, "", NULL, "", NULL},
    {"kind", 0, OPTION_CHOICE, offsetof(Options, kind), 0, 1, "", KINDS, "", NULL},
    {"size", 0, OPTION_SIZE, offsetof(Options, size), 1, 4096, "px", NULL, "", NULL},
    {"out", 'o', OPTION_TEXT, offsetof(Options, out), 0, 0, "", NULL, "", NULL},
};
static const OptionTable TABLE = {FIELDS, sizeof FIELDS / sizeof *FIELDS, &OPTIONS_DEFAULT};

static void options_come_back_to_the_same_bytes(void **state) {
    (void)state;
    const uint64_t seeds[] = {0, 42, INT64_MAX, (uint64_t)INT64_MAX + 1, UINT64_MAX};
    for (int i = 0; i < 5; i++) {
        Options options = OPTIONS_DEFAULT, copy = {0};
        options.splats = 99;
        options.rate = 1.0 / 3.0;
        options.seed = seeds[i];
        options.loud = i % 2;
        options.kind = 1;
        options.size[0] = 123;
        strcpy(options.out, "runs/a b");
        json_t *object = json_from_options(&TABLE, &options);
        assert_int_equal(json_object_size(object), TABLE.count);
        assert_true(json_has(object, "max_splats"));
        const char *path = support_path(support_scratch(), "options.json");
        assert_true(json_write(path, object));
        json_decref(object);
        assert_true(json_read(path, &object));
        if (!json_to_options(object, &TABLE, "options.json", &copy)) fail_msg("%s", fail_text());
        assert_memory_equal(&copy, &options, sizeof options);
        json_decref(object);
    }
}

static void a_text_that_is_no_utf8_is_still_written(void **state) {
    (void)state;
    Options options = OPTIONS_DEFAULT;
    strcpy(options.out, "caf\xe9");
    json_t *object = json_from_options(&TABLE, &options);
    assert_string_equal(json_string_value(json_object_get(object, "out")), "caf?");
    json_decref(object);
}

static void options_that_do_not_fit_are_refused_by_name(void **state) {
    (void)state;
    const struct {
        const char *text, *key;
    } cases[] = {
        {"{\"max_splats\": 101}", "max-splats"},
        {"{\"max_splats\": 1.5}", "max_splats"},
        {"{\"max_splats\": \"7\"}", "max_splats"},
        {"{\"rate\": true}", "rate"},
        {"{\"rate\": 2}", "rate"},
        {"{\"loud\": 1}", "loud"},
        {"{\"kind\": \"odd\"}", "kind"},
        {"{\"size\": [1, 2]}", "size"},
        {"{\"seed\": -1}", "seed"},
        {"{\"unknown\": 1}", "unknown"},
        {"[]", "object"},
        {"{\"out\": null}", "out"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Options options = OPTIONS_DEFAULT;
        json_t *object = json_loads(cases[i].text, 0, NULL);
        if (json_to_options(object, &TABLE, "options.json", &options)) fail_msg("was taken: %s", cases[i].text);
        if (!strstr(fail_text(), cases[i].key) || !strstr(fail_text(), "options.json"))
            fail_msg("%s gives: %s", cases[i].text, fail_text());
        assert_int_equal(fail_exit_code(), 1);
        json_decref(object);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_document_is_written_and_read_back),
        cmocka_unit_test(a_byte_order_mark_is_skipped),
        cmocka_unit_test(errors_give_line_and_column),
        cmocka_unit_test(numbers_that_are_not_finite_are_refused),
        cmocka_unit_test(numbers_are_fetched_by_key),
        cmocka_unit_test(a_matrix_stands_nested_or_in_a_row),
        cmocka_unit_test(options_come_back_to_the_same_bytes),
        cmocka_unit_test(a_text_that_is_no_utf8_is_still_written),
        cmocka_unit_test(options_that_do_not_fit_are_refused_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
