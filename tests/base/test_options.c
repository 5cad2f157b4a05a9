#include "lab/base/fail.h"
#include "lab/base/options.h"
#include "lab/base/rng.h"
#include "tests/support/support.h"

#include <float.h>
#include <stdbool.h>
#include <string.h>

typedef struct {
    int count;
    uint64_t seed;
    double rate;
    bool fast;
    char path[OPTION_TEXT_BYTES];
    int colour;
    int size[2];
} Sample;

static const char *const COLOURS[] = {"red", "green", "blue", NULL};
static const Sample DEFAULTS = {.count = 3, .seed = 1, .rate = 0.5, .colour = 1, .size = {640, 480}};
static const OptionField FIELDS[] = {
    {"max-count", 'c', OPTION_INT, offsetof(Sample, count), -10, 1e6, "splats", NULL, "how many", NULL},
    {"seed", 0, OPTION_U64, offsetof(Sample, seed), 0, 18446744073709551615.0, "", NULL, "seed", NULL},
    {"rate", 0, OPTION_DOUBLE, offsetof(Sample, rate), -DBL_MAX, DBL_MAX, "", NULL, "rate", NULL},
    {"fast", 0, OPTION_FLAG, offsetof(Sample, fast), 0, 0, "", NULL, "fast", NULL},
    {"path", 0, OPTION_TEXT, offsetof(Sample, path), 0, 0, "", NULL, "path", NULL},
    {"colour", 0, OPTION_CHOICE, offsetof(Sample, colour), 0, 0, "", COLOURS, "colour", NULL},
    {"size", 0, OPTION_SIZE, offsetof(Sample, size), 16, 8192, "px", NULL, "size", NULL},
};
static const OptionTable TABLE = {FIELDS, sizeof FIELDS / sizeof FIELDS[0], &DEFAULTS};

static void set(Sample *sample, const char *name, const char *text) {
    if (!option_set(option_find(&TABLE, name), sample, text)) fail_msg("%s", fail_text());
}

static void a_field_is_found_with_dash_or_underscore(void **state) {
    (void)state;
    assert_ptr_equal(option_find(&TABLE, "max-count"), &FIELDS[0]);
    assert_ptr_equal(option_find(&TABLE, "max_count"), &FIELDS[0]);
    assert_null(option_find(&TABLE, "max-coun"));
    assert_null(option_find(&TABLE, "max-counts"));
    assert_null(option_find(&TABLE, ""));
}

static void every_type_is_parsed(void **state) {
    (void)state;
    Sample s = DEFAULTS;
    set(&s, "max-count", "-7");
    set(&s, "seed", "18446744073709551615");
    set(&s, "rate", "1e-3");
    set(&s, "fast", "true");
    set(&s, "path", "a b/c");
    set(&s, "colour", "blue");
    set(&s, "size", "320x200");
    assert_int_equal(s.count, -7);
    assert_true(s.seed == UINT64_MAX);
    assert_true(s.rate == 1e-3);
    assert_true(s.fast);
    assert_string_equal(s.path, "a b/c");
    assert_int_equal(s.colour, 2);
    assert_int_equal(s.size[0], 320);
    assert_int_equal(s.size[1], 200);
    set(&s, "fast", "false");
    assert_false(s.fast);
}

static void text_and_back_gives_the_same_bytes(void **state) {
    (void)state;
    Rng rng = rng_at(11, RNG_TEST, 0, 0);
    for (int round = 0; round < 500; round++) {
        Sample s = DEFAULTS, back = DEFAULTS;
        s.count = (int)rng_below(&rng, 1000011) - 10;
        s.seed = (uint64_t)rng_u32(&rng) << 32 | rng_u32(&rng);
        s.rate = rng_normal(&rng) * (round % 2 ? 1e-200 : 1e12);
        s.fast = rng_below(&rng, 2);
        snprintf(s.path, sizeof s.path, "run %u", rng_u32(&rng));
        s.colour = (int)rng_below(&rng, 3);
        s.size[0] = 16 + (int)rng_below(&rng, 8000);
        s.size[1] = 16 + (int)rng_below(&rng, 8000);
        memset(back.path, 'x', sizeof back.path - 1);
        for (int i = 0; i < TABLE.count; i++) {
            char text[OPTION_TEXT_BYTES];
            set(&back, FIELDS[i].name, option_text(&FIELDS[i], &s, text, sizeof text));
        }
        assert_int_equal(back.count, s.count);
        assert_true(back.seed == s.seed);
        assert_memory_equal(&back.rate, &s.rate, sizeof s.rate);
        assert_int_equal(back.fast, s.fast);
        assert_memory_equal(back.path, s.path, sizeof s.path);
        assert_int_equal(back.colour, s.colour);
        assert_memory_equal(back.size, s.size, sizeof s.size);
    }
}

static void a_double_is_written_as_short_as_it_can_be(void **state) {
    (void)state;
    Sample s = DEFAULTS;
    char text[64];
    s.rate = 0.1;
    assert_string_equal(option_text(&FIELDS[2], &s, text, sizeof text), "0.1");
}

static void wrong_values_fail_as_usage_name_the_option_and_change_nothing(void **state) {
    (void)state;
    static const struct {
        const char *name, *text, *says;
    } cases[] = {
        {"max-count", "x", "not a whole number"},
        {"max-count", "", "not a whole number"},
        {"max-count", "3.5", "not a whole number"},
        {"max-count", "12k", "not a whole number"},
        {"max-count", "-11", "want -10 to 1000000 splats"},
        {"max-count", "99999999999999999999", "want -10 to"},
        {"seed", "-1", "whole number from 0"},
        {"seed", "18446744073709551616", "want 0 to"},
        {"rate", "fast", "not a number"},
        {"rate", "nan", "not a number"},
        {"rate", "inf", "not a number"},
        {"rate", "", "not a number"},
        {"fast", "yes", "true or false"},
        {"colour", "pink", "red, green, blue"},
        {"size", "640", "WxH"},
        {"size", "640x", "WxH"},
        {"size", "x480", "WxH"},
        {"size", "640x480x3", "WxH"},
        {"size", "640x8", "want 16 to 8192 px"},
        {"size", "99999x480", "want 16 to 8192 px"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        Sample s;
        memcpy(&s, &DEFAULTS, sizeof s); // padding too, for the comparison below
        fail_clear();
        assert_false(option_set(option_find(&TABLE, cases[i].name), &s, cases[i].text));
        if (!strstr(fail_text(), cases[i].says) || !strstr(fail_text(), cases[i].name))
            fail_msg("--%s '%s' says: %s", cases[i].name, cases[i].text, fail_text());
        assert_int_equal(fail_exit_code(), 2);
        assert_memory_equal(&s, &DEFAULTS, sizeof s);
    }
}

static void a_text_that_is_too_long_fails(void **state) {
    (void)state;
    Sample s = DEFAULTS;
    char text[OPTION_TEXT_BYTES + 1];
    memset(text, 'p', sizeof text);
    text[OPTION_TEXT_BYTES] = 0;
    assert_false(option_set(&FIELDS[4], &s, text));
    text[OPTION_TEXT_BYTES - 1] = 0;
    assert_true(option_set(&FIELDS[4], &s, text));
    assert_string_equal(s.path, text);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_field_is_found_with_dash_or_underscore),
        cmocka_unit_test(every_type_is_parsed),
        cmocka_unit_test(text_and_back_gives_the_same_bytes),
        cmocka_unit_test(a_double_is_written_as_short_as_it_can_be),
        cmocka_unit_test(wrong_values_fail_as_usage_name_the_option_and_change_nothing),
        cmocka_unit_test(a_text_that_is_too_long_fails),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
