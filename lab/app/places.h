// places.h - where the controls of a window are, as a file, for scripts that click.
#ifndef SPLATLAB_LAB_APP_PLACES_H
#define SPLATLAB_LAB_APP_PLACES_H

#include "lab/app/screen.h"

#include <stdbool.h>

// Writes { "zoom": zoom, "marks": ..., "canvas": [x, y, width, height], ... } to the path when it is another text than
// *written, which it becomes (owned by the caller, NULL at first). In points of the window; zoom: points a canvas px has;
// marks: screen_marks(). path "": nothing happens.
bool places_write(const char *path, char **written, const Screen *screen, double zoom);

// Writes the text to the path when it is another than *written, likewise.
bool places_write_text(const char *path, char **written, const char *text);

#endif
