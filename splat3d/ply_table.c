// ply_table.c - rows of a PLY, from text or from bytes of either order.
#include "splat3d/ply_table.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "splat3d/ply_header.h"

#include <errno.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const PlyElement *vertices(const PlyTable *table) { return &table->elements[table->vertex]; }

int ply_table_rows(const PlyTable *table) { return (int)vertices(table)->count; }
int ply_table_columns(const PlyTable *table) { return vertices(table)->property_count; }
const PlyProperty *ply_table_column(const PlyTable *table, int column) { return &vertices(table)->properties[column]; }

int ply_table_find(const PlyTable *table, const char *column) {
    for (int i = 0; i < ply_table_columns(table); i++)
        if (strcmp(ply_table_column(table, i)->name, column) == 0) return i;
    return -1;
}

static bool fail_cut(const PlyTable *table, const PlyElement *element, long row) {
    return fail("cannot read %s: it ends in row %ld of the %ld of element \"%s\"; is the file complete?", table->path,
                row + 1, element->count, element->name);
}

// ---- binary ----

static double decode(PlyType type, bool big_endian, const unsigned char *bytes) {
    uint64_t bits = 0;
    int size = ply_type_bytes(type);
    for (int i = 0; i < size; i++) bits |= (uint64_t)bytes[big_endian ? size - 1 - i : i] << (8 * i);
    float single;
    double value;
    uint32_t low = (uint32_t)bits;
    switch (type) {
    case PLY_INT8:
        return (int8_t)bits;
    case PLY_UINT8:
        return (uint8_t)bits;
    case PLY_INT16:
        return (int16_t)bits;
    case PLY_UINT16:
        return (uint16_t)bits;
    case PLY_INT32:
        return (int32_t)bits;
    case PLY_UINT32:
        return low;
    case PLY_FLOAT:
        memcpy(&single, &low, sizeof single);
        return single;
    case PLY_DOUBLE:
        break;
    }
    memcpy(&value, &bits, sizeof value);
    return value;
}

static bool read_value(PlyTable *table, PlyType type, double *value) {
    unsigned char bytes[8];
    if (fread(bytes, (size_t)ply_type_bytes(type), 1, table->stream) != 1) return false;
    *value = decode(type, table->format == PLY_BIG_ENDIAN, bytes);
    return true;
}

static bool next_binary(PlyTable *table, const PlyElement *element, double *values) {
    for (int i = 0; i < element->property_count; i++) {
        const PlyProperty *property = &element->properties[i];
        if (!read_value(table, property->is_list ? property->count_type : property->type, &values[i])) return false;
        double ignored;
        for (double k = 0; property->is_list && k < values[i]; k++)
            if (!read_value(table, property->type, &ignored)) return false;
    }
    return true;
}

// ---- ascii: a row is a line ----

static bool parse_value(char **text, double *value) {
    char *end;
    *value = strtod(*text, &end);
    if (end == *text || (*end && !strchr(" \t", *end))) return false;
    *text = end;
    return true;
}

static bool parse_row(const PlyElement *element, char *text, double *values, int *good) {
    double ignored;
    for (*good = 0; *good < element->property_count; ++*good) {
        if (!parse_value(&text, &values[*good])) return false;
        for (double k = 0; element->properties[*good].is_list && k < values[*good]; k++)
            if (!parse_value(&text, &ignored)) return false;
    }
    return text[strspn(text, " \t")] == 0;
}

static bool next_ascii(PlyTable *table, const PlyElement *element, long row, double *values) {
    do {
        if (ply_header_line(table) < 0) return fail_cut(table, element, row);
    } while (table->text[strspn(table->text, " \t")] == 0);
    int good;
    if (parse_row(element, table->text, values, &good)) return true;
    if (good == element->property_count)
        return fail("cannot read %s, line %ld: more than the %d numbers of the header; is the header right?",
                    table->path, table->line, element->property_count);
    return fail("cannot read %s, line %ld: no number for \"%s\", which is %d of %d; is the file complete?", table->path,
                table->line, element->properties[good].name, good + 1, element->property_count);
}

// ---- the table ----

static bool next_row(PlyTable *table, const PlyElement *element, long row, double *values) {
    if (table->format == PLY_ASCII) return next_ascii(table, element, row, values);
    return next_binary(table, element, values) || fail_cut(table, element, row);
}

// The least number of bytes that a row takes: a list may be empty; in ascii a number is a digit and a blank.
static long row_bytes_min(const PlyTable *table, const PlyElement *element) {
    long bytes = 0;
    for (int i = 0; i < element->property_count; i++) {
        const PlyProperty *property = &element->properties[i];
        PlyType type = property->is_list ? property->count_type : property->type;
        bytes += table->format == PLY_ASCII ? 2 : ply_type_bytes(type);
    }
    return bytes;
}

// A count of rows is trusted only as far as the file can hold them: memory is asked for after this.
static bool check_counts(PlyTable *table) {
    struct stat info;
    if (fstat(fileno(table->stream), &info) != 0 || !S_ISREG(info.st_mode))
        return fail("cannot read %s: it is no ordinary file", table->path);
    long left = (long)info.st_size - ftell(table->stream) + 1; // the last line of ascii may have no end
    for (int i = 0; i <= table->vertex; i++) {
        const PlyElement *element = &table->elements[i];
        long bytes = row_bytes_min(table, element), room = left - (table->format != PLY_ASCII);
        if (bytes > 0 && element->count > room / bytes)
            return fail("cannot read %s: %ld rows of \"%s\" need %ld bytes or more, and %ld are there; is the file "
                        "complete?",
                        table->path, element->count, element->name, element->count * bytes, room);
        left -= bytes * element->count;
    }
    return true;
}

static bool pass_over(PlyTable *table, const PlyElement *element) {
    double *values = mem_alloc((size_t)element->property_count, sizeof *values);
    bool ok = true;
    for (long row = 0; ok && row < element->count && element->property_count > 0; row++)
        ok = next_row(table, element, row, values);
    mem_free(values);
    return ok;
}

bool ply_table_open(const char *path, PlyTable *table) {
    *table = (PlyTable){.path = mem_text(path)};
    bool ok = true;
    if (file_is_folder(path))
        ok = fail("cannot read %s: it is a folder, and a PLY file is wanted", path);
    else if (!(table->stream = fopen(path, "rb")))
        ok = fail("cannot read %s: %s; is the path right?", path, strerror(errno));
    ok = ok && ply_header_read(table) && check_counts(table);
    for (int i = 0; ok && i < table->vertex; i++) ok = pass_over(table, &table->elements[i]);
    if (!ok) ply_table_close(table);
    return ok;
}

void ply_table_close(PlyTable *table) {
    for (int i = 0; i < table->element_count; i++) {
        PlyElement *element = &table->elements[i];
        for (int k = 0; k < element->property_count; k++) mem_free(element->properties[k].name);
        mem_free(element->properties);
        mem_free(element->name);
    }
    mem_free(table->elements);
    mem_free(table->path);
    free(table->text); // getline()'s own
    if (table->stream) fclose(table->stream);
    *table = (PlyTable){0};
}

bool ply_table_next(PlyTable *table, double *values) {
    if (!next_row(table, vertices(table), table->row, values)) return false;
    table->row++;
    return true;
}
