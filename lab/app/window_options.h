// window_options.h - the options that every command with a window has: its size, and what scripts need.
#ifndef SPLATLAB_LAB_APP_WINDOW_OPTIONS_H
#define SPLATLAB_LAB_APP_WINDOW_OPTIONS_H

#include "lab/app/screen.h"
#include "lab/base/options.h"

#include <stdbool.h>

typedef struct {
    int size[2];     // 0 0: chosen for the display
    double ui_scale; // px per point; 0: what the display says
    int frames;      // 0: until the window is closed
    char screenshot[OPTION_TEXT_BYTES];
    char state_file[OPTION_TEXT_BYTES];
    char places_file[OPTION_TEXT_BYTES];
} WindowOptions;

enum { WINDOW_OPTION_COUNT = 6 };

// Their part of a command's table; offset: of the WindowOptions within the command's own struct.
void window_options_fields(size_t offset, OptionField fields[WINDOW_OPTION_COUNT]);

// Can the files be written, and do the options agree? command begins the messages.
bool window_options_check(const WindowOptions *options, const char *command);

// What screen_open() is told; borrows the texts.
ScreenOptions window_options_screen(const WindowOptions *options, const char *title);

#endif
