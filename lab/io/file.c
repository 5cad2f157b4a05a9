// file.c - whole files in and out, and the few questions about folders that the program asks.
#include "lab/io/file.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <sha256.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

// The next action for the commonest reasons why a file cannot be had.
static const char *hint(int error) {
    switch (error) {
    case ENOENT:
        return "; is the path right?";
    case EACCES:
    case EPERM:
        return "; check the permissions (ls -l)";
    case EROFS:
        return "; choose a folder that can be written";
    case ENOSPC:
    case EDQUOT:
        return "; free some space or choose another disk";
    case EFBIG:
        return "; the limit on file sizes (ulimit -f) is too small";
    case EMFILE:
        return "; too many files are open (ulimit -n)";
    default:
        return "";
    }
}

static bool fail_errno(const char *what, const char *path, int error) {
    return fail("cannot %s %s: %s%s", what, path, strerror(error), hint(error));
}

// ---- reading ----

// Grows as it reads, so that pipes work too; `expected` is what stat() says and only a first guess.
static bool read_stream(FILE *stream, const char *path, size_t expected, char **data, size_t *size) {
    size_t capacity = expected + 2, used = 0; // one byte more than the file, so that its end is seen without growing
    char *bytes = mem_alloc(capacity, 1);
    for (;;) {
        used += fread(bytes + used, 1, capacity - 1 - used, stream);
        if (ferror(stream)) {
            int error = errno;
            mem_free(bytes);
            return fail_errno("read", path, error);
        }
        if (feof(stream)) break;
        if (used == capacity - 1) {
            bytes = mem_resize(bytes, capacity, 2 * capacity, 1);
            capacity *= 2;
        }
    }
    bytes[used] = 0;
    *data = bytes;
    *size = used;
    return true;
}

bool file_read(const char *path, char **data, size_t *size) {
    *data = NULL;
    *size = 0;
    if (file_is_folder(path)) return fail("cannot read %s: it is a folder, and a file is wanted", path);
    FILE *stream = fopen(path, "rb");
    if (!stream) return fail_errno("read", path, errno);
    struct stat info;
    size_t expected = fstat(fileno(stream), &info) == 0 && S_ISREG(info.st_mode) ? (size_t)info.st_size : 65536;
    bool ok = read_stream(stream, path, expected, data, size);
    fclose(stream);
    return ok;
}

// ---- writing ----

// A device or pipe must not be replaced by a file (rename would do it), and a folder cannot be.
static bool check_target(const char *path) {
    struct stat info;
    if (stat(path, &info) != 0 || S_ISREG(info.st_mode)) return true;
    if (S_ISDIR(info.st_mode)) return fail("cannot write %s: it is a folder; give the name of a file", path);
    return fail("cannot write %s: it is no ordinary file; give another name", path);
}

static bool sync_and_rename(const char *temporary, const char *path) {
    if (!check_target(path)) return false;
    int file = open(temporary, O_RDONLY | O_CLOEXEC);
    if (file < 0) return fail_errno("write", path, errno);
    int error = fsync(file) != 0 ? errno : 0;
    close(file);
    if (!error && rename(temporary, path) != 0) error = errno;
    if (error) return fail_errno("write", path, error);

    char *folder = file_folder_of(path);
    int handle = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    mem_free(folder);
    if (handle >= 0) { // some file systems cannot sync a folder; the file itself is safe all the same
        fsync(handle);
        close(handle);
    }
    return true;
}

bool file_begin(FileWriter *writer, const char *path) {
    *writer = (FileWriter){0};
    if (!check_target(path)) return false;
    char *temporary = mem_format("%s.tmp-%ld", path, (long)getpid());
    FILE *stream = fopen(temporary, "wb");
    if (!stream) {
        int error = errno;
        mem_free(temporary);
        return fail_errno("write", path, error);
    }
    *writer = (FileWriter){.stream = stream, .path = mem_text(path), .temporary = temporary};
    return true;
}

bool file_commit(FileWriter *writer) {
    errno = 0;
    bool had_error = ferror(writer->stream) != 0;
    int error = fflush(writer->stream) != 0 ? errno : 0;
    if (fclose(writer->stream) != 0 && !error) error = errno;
    writer->stream = NULL;
    bool ok;
    if (error)
        ok = fail_errno("write", writer->path, error);
    else if (had_error) // errno of the write that failed is gone by now
        ok = fail("cannot write %s: the disk took only a part; is it full?", writer->path);
    else
        ok = sync_and_rename(writer->temporary, writer->path);
    if (ok) {
        mem_free(writer->temporary);
        writer->temporary = NULL;
    }
    file_abandon(writer);
    return ok;
}

void file_abandon(FileWriter *writer) {
    if (writer->stream) fclose(writer->stream);
    if (writer->temporary) unlink(writer->temporary);
    mem_free(writer->temporary);
    mem_free(writer->path);
    *writer = (FileWriter){0};
}

bool file_write(const char *path, const void *data, size_t size) {
    FileWriter writer;
    if (!file_begin(&writer, path)) return false;
    fwrite(data, 1, size, writer.stream);
    return file_commit(&writer);
}

// ---- folders and names ----

bool file_exists(const char *path) {
    struct stat info;
    return stat(path, &info) == 0;
}

bool file_is_folder(const char *path) {
    struct stat info;
    return stat(path, &info) == 0 && S_ISDIR(info.st_mode);
}

bool file_make_folder(const char *path) {
    char *part = mem_text(path);
    bool ok = true;
    // Each '/' in turn ends a parent; the last round makes the whole path.
    for (char *end = part; ok && *end; end++) {
        while (*end == '/') end++;
        while (*end && *end != '/') end++;
        char kept = *end;
        *end = 0;
        int error = mkdir(part, 0777) != 0 ? errno : 0;
        if (error && !file_is_folder(part))
            ok = error == EEXIST ? fail("cannot make folder %s: a file of that name is in the way", part)
                                 : fail_errno("make folder", part, error);
        *end = kept;
        if (!kept) break;
    }
    mem_free(part);
    return ok;
}

bool file_can_write_in(const char *folder) {
    if (!file_exists(folder)) return fail("cannot write in %s: there is no such folder; make it first", folder);
    if (!file_is_folder(folder)) return fail("cannot write in %s: it is a file, and a folder is wanted", folder);
    char *probe = mem_format("%s/.tmp-%ld", folder, (long)getpid());
    int file = open(probe, O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    int error = errno;
    if (file >= 0) {
        close(file);
        unlink(probe);
    }
    mem_free(probe);
    return file >= 0 || fail_errno("write in", folder, error);
}

char *file_join(const char *folder, const char *name) {
    if (name[0] == '/') return mem_text(name);
    size_t length = strlen(folder);
    return mem_format(length > 0 && folder[length - 1] == '/' ? "%s%s" : "%s/%s", folder, name);
}

char *file_folder_of(const char *path) {
    const char *slash = strrchr(path, '/');
    if (!slash) return mem_text(".");
    if (slash == path) return mem_text("/");
    return mem_format("%.*s", (int)(slash - path), path);
}

bool file_has_ending(const char *path, const char *ending) {
    size_t length = strlen(path), tail = strlen(ending);
    return length >= tail && strcasecmp(path + length - tail, ending) == 0;
}

static int compare_texts(const void *a, const void *b) { return strcmp(*(char *const *)a, *(char *const *)b); }

bool file_list(const char *folder, char ***names, int *count) {
    *names = NULL;
    *count = 0;
    DIR *handle = opendir(folder);
    if (!handle) return fail_errno("list folder", folder, errno);
    int capacity = 0;
    for (struct dirent *entry; (entry = readdir(handle));) {
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0) continue;
        if (*count == capacity) {
            int grown = capacity ? 2 * capacity : 64;
            *names = mem_resize(*names, (size_t)capacity, (size_t)grown, sizeof **names);
            capacity = grown;
        }
        (*names)[(*count)++] = mem_text(entry->d_name);
    }
    closedir(handle);
    if (*count) qsort(*names, (size_t)*count, sizeof **names, compare_texts);
    return true;
}

void file_list_free(char **names, int count) {
    for (int i = 0; i < count; i++) mem_free(names[i]);
    mem_free(names);
}

bool file_sha256(const char *path, char hex[65]) {
    if (file_is_folder(path)) return fail("cannot read %s: it is a folder, and a file is wanted", path);
    if (!SHA256File(path, hex)) return fail_errno("read", path, errno);
    return true;
}
