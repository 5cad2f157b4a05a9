// readout.c - label and value.
#include "lab/app/readout.h"

#include "lab/app/palette.h"

#include <stdarg.h>
#include <stdio.h>

void readout(const char *label, GuiColour colour, const char *format, ...) {
    char value[128];
    va_list values;
    va_start(values, format);
    vsnprintf(value, sizeof value, format, values);
    va_end(values);
    gui_text(GUI_SMALL, INK_QUIET, "%s", label);
    gui_same_line(0);
    GuiRect place = gui_take(gui_width_left(), gui_text_height(GUI_SMALL));
    double width = gui_text_width(GUI_MONO_SMALL, value);
    gui_draw_text(GUI_MONO_SMALL, place.x + place.width - width, place.y, colour, "%s", value);
}
