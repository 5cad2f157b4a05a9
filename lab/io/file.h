// file.h - whole files: read into memory, and written so that a reader never sees half of one.
//
// Writing goes to "PATH.tmp-PID" beside the target, then fsync, rename, fsync of the folder: after a crash or a full
// disk there is the old file or the new one, never something between.
#ifndef SPLATLAB_LAB_IO_FILE_H
#define SPLATLAB_LAB_IO_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

// Reads the whole file. *data (owned by the caller, mem_free) has a zero byte behind its end, not counted in *size.
bool file_read(const char *path, char **data, size_t *size);

// A file being written. `stream` takes what is written; errors are noticed in file_commit().
typedef struct {
    FILE *stream;
    char *path;      // where it will stand
    char *temporary; // where it stands now
} FileWriter;

bool file_begin(FileWriter *writer, const char *path);
bool file_commit(FileWriter *writer);  // flush, fsync, rename; on failure the temporary file is removed
void file_abandon(FileWriter *writer); // removes the temporary file; accepts a zeroed or committed writer

// The three in one.
bool file_write(const char *path, const void *data, size_t size);

bool file_exists(const char *path);
bool file_is_folder(const char *path);
bool file_make_folder(const char *path);    // with its parents; fine if it is already there
bool file_can_write_in(const char *folder); // fails with a message when no file can be made there

// folder + "/" + name; owned by the caller. An absolute name comes back alone.
char *file_join(const char *folder, const char *name);
char *file_folder_of(const char *path);                     // "a/b.ply" -> "a", "b.ply" -> "."; owned by the caller
bool file_has_ending(const char *path, const char *ending); // case-insensitive: (".ply")

// The names in a folder, sorted by bytes, without "." and ".."; an array of count texts, all owned by the caller.
bool file_list(const char *folder, char ***names, int *count);
void file_list_free(char **names, int count);

// SHA-256 of a file as 64 hex digits and a zero.
bool file_sha256(const char *path, char hex[65]);

#endif
