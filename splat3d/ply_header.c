// ply_header.c - line by line, each begins with a keyword: ply, format, comment, obj_info, element, property, end_header.
#include "splat3d/ply_header.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { LINES_MAX = 100000, LINE_BYTES_MAX = 65536, ELEMENTS_MAX = 64, PROPERTIES_MAX = 4096, WORDS_MAX = 8 };

static const struct {
    const char *name, *old_name;
    int bytes;
} TYPES[] = {
    [PLY_INT8] = {"int8", "char", 1},      [PLY_UINT8] = {"uint8", "uchar", 1},
    [PLY_INT16] = {"int16", "short", 2},   [PLY_UINT16] = {"uint16", "ushort", 2},
    [PLY_INT32] = {"int32", "int", 4},     [PLY_UINT32] = {"uint32", "uint", 4},
    [PLY_FLOAT] = {"float32", "float", 4}, [PLY_DOUBLE] = {"float64", "double", 8},
};

int ply_type_bytes(PlyType type) { return TYPES[type].bytes; }
bool ply_type_is_float(PlyType type) { return type == PLY_FLOAT || type == PLY_DOUBLE; }

static bool parse_type(const char *name, PlyType *type) {
    for (PlyType t = 0; t < sizeof TYPES / sizeof *TYPES; t++)
        if (strcmp(name, TYPES[t].name) == 0 || strcmp(name, TYPES[t].old_name) == 0) {
            *type = t;
            return true;
        }
    return false;
}

long ply_header_line(PlyTable *table) {
    long length = getline(&table->text, &table->text_size, table->stream);
    if (length < 0) return -1;
    table->line++;
    if (length > 0 && table->text[length - 1] == '\n') length--;
    if (length > 0 && table->text[length - 1] == '\r') length--;
    table->text[length] = 0;
    return length;
}

static bool fail_line(const PlyTable *table, const char *what) {
    return fail("cannot read %s, line %ld of the header: %s; is it a PLY file?", table->path, table->line, what);
}

// Splits at blanks, in place; returns how many words there are, at most WORDS_MAX.
static int split(char *text, char *words[WORDS_MAX]) {
    int count = 0;
    char *rest = NULL;
    for (char *word = strtok_r(text, " \t", &rest); word && count < WORDS_MAX; word = strtok_r(NULL, " \t", &rest))
        words[count++] = word;
    return count;
}

static bool read_format(PlyTable *table, char **words, int count) {
    static const char *const names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    for (int i = 0; count == 3 && i < 3; i++)
        if (strcmp(words[1], names[i]) == 0 && strcmp(words[2], "1.0") == 0) {
            table->format = (PlyFormat)i;
            return true;
        }
    return fail_line(table, "want \"format ascii|binary_little_endian|binary_big_endian 1.0\"");
}

static bool read_element(PlyTable *table, char **words, int count) {
    if (count != 3) return fail_line(table, "want \"element NAME COUNT\"");
    char *end;
    long rows = strtol(words[2], &end, 10);
    if (*end || end == words[2] || rows < 0 || rows >= INT_MAX)
        return fail_line(table, "the count of the element is no number from 0 to 2147483646");
    if (table->element_count == ELEMENTS_MAX) return fail_line(table, "more than 64 elements");
    for (int i = 0; i < table->element_count; i++)
        if (strcmp(table->elements[i].name, words[1]) == 0)
            return fail_line(table, "a second element of the same name");
    size_t had = (size_t)table->element_count++;
    table->elements = mem_resize(table->elements, had, had + 1, sizeof *table->elements);
    table->elements[had] = (PlyElement){.name = mem_text(words[1]), .count = rows};
    if (strcmp(words[1], "vertex") == 0) table->vertex = (int)had;
    return true;
}

static bool read_property(PlyTable *table, char **words, int count) {
    if (table->element_count == 0) return fail_line(table, "a property before the first element");
    PlyElement *element = &table->elements[table->element_count - 1];
    PlyProperty property = {.is_list = count > 1 && strcmp(words[1], "list") == 0};
    if (count != (property.is_list ? 5 : 3))
        return fail_line(table, "want \"property TYPE NAME\" or \"property list TYPE TYPE NAME\"");
    if (!parse_type(words[count - 2], &property.type) ||
        (property.is_list && (!parse_type(words[2], &property.count_type) || ply_type_is_float(property.count_type))))
        return fail_line(table, "unknown number type");
    for (int i = 0; i < element->property_count; i++)
        if (strcmp(element->properties[i].name, words[count - 1]) == 0)
            return fail_line(table, "a second property of the same name");
    if (element->property_count == PROPERTIES_MAX) return fail_line(table, "more than 4096 properties");
    property.name = mem_text(words[count - 1]);
    size_t had = (size_t)element->property_count++;
    element->properties = mem_resize(element->properties, had, had + 1, sizeof property);
    element->properties[had] = property;
    return true;
}

static bool check_complete(const PlyTable *table, bool has_format) {
    if (!has_format) return fail("cannot read %s: its header has no \"format\" line; is it a PLY file?", table->path);
    if (table->vertex < 0 || table->elements[table->vertex].property_count == 0)
        return fail("cannot read %s: its header has no element \"vertex\" with properties; a mesh or cloud of "
                    "another kind?",
                    table->path);
    return true;
}

bool ply_header_read(PlyTable *table) {
    table->vertex = -1;
    char magic[4] = "";
    size_t got = fread(magic, 1, 4, table->stream);
    if (got < 4 || memcmp(magic, "ply", 3) != 0 || (magic[3] != '\n' && magic[3] != '\r'))
        return fail("cannot read %s: it does not begin with \"ply\"; is it a PLY file?", table->path);
    rewind(table->stream);
    ply_header_line(table);
    for (bool has_format = false; table->line < LINES_MAX;) {
        long length = ply_header_line(table);
        if (length < 0)
            return fail("cannot read %s: it ends in its header, after line %ld; is the file complete?", table->path,
                        table->line);
        if (length > LINE_BYTES_MAX || memchr(table->text, 0, (size_t)length))
            return fail_line(table, "not a line of text");
        char *words[WORDS_MAX];
        int count = split(table->text, words);
        if (count == 0 || strcmp(words[0], "comment") == 0 || strcmp(words[0], "obj_info") == 0) continue;
        bool ok;
        if (strcmp(words[0], "end_header") == 0) return check_complete(table, has_format);
        if (strcmp(words[0], "format") == 0)
            ok = has_format = read_format(table, words, count);
        else if (strcmp(words[0], "element") == 0)
            ok = read_element(table, words, count);
        else if (strcmp(words[0], "property") == 0)
            ok = read_property(table, words, count);
        else
            ok = fail_line(table, "unknown keyword");
        if (!ok) return false;
    }
    return fail("cannot read %s: its header has no end; is it a PLY file?", table->path);
}
