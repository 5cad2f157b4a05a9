// output_path.c - checks on a file name that nothing has been written to yet.
#include "lab/app/output_path.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"

#include <stdio.h>
#include <string.h>

static bool check_ending(const char *option, const char *path, const char *const *endings) {
    char known[128] = "";
    for (int i = 0; endings[i]; i++) {
        if (file_has_ending(path, endings[i])) return true;
        size_t length = strlen(known);
        snprintf(known + length, sizeof known - length, "%s%s", i ? " or " : "", endings[i]);
    }
    return fail_usage("--%s %s: the name must end in %s", option, path, known);
}

bool output_path_check(const char *option, const char *path, const char *const *endings) {
    if (!check_ending(option, path, endings)) return false;
    if (file_is_folder(path)) return fail("cannot write %s: it is a folder; give the name of a file", path);
    char *folder = file_folder_of(path);
    bool good = file_can_write_in(folder);
    if (!good) fail_context("cannot write %s", path);
    mem_free(folder);
    return good;
}

char *output_path_numbered(const char *path, int number) {
    const char *name = strrchr(path, '/');
    const char *dot = strrchr(name ? name : path, '.');
    int stem = dot ? (int)(dot - path) : (int)strlen(path);
    return mem_format("%.*s_%04d%s", stem, path, number, dot ? dot : "");
}
