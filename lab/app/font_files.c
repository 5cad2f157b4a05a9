// font_files.c - DejaVu, which has the Greek letters and the signs of mathematics.
#include "lab/app/font_files.h"

#include "lab/base/log.h"
#include "lab/base/mem.h"

#include <stdbool.h>
#include <unistd.h>

static const char *const FOLDERS[] = {"/usr/share/fonts/truetype/dejavu",
                                      "/usr/share/fonts/dejavu-sans-fonts",
                                      "/usr/share/fonts/dejavu-sans-mono-fonts",
                                      "/usr/share/fonts/TTF",
                                      "/usr/share/fonts/dejavu",
                                      "/usr/local/share/fonts",
                                      "/Library/Fonts"};

char *font_file_find(const char *name) {
    static bool warned;
    for (unsigned i = 0; i < sizeof FOLDERS / sizeof FOLDERS[0]; i++) {
        char *path = mem_format("%s/%s", FOLDERS[i], name);
        if (access(path, R_OK) == 0) return path;
        mem_free(path);
    }
    if (!warned)
        log_warn("the font %s is not installed (Debian: fonts-dejavu-core); texts will miss their Greek letters", name);
    warned = true;
    return NULL;
}
