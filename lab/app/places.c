// places.c - the file that scripts wait for and read.
#include "lab/app/places.h"

#include "lab/app/gui.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool places_write_text(const char *path, char **written, const char *text) {
    if (!path[0] || (*written && strcmp(text, *written) == 0)) return true;
    if (!file_write(path, text, strlen(text))) return false;
    mem_free(*written);
    *written = mem_text(text);
    return true;
}

bool places_write(const char *path, char **written, const Screen *screen, const PlacesNumber *numbers, int count) {
    if (!path[0]) return true;
    char *text = NULL;
    const char *label;
    size_t size = 0;
    GuiRect r;
    FILE *out = open_memstream(&text, &size);
    if (!out) return fail("cannot note where the controls are: out of memory");
    fprintf(out, "{\n  \"marks\": %ld", screen_marks(screen));
    for (int i = 0; i < count; i++) fprintf(out, ",\n  \"%s\": %.17g", numbers[i].name, numbers[i].value);
    for (int i = 0; gui_place(i, &label, &r); i++)
        if (!strpbrk(label, "\"\\"))
            fprintf(out, ",\n  \"%s\": [%.9g, %.9g, %.9g, %.9g]", label, r.x, r.y, r.width, r.height);
    fprintf(out, "\n}\n");
    fclose(out);
    bool good = places_write_text(path, written, text);
    free(text);
    return good;
}
