// ply_header.h - the text at the beginning of a PLY file: format, elements and their properties.
#ifndef SPLATLAB_SPLAT3D_PLY_HEADER_H
#define SPLATLAB_SPLAT3D_PLY_HEADER_H

#include "splat3d/ply_table.h"

// Reads from table->stream up to and with "end_header"; fills format, elements and vertex.
bool ply_header_read(PlyTable *table);

// Reads one line into table->text without its end (\n or \r\n), counts it, and says how long it is; -1 at the end of the file.
long ply_header_line(PlyTable *table);

int ply_type_bytes(PlyType type);
bool ply_type_is_float(PlyType type);

#endif
