// ply_table.h - the vertices of a PLY file as a table of numbers, read row by row; every format, any columns.
//
// The file is never held whole in memory: a model of a gigabyte costs one row. Elements before the vertices are passed over, with their
// lists; those behind are not looked at. Source: Greg Turk, "The PLY polygon file format" (1994).
#ifndef SPLATLAB_SPLAT3D_PLY_TABLE_H
#define SPLATLAB_SPLAT3D_PLY_TABLE_H

#include <stdbool.h>
#include <stdio.h>

typedef enum { PLY_ASCII, PLY_LITTLE_ENDIAN, PLY_BIG_ENDIAN } PlyFormat;
typedef enum { PLY_INT8, PLY_UINT8, PLY_INT16, PLY_UINT16, PLY_INT32, PLY_UINT32, PLY_FLOAT, PLY_DOUBLE } PlyType;

typedef struct {
    char *name;
    PlyType type;
    bool is_list; // a count, then that many of `type`; in a row its value is the count
    PlyType count_type;
} PlyProperty;

typedef struct {
    char *name;
    long count; // rows
    PlyProperty *properties;
    int property_count;
} PlyElement;

typedef struct {
    char *path;
    FILE *stream;
    PlyFormat format;
    PlyElement *elements; // in the order of the file
    int element_count;
    int vertex;       // index of the element "vertex"
    long row;         // vertices read so far
    long line;        // lines read so far (header, and rows of ascii)
    char *text;       // buffer of the current line
    size_t text_size; // its capacity, bytes
} PlyTable;

// Reads the header, checks the counts against the size of the file, and stands before the first vertex.
bool ply_table_open(const char *path, PlyTable *table);
void ply_table_close(PlyTable *table); // accepts a zeroed or half-built one

int ply_table_rows(const PlyTable *table);
int ply_table_columns(const PlyTable *table);
int ply_table_find(const PlyTable *table, const char *column); // index, or -1
const PlyProperty *ply_table_column(const PlyTable *table, int column);

// The next vertex: one number for each column. Fails at the end of a file that was cut off, and where ascii is no number.
bool ply_table_next(PlyTable *table, double *values);

#endif
