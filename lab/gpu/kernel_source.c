// Kernel text is put together here and not by the driver's -I: options are split at spaces, so that a folder with a
// space in its name would not work, and one file of an overriding folder could not include the files of the usual one.

#include "lab/gpu/opencl.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { INCLUDE_DEPTH_MAX = 8 };

static char *set_folder; // of gpu_set_kernel_folder(), for the life of the process

void gpu_set_kernel_folder(const char *folder) {
    mem_free(set_folder);
    set_folder = folder ? mem_text(folder) : NULL;
}

// "FOLDER OF THE RUNNING PROGRAM/kernels"; owned by the caller.
static char *folder_beside_program(void) {
    char program[4096];
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    if (length <= 0) return mem_text("kernels");
    program[length] = 0;
    char *slash = strrchr(program, '/');
    if (slash) *slash = 0;
    return mem_format("%s/kernels", program);
}

bool gpu_kernel_path(const char *file, char **path) {
    char *beside = folder_beside_program();
    const char *folders[] = {set_folder, getenv("SPLATLAB_KERNELS"), beside, "kernels", SPLATLAB_INSTALLED_KERNELS};
    char *looked = mem_text("");
    *path = NULL;
    for (size_t i = 0; i < sizeof folders / sizeof *folders && !*path; i++) {
        if (!folders[i] || !folders[i][0]) continue;
        char *candidate = mem_format("%s/%s", folders[i], file);
        if (access(candidate, R_OK) == 0) {
            *path = candidate;
            continue;
        }
        mem_free(candidate);
        char *longer = mem_format("%s%s%s", looked, looked[0] ? ", " : "", folders[i]);
        mem_free(looked);
        looked = longer;
    }
    if (!*path)
        fail("cannot find the kernel file %s in %s; set SPLATLAB_KERNELS to the folder that holds it", file, looked);
    mem_free(looked);
    mem_free(beside);
    return *path != NULL;
}

static bool read_text(const char *path, char **text) {
    FILE *stream = fopen(path, "rb");
    if (!stream) return fail("cannot open the kernel file %s: %s", path, strerror(errno));
    size_t size = 0, capacity = 1 << 14;
    char *data = mem_alloc(capacity, 1);
    size_t got;
    while ((got = fread(data + size, 1, capacity - size - 1, stream)) > 0) {
        size += got;
        if (size + 1 < capacity) continue;
        data = mem_resize(data, capacity, 2 * capacity, 1);
        capacity *= 2;
    }
    bool good = !ferror(stream);
    fclose(stream);
    data[size] = 0;
    *text = data;
    if (good) return true;
    mem_free(data);
    *text = NULL;
    return fail("cannot read the kernel file %s: %s", path, strerror(errno));
}

// Is the line `#include "name"`? Then its name, at most size - 1 characters.
static bool line_is_include(const char *line, char *name, size_t size) {
    line += strspn(line, " \t");
    if (*line++ != '#') return false;
    line += strspn(line, " \t");
    if (strncmp(line, "include", 7)) return false;
    line += 7;
    line += strspn(line, " \t");
    if (*line++ != '"') return false;
    size_t length = strcspn(line, "\"\n");
    if (line[length] != '"' || length == 0 || length >= size) return false;
    memcpy(name, line, length);
    name[length] = 0;
    return true;
}

static bool append_file(FILE *out, const char *file, int depth) {
    char *path = NULL, *text = NULL;
    if (depth > INCLUDE_DEPTH_MAX)
        return fail("%s: includes go deeper than %d files; does a file include itself?", file, INCLUDE_DEPTH_MAX);
    if (!gpu_kernel_path(file, &path)) return false;
    bool good = read_text(path, &text);
    fprintf(out, "#line 1 \"%s\"\n", path);
    int line_number = 0;
    for (char *line = text; good && line && *line;) {
        char name[256];
        size_t length = strcspn(line, "\n");
        line_number++;
        if (line_is_include(line, name, sizeof name)) {
            good = append_file(out, name, depth + 1);
            if (!good) fail_context("%s, line %d", path, line_number);
            fprintf(out, "\n#line %d \"%s\"\n", line_number + 1, path);
        } else {
            fwrite(line, 1, length, out);
            fputc('\n', out);
        }
        line += length + (line[length] == '\n');
    }
    mem_free(text);
    mem_free(path);
    return good;
}

bool kernel_source_read(const char *file, char **text) {
    char *gathered = NULL;
    size_t size = 0;
    *text = NULL;
    FILE *out = open_memstream(&gathered, &size);
    if (!out) return fail("cannot gather the kernel file %s: %s", file, strerror(errno));
    bool good = append_file(out, file, 0);
    fclose(out);
    if (good) *text = mem_text(gathered);
    free(gathered);
    return good;
}
