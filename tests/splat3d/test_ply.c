// test_ply.c - splats there and back, in the forms that others write, and the ways in which such a file can be broken.
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/base/rng.h"
#include "lab/io/file.h"
#include "splat3d/ply.h"
#include "tests/support/support.h"

#include <math.h>
#include <string.h>

static const char *scratch(const char *name) { return support_path(support_scratch(), name); }

// Without file_write()'s sync to the disk, which would take most of the time here.
static void write_bytes(const char *path, const char *data, size_t size) {
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    fclose(file);
}

static Gaussians random_model(int count, int sh_degree) {
    Gaussians g = gaussians_create(count, sh_degree);
    Rng rng = rng_at(11, RNG_TEST, (uint32_t)count, (uint32_t)sh_degree);
    for (int id = 0; id < FIELD_COUNT; id++)
        for (int i = 0; g.field[id] && i < count * GAUSSIAN_FIELDS[id].width; i++)
            g.field[id][i] = (float)rng_normal(&rng);
    return g;
}

static void assert_same_model(const Gaussians *a, const Gaussians *b) {
    assert_int_equal(a->count, b->count);
    assert_int_equal(a->sh_degree, b->sh_degree);
    for (int id = 0; id < FIELD_COUNT; id++)
        if (a->field[id])
            assert_memory_equal(a->field[id], b->field[id],
                                (size_t)a->count * (size_t)GAUSSIAN_FIELDS[id].width * sizeof(float));
}

static Gaussians load(const char *path) {
    Gaussians g;
    if (!ply_load(path, &g)) fail_msg("%s", fail_text());
    return g;
}

static void models_of_every_degree_come_back_to_the_bit(void **state) {
    (void)state;
    for (int degree = 0; degree <= SH_DEGREE_MAX; degree++) {
        Gaussians g = random_model(37, degree);
        g.field[FIELD_MEAN][0] = -0.0f;
        g.field[FIELD_MEAN][1] = 1e-42f; // denormal
        assert_true(ply_save(scratch("a.ply"), &g));
        Gaussians copy = load(scratch("a.ply"));
        assert_same_model(&copy, &g);
        assert_true(ply_save(scratch("b.ply"), &copy));
        char first[65], second[65];
        assert_true(file_sha256(scratch("a.ply"), first) && file_sha256(scratch("b.ply"), second));
        assert_string_equal(first, second);
        bool is_splats;
        assert_true(ply_is_splats(scratch("a.ply"), &is_splats));
        assert_true(is_splats);
        gaussians_destroy(&copy);
        gaussians_destroy(&g);
    }
}

// The layout as other programs expect it, written out by hand for one splat of degree 3.
static void the_file_has_62_floats_in_the_usual_order(void **state) {
    (void)state;
    Gaussians g = gaussians_create(1, 3);
    for (int k = 0; k < 3; k++) g.field[FIELD_MEAN][k] = (float)(1 + k);
    for (int k = 0; k < 3; k++) g.field[FIELD_SH0][k] = (float)(10 + k);
    const GaussianFieldId field[] = {FIELD_SH1, FIELD_SH2, FIELD_SH3};
    const int width[] = {3, 5, 7};
    for (int d = 0, coefficient = 1; d < 3; d++) // 100 channel + coefficient, which is 1..15
        for (int i = 0; i < width[d]; i++, coefficient++)
            for (int c = 0; c < 3; c++) g.field[field[d]][3 * i + c] = (float)(100 * (c + 1) + coefficient);
    g.field[FIELD_OPACITY_LOGIT][0] = 50;
    for (int k = 0; k < 3; k++) g.field[FIELD_LOG_SCALE][k] = (float)(60 + k);
    for (int k = 0; k < 4; k++) g.field[FIELD_QUAT][k] = (float)(70 + k);
    assert_true(ply_save(scratch("layout.ply"), &g));

    char *data;
    size_t size;
    assert_true(file_read(scratch("layout.ply"), &data, &size));
    char *body = strstr(data, "end_header\n") + 11;
    assert_int_equal(data + size - body, 62 * 4);
    float row[62];
    memcpy(row, body, sizeof row);
    for (int k = 0; k < 3; k++) assert_true(row[k] == 1 + k && row[3 + k] == 0 && row[6 + k] == 10 + k);
    for (int c = 0; c < 3; c++)
        for (int k = 1; k <= 15; k++) assert_true(row[9 + 15 * c + k - 1] == 100 * (c + 1) + k);
    assert_true(row[54] == 50 && row[55] == 60 && row[57] == 62 && row[58] == 70 && row[61] == 73);
    const char *names[] = {"x\n", "ny\n", "f_dc_2\n", "f_rest_44\n", "opacity\n", "scale_0\n", "rot_3\n"};
    const char *at = data;
    for (int i = 0; i < 7; i++) {
        char line[64];
        snprintf(line, sizeof line, "property float %s", names[i]);
        at = strstr(at, line); // each behind the one before
        assert_non_null(at);
    }
    mem_free(data);
    gaussians_destroy(&g);
}

// ---- the forms of others ----

typedef struct {
    const char *format; // as in the header
    bool big_endian;
} Form;

static void put(FILE *file, const char *type, double value, const Form *form) {
    unsigned char bytes[8], turned[8];
    int size = 4;
    float single = (float)value;
    memcpy(bytes, &single, 4);
    if (strcmp(type, "double") == 0) memcpy(bytes, &value, (size_t)(size = 8));
    if (strcmp(type, "uchar") == 0 || strcmp(type, "int8") == 0) bytes[0] = (unsigned char)(int)value, size = 1;
    if (strcmp(type, "short") == 0) {
        int16_t whole = (int16_t)value;
        memcpy(bytes, &whole, (size_t)(size = 2));
    }
    if (strcmp(type, "int") == 0 || strcmp(type, "uint32") == 0) {
        int32_t whole = (int32_t)value;
        memcpy(bytes, &whole, 4);
    }
    for (int i = 0; i < size; i++) turned[i] = bytes[size - 1 - i];
    fwrite(form->big_endian ? turned : bytes, 1, (size_t)size, file);
}

// Three splats of degree 0 with the columns in an odd order and of many types, lists before and behind, comments, and \r\n.
static void write_odd(const char *path, const Form *form, const Gaussians *g) {
    static const struct {
        const char *type, *name;
        GaussianFieldId field;
        int offset;
    } columns[] = {
        {"double", "rot_3", FIELD_QUAT, 3},
        {"short", "rot_1", FIELD_QUAT, 1},
        {"int", "rot_2", FIELD_QUAT, 2},
        {"int8", "rot_0", FIELD_QUAT, 0},
        {"float", "z", FIELD_MEAN, 2},
        {"float32", "y", FIELD_MEAN, 1},
        {"double", "x", FIELD_MEAN, 0},
        {"uchar", "f_dc_1", FIELD_SH0, 1},
        {"uint32", "f_dc_0", FIELD_SH0, 0},
        {"float", "opacity", FIELD_OPACITY_LOGIT, 0},
        {"float", "f_dc_2", FIELD_SH0, 2},
        {"float", "scale_1", FIELD_LOG_SCALE, 1},
        {"float", "scale_0", FIELD_LOG_SCALE, 0},
        {"float", "scale_2", FIELD_LOG_SCALE, 2},
    };
    enum { COLUMNS = sizeof columns / sizeof *columns };
    bool ascii = strcmp(form->format, "ascii") == 0;
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fprintf(file, "ply\r\nformat %s 1.0\r\ncomment made by a test\r\nobj_info odd\r\n", form->format);
    fprintf(file, "element camera 2\r\nproperty list uchar double parameters\r\nproperty float fov\r\n");
    fprintf(file, "element vertex 3\r\n");
    for (int k = 0; k < COLUMNS; k++) fprintf(file, "property %s %s\r\n", columns[k].type, columns[k].name);
    fprintf(file, "property list uchar int unused\r\nelement face 1\r\nproperty list uchar int i\r\nend_header\r\n");
    for (int i = 0; i < 2 && ascii; i++) fprintf(file, i ? "0 1.5\r\n" : "2 0.25 0.5 1.5\r\n");
    for (int i = 0; i < 2 && !ascii; i++) {
        put(file, "uchar", i ? 0 : 2, form);
        for (int k = 0; k < (i ? 0 : 2); k++) put(file, "double", 0.25, form);
        put(file, "float", 1.5, form);
    }
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < COLUMNS; k++) {
            double value = gaussians_at(g, columns[k].field, i)[columns[k].offset];
            if (ascii)
                fprintf(file, "%.9g ", value);
            else
                put(file, columns[k].type, value, form);
        }
        if (ascii) fprintf(file, i ? "0\r\n" : "2 5 6\r\n\r\n");
        if (!ascii) put(file, "uchar", i ? 0 : 2, form);
        for (int k = 0; !ascii && k < (i ? 0 : 2); k++) put(file, "int", 5, form);
    }
    if (ascii)
        fprintf(file, "3 0 1 2");
    else
        for (int k = 0; k < 4; k++) put(file, k ? "int" : "uchar", k ? k : 3, form);
    fclose(file);
}

static void any_order_type_and_byte_order_is_read(void **state) {
    (void)state;
    const Form forms[] = {{"ascii", false}, {"binary_little_endian", false}, {"binary_big_endian", true}};
    Gaussians g = random_model(3, 0);
    for (int i = 0; i < 3; i++) {
        const int quaternion[] = {-7 - i, 300 * i - 1, 70000 - i, 0};
        for (int k = 0; k < 3; k++) gaussians_at(&g, FIELD_QUAT, i)[k] = (float)quaternion[k];
        gaussians_at(&g, FIELD_SH0, i)[0] = (float)(1000 * i);
        gaussians_at(&g, FIELD_SH0, i)[1] = (float)(253 + i);
    }
    for (int k = 0; k < 3; k++) {
        write_odd(scratch("odd.ply"), &forms[k], &g);
        Gaussians copy = load(scratch("odd.ply"));
        assert_same_model(&copy, &g);
        gaussians_destroy(&copy);
    }
    gaussians_destroy(&g);
}

static void models_of_others_are_read(void **state) {
    (void)state;
    const struct {
        const char *name;
        int count, sh_degree;
    } models[] = {{"splats/playbot_lod5.ply", 3000, 2},
                  {"splats/playbot_lod4.ply", 8406, 2},
                  {"splats/test-splat.3-points-from-train.ply", 3, 3},
                  {"reference/random_5k.ply", 5000, 3},
                  {"reference/tiny_case.ply", 4, 3}};
    for (int i = 0; i < 5; i++) {
        Gaussians g = load(support_data(models[i].name));
        assert_int_equal(g.count, models[i].count);
        assert_int_equal(g.sh_degree, models[i].sh_degree);
        gaussians_destroy(&g);
    }
    // That program writes our columns in our order, so its file is ours to the byte.
    const char *path = support_data("reference/random_5k.ply");
    Gaussians g = load(path);
    char first[65], second[65];
    assert_true(ply_save(scratch("again.ply"), &g));
    assert_true(file_sha256(path, first) && file_sha256(scratch("again.ply"), second));
    assert_string_equal(first, second);
    gaussians_destroy(&g);
}

// ---- broken ----

// A good ascii file of two splats of degree 0; `find` is replaced by `by` in it.
static const char GOOD[] = "ply\nformat ascii 1.0\nelement vertex 2\n"
                           "property float x\nproperty float y\nproperty float z\n"
                           "property float f_dc_0\nproperty float f_dc_1\nproperty float f_dc_2\n"
                           "property float opacity\n"
                           "property float scale_0\nproperty float scale_1\nproperty float scale_2\n"
                           "property float rot_0\nproperty float rot_1\nproperty float rot_2\nproperty float rot_3\n"
                           "end_header\n"
                           "1 2 3 .1 .2 .3 4 5 6 7 1 0 0 0\n"
                           "11 12 13 .4 .5 .6 14 15 16 17 0 0 0 1\n";

static void write_changed(const char *path, const char *find, const char *by) {
    const char *at = strstr(GOOD, find);
    if (!at) fail_msg("%s is not in the file", find);
    char *text = mem_format("%.*s%s%s", (int)(at - GOOD), GOOD, by, at + strlen(find));
    write_bytes(path, text, strlen(text));
    mem_free(text);
}

static void what_is_wrong_in_a_file_is_named(void **state) {
    (void)state;
    const struct {
        const char *find, *by, *reason;
    } cases[] = {
        {"ply\n", "plx\n", "begin with \"ply\""},
        {"ply\n", "", "begin with \"ply\""},
        {"format ascii 1.0\n", "", "no \"format\""},
        {"format ascii 1.0", "format ascii 2.0", "line 2"},
        {"format ascii", "format binary_middle_endian", "line 2"},
        {"format ascii", "format binary_little_endian", "need 112 bytes"},
        {"element vertex 2", "element vertex 3", "need 84 bytes"},
        {"14 15 16 17 0 0 0 1\n", "\n\n\n\n\n\n\n\n\n\n", "line 20"},
        {"11 12 13 .4 .5 .6 14 15 16 17 0 0 0 1\n", "          \n\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n", "row 2 of the 2"},
        {"element vertex 2", "element vertex 0", "no splats"},
        {"element vertex 2", "element vertex -2", "count"},
        {"element vertex 2", "element vertex 2x", "count"},
        {"element vertex 2", "element vertex 99999999999", "count"},
        {"element vertex 2", "element vertex 2000000000", "is the file complete"},
        {"element vertex 2", "element face 2", "no element \"vertex\""},
        {"element vertex 2", "element vertex 2\nelement vertex 2", "second element"},
        {"element vertex 2\n", "", "before the first element"},
        {"property float z", "property float y", "second property"},
        {"property float z", "property quad z", "number type"},
        {"property float z", "property list float int z", "number type"},
        {"property float z", "property float", "property TYPE NAME"},
        {"property float z", "banana", "unknown keyword"},
        {"float opacity", "float alpha", "\"opacity\""},
        {"float rot_3", "float rot_4", "\"rot_3\""},
        {"float rot_3", "float f_rest_0", "1 columns f_rest"},
        {"float rot_3", "list uchar float rot_3", "is a list"},
        {"end_header\n", "", "header"},
        {"7 1 0 0 0\n", "7 1 0 0 0 0\n", "more than the 14"},
        {"7 1 0 0 0\n", "7 1 0 0\n", "\"rot_3\""},
        {"7 1 0 0 0\n", "7 1 0 x 0\n", "\"rot_2\""},
        {"7 1 0 0 0\n", "7 0 0 0 0\n", "splat 0 (counted from 0): its quaternion"},
        {"11 12 13", "11 nan 13", "splat 1 (counted from 0), column \"y\""},
        {"15 16 17", "15 inf 17", "splat 1 (counted from 0), column \"scale_1\""},
        {"14 15", "1e99 15", "column \"opacity\""}, // too large for a float
    };
    write_changed(scratch("bad.ply"), "ply", "ply");
    Gaussians g = load(scratch("bad.ply"));
    assert_int_equal(g.count, 2);
    assert_true(gaussians_at(&g, FIELD_LOG_SCALE, 1)[2] == 17);
    gaussians_destroy(&g);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_changed(scratch("bad.ply"), cases[i].find, cases[i].by);
        if (ply_load(scratch("bad.ply"), &g)) fail_msg("%s -> %s was read", cases[i].find, cases[i].by);
        assert_null(g.field[FIELD_MEAN]);
        if (!strstr(fail_text(), cases[i].reason) || !strstr(fail_text(), "bad.ply") || strchr(fail_text(), '\n'))
            fail_msg("%s -> %s: %s", cases[i].find, cases[i].by, fail_text());
    }
}

static void every_cut_of_a_binary_file_is_noticed(void **state) {
    (void)state;
    Gaussians g = random_model(3, 1), copy;
    assert_true(ply_save(scratch("whole.ply"), &g));
    char *data;
    size_t size;
    assert_true(file_read(scratch("whole.ply"), &data, &size));
    for (size_t cut = 0; cut < size; cut++) {
        write_bytes(scratch("cut.ply"), data, cut);
        if (ply_load(scratch("cut.ply"), &copy)) fail_msg("cut after %zu of %zu bytes", cut, size);
        assert_non_null(strstr(fail_text(), "cut.ply"));
    }
    mem_free(data);
    gaussians_destroy(&g);
}

static void random_damage_does_no_harm(void **state) {
    (void)state;
    Gaussians g = random_model(3, 0), copy;
    const Form form = {"binary_little_endian", false};
    write_odd(scratch("whole.ply"), &form, &g);
    char *data;
    size_t size;
    assert_true(file_read(scratch("whole.ply"), &data, &size));
    Rng rng = rng_at(5, RNG_TEST, 0, 0);
    int refused = 0;
    for (int i = 0; i < 1000; i++) {
        size_t at = rng_below(&rng, (uint32_t)size);
        char old = data[at];
        data[at] = (char)rng_below(&rng, 256);
        write_bytes(scratch("damaged.ply"), data, size);
        if (ply_load(scratch("damaged.ply"), &copy))
            gaussians_destroy(&copy);
        else
            refused++;
        data[at] = old;
    }
    assert_true(refused > 100);
    mem_free(data);
    gaussians_destroy(&g);
}

static void a_folder_or_no_file_is_an_error(void **state) {
    (void)state;
    Gaussians g;
    Points points;
    bool is_splats;
    assert_false(ply_load(support_scratch(), &g));
    assert_non_null(strstr(fail_text(), "folder"));
    assert_false(ply_load("no/such/model.ply", &g));
    assert_non_null(strstr(fail_text(), "no/such/model.ply"));
    assert_false(ply_load_points("no/such/model.ply", &points));
    assert_false(ply_is_splats("no/such/model.ply", &is_splats));
    Gaussians model = random_model(1, 0);
    assert_false(ply_save("no/such/model.ply", &model));
    gaussians_destroy(&model);
}

static void points_are_read_with_and_without_colour(void **state) {
    (void)state;
    const char *with =
        "ply\nformat ascii 1.0\nelement vertex 2\nproperty uchar blue\nproperty double x\nproperty float y\n"
        "property float z\nproperty uchar red\nproperty uchar green\nend_header\n3 0.1 2 3 1 2\n255 4 5 6 0 9\n";
    const char *floats =
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
        "property float red\nproperty float green\nproperty float blue\nend_header\n1 2 3 0.5 -1 2\n";
    const char *without =
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
        "end_header\n1 2 3\n";
    Points points;
    bool is_splats;
    write_bytes(scratch("points.ply"), with, strlen(with));
    if (!ply_load_points(scratch("points.ply"), &points)) fail_msg("%s", fail_text());
    assert_int_equal(points.count, 2);
    assert_true(points.xyz[0] == 0.1 && points.xyz[5] == 6);
    const uint8_t colours[] = {1, 2, 3, 0, 9, 255};
    assert_memory_equal(points.rgb, colours, 6);
    points_destroy(&points);
    assert_true(ply_is_splats(scratch("points.ply"), &is_splats));
    assert_false(is_splats);
    Gaussians g;
    assert_false(ply_load(scratch("points.ply"), &g));
    assert_non_null(strstr(fail_text(), "point cloud"));

    write_bytes(scratch("points.ply"), floats, strlen(floats));
    assert_true(ply_load_points(scratch("points.ply"), &points));
    const uint8_t clipped[] = {128, 0, 255};
    assert_memory_equal(points.rgb, clipped, 3);
    points_destroy(&points);

    write_bytes(scratch("points.ply"), without, strlen(without));
    assert_true(ply_load_points(scratch("points.ply"), &points));
    const uint8_t grey[] = {128, 128, 128};
    assert_memory_equal(points.rgb, grey, 3);
    points_destroy(&points);
    points_destroy(&points);
}

static void points_that_are_not_finite_are_refused(void **state) {
    (void)state;
    const char *text = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
                       "end_header\n1 2 3\n1 2 nan\n";
    Points points;
    write_bytes(scratch("points.ply"), text, strlen(text));
    assert_false(ply_load_points(scratch("points.ply"), &points));
    assert_non_null(strstr(fail_text(), "point 1 (counted from 0), column \"z\""));
    assert_null(points.xyz);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(models_of_every_degree_come_back_to_the_bit),
        cmocka_unit_test(the_file_has_62_floats_in_the_usual_order),
        cmocka_unit_test(any_order_type_and_byte_order_is_read),
        cmocka_unit_test(models_of_others_are_read),
        cmocka_unit_test(what_is_wrong_in_a_file_is_named),
        cmocka_unit_test(every_cut_of_a_binary_file_is_noticed),
        cmocka_unit_test(random_damage_does_no_harm),
        cmocka_unit_test(a_folder_or_no_file_is_an_error),
        cmocka_unit_test(points_are_read_with_and_without_colour),
        cmocka_unit_test(points_that_are_not_finite_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
