// cmd_widget.c - `splatlab widget`: the 2-D lesson in a window.
#include "lab/app/commands.h"
#include "lab/app/output_path.h"
#include "lab/app/widget.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "splat2d/scene2d_json.h"

typedef struct {
    int size[2];
    int frames;
    char screenshot[OPTION_TEXT_BYTES];
    char state_file[OPTION_TEXT_BYTES];
    char places_file[OPTION_TEXT_BYTES];
} Options;

static const OptionField FIELDS[] = {
    {.name = "size",
     .type = OPTION_SIZE,
     .offset = offsetof(Options, size),
     .low = 320,
     .high = 16384,
     .unit = "px",
     .help = "of the window; chosen for the display when not given"},
    {.name = "frames",
     .type = OPTION_INT,
     .offset = offsetof(Options, frames),
     .low = 0,
     .high = 1e9,
     .unit = "frames",
     .help = "end after so many; 0: when the window is closed",
     .section = "For scripts"},
    {.name = "screenshot",
     .type = OPTION_TEXT,
     .offset = offsetof(Options, screenshot),
     .help = "a .png or .jpg of the last of --frames"},
    {.name = "state-file",
     .type = OPTION_TEXT,
     .offset = offsetof(Options, state_file),
     .help = "a .json file: the scene, written after each change"},
    {.name = "places-file",
     .type = OPTION_TEXT,
     .offset = offsetof(Options, places_file),
     .help = "a .json file: where each control is in the window, for scripts that click"},
};

static bool check(const Options *o) {
    static const char *const pictures[] = {".png", ".jpg", NULL}, *const documents[] = {".json", NULL};
    if (o->screenshot[0] && o->frames == 0)
        return fail_usage("widget: --screenshot is taken of the last frame; say which with --frames N");
    return (!o->screenshot[0] || output_path_check("screenshot", o->screenshot, pictures)) &&
           (!o->state_file[0] || output_path_check("state-file", o->state_file, documents)) &&
           (!o->places_file[0] || output_path_check("places-file", o->places_file, documents));
}

static bool show(const Options *o, Scene2d scene, const char *path) {
    ScreenOptions screen_options = {.title = "splatlab - Gaussians in the plane",
                                    .size = {o->size[0], o->size[1]},
                                    .frames = o->frames,
                                    .screenshot = o->screenshot};
    Screen *screen = screen_open(&screen_options);
    if (!screen) {
        scene2d_destroy(&scene);
        return false;
    }
    Widget *widget = mem_alloc(1, sizeof *widget);
    widget_begin(widget, screen, scene, path ? path : "scene.json");
    widget->state_path = o->state_file;
    widget->places_path = o->places_file;
    bool good = true;
    while (good && screen_begin(screen, false)) {
        good = widget_frame(widget);
        good = screen_end(screen) && good;
    }
    widget_end(widget);
    mem_free(widget);
    screen_close(screen);
    return good;
}

static int cmd_widget(int argc, char **argv) {
    const Options defaults = {0};
    const OptionTable table = {FIELDS, sizeof FIELDS / sizeof FIELDS[0], &defaults};
    Options options = defaults;
    const char *path = NULL;
    int count, exit_code;
    if (!command_line_parse(&CMD_WIDGET, &table, argc, argv, &options, &path, 1, &count, &exit_code)) return exit_code;
    if (!check(&options)) return command_failed();
    Scene2d scene = {0};
    if (!path)
        scene = scene2d_default();
    else if (!scene2d_load(path, &scene))
        return command_failed();
    return show(&options, scene, path) ? 0 : command_failed();
}

const Command CMD_WIDGET = {
    .name = "widget",
    .arguments = "[SCENE.json]",
    .summary = "the 2-D lesson in a window: blobs to move, stretch, turn and stack",
    .details =
        "F1 in the window shows what the mouse and the keys do. Without SCENE.json it begins with the lesson's six\n"
        "blobs; Save writes to SCENE.json, or to scene.json.",
    .run = cmd_widget,
};
