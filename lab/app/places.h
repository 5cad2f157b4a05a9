// places.h - where the controls of a window are, as a file, for scripts that click.
#ifndef SPLATLAB_LAB_APP_PLACES_H
#define SPLATLAB_LAB_APP_PLACES_H

#include "lab/app/screen.h"

#include <stdbool.h>

typedef struct {
    const char *name;
    double value;
} PlacesNumber;

// Writes { "marks": ..., "NUMBER": ..., "canvas": [x, y, width, height], ... } to the path when it is another text than
// *written, which it becomes (owned by the caller, NULL at first). In what the window system counts; marks: screen_marks(); count
// numbers that scripts may want besides. path "": nothing happens.
bool places_write(const char *path, char **written, const Screen *screen, const PlacesNumber *numbers, int count);

// Writes the text to the path when it is another than *written, likewise.
bool places_write_text(const char *path, char **written, const char *text);

#endif
