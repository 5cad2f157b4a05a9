// ply.c - between the columns of a splat PLY and the fields of the model.
#include "splat3d/ply.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "splat3d/ply_table.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { REST_MAX = 3 * (SH_COEFFICIENTS_MAX - 1), COLUMNS_MAX = 14 + REST_MAX };

// One number of a splat: its column in the file and its place in the model.
typedef struct {
    char name[24];
    GaussianFieldId field;
    int offset; // within the field's width
} Column;

static int rest_count(int sh_degree) { return 3 * ((sh_degree + 1) * (sh_degree + 1) - 1); }

static void add_columns(Column *columns, int *count, const char *name, GaussianFieldId field, int width) {
    for (int i = 0; i < width; i++) {
        Column *column = &columns[(*count)++];
        *column = (Column){.field = field, .offset = i};
        if (field == FIELD_MEAN)
            snprintf(column->name, sizeof column->name, "%c", "xyz"[i]);
        else if (width == 1)
            snprintf(column->name, sizeof column->name, "%s", name);
        else
            snprintf(column->name, sizeof column->name, "%s_%d", name, i);
    }
}

// f_rest is channel-major: all coefficients above degree 0 of red, then of green, then of blue. Ours are (coefficient, rgb),
// one field a degree: coefficient k of 1..15 is number k - d^2 of degree d.
static Column rest_column(int index, int sh_degree) {
    int per_channel = rest_count(sh_degree) / 3;
    int channel = index / per_channel, k = index % per_channel + 1;
    int degree = k < 4 ? 1 : k < 9 ? 2 : 3;
    Column column = {.field = (GaussianFieldId)(FIELD_SH0 + degree), .offset = 3 * (k - degree * degree) + channel};
    snprintf(column.name, sizeof column.name, "f_rest_%d", index);
    return column;
}

// All columns that hold a number of the model, in the order in which we write them.
static int list_columns(int sh_degree, Column columns[COLUMNS_MAX]) {
    int count = 0;
    add_columns(columns, &count, "", FIELD_MEAN, 3);
    add_columns(columns, &count, "f_dc", FIELD_SH0, 3);
    for (int i = 0; i < rest_count(sh_degree); i++) columns[count++] = rest_column(i, sh_degree);
    add_columns(columns, &count, "opacity", FIELD_OPACITY_LOGIT, 1);
    add_columns(columns, &count, "scale", FIELD_LOG_SCALE, 3);
    add_columns(columns, &count, "rot", FIELD_QUAT, 4);
    return count;
}

// ---- splats in ----

static bool find_degree(const PlyTable *table, int *sh_degree) {
    int found = 0;
    for (int i = 0; i < ply_table_columns(table); i++)
        found += strncmp(ply_table_column(table, i)->name, "f_rest_", 7) == 0;
    for (*sh_degree = 0; *sh_degree <= SH_DEGREE_MAX; ++*sh_degree)
        if (found == rest_count(*sh_degree)) return true;
    return fail("cannot read %s: %d columns f_rest_*, want 0, 9, 24 or 45 (spherical harmonics of degree 0 to 3)",
                table->path, found);
}

// at[i]: the number of the file's column that holds columns[i].
static bool find_columns(const PlyTable *table, const Column *columns, int count, int at[COLUMNS_MAX]) {
    for (int i = 0; i < count; i++) {
        at[i] = ply_table_find(table, columns[i].name);
        if (at[i] < 0)
            return fail("cannot read splats from %s: there is no column \"%s\"; is it a plain point cloud or mesh?",
                        table->path, columns[i].name);
        if (ply_table_column(table, at[i])->is_list)
            return fail("cannot read splats from %s: column \"%s\" is a list, want a number", table->path,
                        columns[i].name);
    }
    return true;
}

static bool check_quaternion(const PlyTable *table, const Gaussians *g, int splat) {
    const float *q = gaussians_at(g, FIELD_QUAT, splat);
    // Part by part: the sum of squares would vanish for a quaternion that is short but has a direction.
    if (q[0] != 0 || q[1] != 0 || q[2] != 0 || q[3] != 0) return true;
    return fail("cannot read %s: splat %d (counted from 0): its quaternion rot_0..rot_3 has length zero", table->path,
                splat);
}

static bool read_splats(PlyTable *table, const Column *columns, int count, const int *at, double *row, Gaussians *g) {
    for (int splat = 0; splat < g->count; splat++) {
        if (!ply_table_next(table, row)) return false;
        for (int i = 0; i < count; i++) {
            float value = (float)row[at[i]];
            if (!isfinite(value))
                return fail("cannot read %s: splat %d (counted from 0), column \"%s\": %g; was the training that "
                            "wrote it stable?",
                            table->path, splat, columns[i].name, row[at[i]]);
            gaussians_at(g, columns[i].field, splat)[columns[i].offset] = value;
        }
        if (!check_quaternion(table, g, splat)) return false;
    }
    return true;
}

static bool load_table(PlyTable *table, Gaussians *g) {
    int sh_degree, at[COLUMNS_MAX];
    Column columns[COLUMNS_MAX];
    if (!find_degree(table, &sh_degree)) return false;
    int count = list_columns(sh_degree, columns);
    if (!find_columns(table, columns, count, at)) return false;
    if (ply_table_rows(table) == 0) return fail("cannot read %s: it holds no splats", table->path);
    *g = gaussians_create(ply_table_rows(table), sh_degree);
    double *row = mem_alloc((size_t)ply_table_columns(table), sizeof *row);
    bool ok = read_splats(table, columns, count, at, row, g);
    mem_free(row);
    if (!ok) gaussians_destroy(g);
    return ok;
}

bool ply_load(const char *path, Gaussians *gaussians) {
    PlyTable table;
    *gaussians = (Gaussians){0};
    if (!ply_table_open(path, &table)) return false;
    bool ok = load_table(&table, gaussians);
    ply_table_close(&table);
    return ok;
}

bool ply_is_splats(const char *path, bool *is_splats) {
    PlyTable table;
    *is_splats = false;
    if (!ply_table_open(path, &table)) return false;
    *is_splats = ply_table_find(&table, "opacity") >= 0 && ply_table_find(&table, "scale_0") >= 0;
    ply_table_close(&table);
    return true;
}

// ---- splats out ----

static const char *const NORMALS[] = {"nx", "ny", "nz"}; // zeros behind x y z; every reader expects them

static void write_header(FILE *stream, const Gaussians *g, const Column *columns, int count) {
    fprintf(stream, "ply\nformat binary_little_endian 1.0\nelement vertex %d\n", g->count);
    for (int i = 0; i < count; i++) {
        if (i == 3)
            for (int k = 0; k < 3; k++) fprintf(stream, "property float %s\n", NORMALS[k]);
        fprintf(stream, "property float %s\n", columns[i].name);
    }
    fprintf(stream, "end_header\n");
}

static void put_float(unsigned char *bytes, float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 4; i++) bytes[i] = (unsigned char)(bits >> (8 * i));
}

static void write_splat(FILE *stream, const Gaussians *g, int splat, const Column *columns, int count) {
    unsigned char row[4 * (COLUMNS_MAX + 3)], *end = row;
    for (int i = 0; i < count; i++) {
        for (int k = 0; i == 3 && k < 3; k++, end += 4) put_float(end, 0);
        put_float(end, gaussians_at(g, columns[i].field, splat)[columns[i].offset]);
        end += 4;
    }
    fwrite(row, 1, (size_t)(end - row), stream);
}

bool ply_save(const char *path, const Gaussians *gaussians) {
    FileWriter writer;
    Column columns[COLUMNS_MAX];
    int count = list_columns(gaussians->sh_degree, columns);
    if (!file_begin(&writer, path)) return false;
    write_header(writer.stream, gaussians, columns, count);
    for (int i = 0; i < gaussians->count; i++) write_splat(writer.stream, gaussians, i, columns, count);
    return file_commit(&writer);
}

// ---- point clouds ----

// Whole numbers are 0..255; floating point colours are 0..1.
static uint8_t colour_byte(double value, PlyType type) {
    double byte = type == PLY_FLOAT || type == PLY_DOUBLE ? 255 * value : value;
    return byte > 0 ? (byte < 255 ? (uint8_t)lround(byte) : 255) : 0;
}

static bool read_points(PlyTable *table, const int at[6], double *row, Points *points) {
    static const char axes[] = "xyz";
    for (int i = 0; i < points->count; i++) {
        if (!ply_table_next(table, row)) return false;
        for (int k = 0; k < 3; k++) {
            double value = points->xyz[3 * (size_t)i + (size_t)k] = row[at[k]];
            if (!isfinite((float)value)) // splats are floats
                return fail("cannot read %s: point %d (counted from 0), column \"%c\": %g; is the file damaged?",
                            table->path, i, axes[k], value);
            uint8_t *colour = &points->rgb[3 * (size_t)i + (size_t)k];
            *colour = at[3 + k] < 0 ? 128 : colour_byte(row[at[3 + k]], ply_table_column(table, at[3 + k])->type);
        }
    }
    return true;
}

bool ply_load_points(const char *path, Points *points) {
    static const char *const names[6] = {"x", "y", "z", "red", "green", "blue"};
    PlyTable table;
    *points = (Points){0};
    if (!ply_table_open(path, &table)) return false;
    int at[6];
    bool ok = true;
    for (int i = 0; i < 6 && ok; i++) {
        at[i] = ply_table_find(&table, names[i]);
        if (i < 3 && at[i] < 0) ok = fail("cannot read points from %s: there is no column \"%s\"", path, names[i]);
    }
    if (ok) {
        *points = points_create(ply_table_rows(&table));
        double *row = mem_alloc((size_t)ply_table_columns(&table), sizeof *row);
        ok = read_points(&table, at, row, points);
        mem_free(row);
        if (!ok) points_destroy(points);
    }
    ply_table_close(&table);
    return ok;
}
