// window_options.c - the shared part of the option tables of commands with a window.
#include "lab/app/window_options.h"

#include "lab/app/output_path.h"
#include "lab/base/fail.h"

#include <string.h>

static const OptionField FIELDS[WINDOW_OPTION_COUNT] = {
    {.name = "size",
     .type = OPTION_SIZE,
     .offset = offsetof(WindowOptions, size),
     .low = 320,
     .high = 16384,
     .unit = "points",
     .help = "of the window; 0x0: chosen for the display"},
    {.name = "ui-scale",
     .type = OPTION_DOUBLE,
     .offset = offsetof(WindowOptions, ui_scale),
     .low = 0,
     .high = 4,
     .unit = "px a point",
     .help = "sharpness of a screen of high resolution, 2 as a rule; 0: what the display says"},
    {.name = "frames",
     .type = OPTION_INT,
     .offset = offsetof(WindowOptions, frames),
     .low = 0,
     .high = 1e9,
     .unit = "frames",
     .help = "end after so many; 0: when the window is closed",
     .section = "For scripts"},
    {.name = "screenshot",
     .type = OPTION_TEXT,
     .offset = offsetof(WindowOptions, screenshot),
     .help = "a .png or .jpg of the last of --frames"},
    {.name = "state-file",
     .type = OPTION_TEXT,
     .offset = offsetof(WindowOptions, state_file),
     .help = "a .json file: the scene, written after each change"},
    {.name = "places-file",
     .type = OPTION_TEXT,
     .offset = offsetof(WindowOptions, places_file),
     .help = "a .json file: where each control is in the window, for scripts that click; F12 adds 1 to its \"marks\""},
};

void window_options_fields(size_t offset, OptionField fields[WINDOW_OPTION_COUNT]) {
    memcpy(fields, FIELDS, sizeof FIELDS);
    for (int i = 0; i < WINDOW_OPTION_COUNT; i++) fields[i].offset += offset;
}

bool window_options_check(const WindowOptions *o, const char *command) {
    static const char *const pictures[] = {".png", ".jpg", NULL}, *const documents[] = {".json", NULL};
    if (o->ui_scale > 0 && o->ui_scale < 0.5)
        return fail_usage("%s: --ui-scale %g: want 0, or 0.5 to 4", command, o->ui_scale);
    if (o->screenshot[0] && o->frames == 0)
        return fail_usage("%s: --screenshot is taken of the last frame; say which with --frames N", command);
    return (!o->screenshot[0] || output_path_check("screenshot", o->screenshot, pictures)) &&
           (!o->state_file[0] || output_path_check("state-file", o->state_file, documents)) &&
           (!o->places_file[0] || output_path_check("places-file", o->places_file, documents));
}

ScreenOptions window_options_screen(const WindowOptions *o, const char *title) {
    return (ScreenOptions){.title = title,
                           .size = {o->size[0], o->size[1]},
                           .density = o->ui_scale,
                           .frames = o->frames,
                           .screenshot = o->screenshot};
}
