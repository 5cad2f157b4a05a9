// cmd_widget.c - `splatlab widget`: the 2-D lesson in a window.
#include "lab/app/commands.h"
#include "lab/app/widget.h"
#include "lab/app/window_options.h"
#include "lab/base/mem.h"
#include "splat2d/scene2d_json.h"

static bool show(const WindowOptions *o, const char *path) {
    Scene2d scene = {0};
    if (!window_options_check(o, "widget")) return false;
    if (!path)
        scene = scene2d_default();
    else if (!scene2d_load(path, &scene))
        return false;
    ScreenOptions screen_options = window_options_screen(o, "splatlab - Gaussians in the plane");
    Screen *screen = screen_open(&screen_options);
    if (!screen) {
        scene2d_destroy(&scene);
        return false;
    }
    Widget *widget = mem_alloc(1, sizeof *widget);
    widget_begin(widget, screen, scene, path ? path : "scene.json");
    widget->state_path = o->state_file;
    widget->places_path = o->places_file;
    bool good = widget_loop(widget);
    widget_end(widget);
    mem_free(widget);
    screen_close(screen);
    return good;
}

static int cmd_widget(int argc, char **argv) {
    const WindowOptions defaults = {0};
    OptionField fields[WINDOW_OPTION_COUNT];
    const OptionTable table = {fields, WINDOW_OPTION_COUNT, &defaults};
    WindowOptions options = defaults;
    const char *path = NULL;
    int count, exit_code;
    window_options_fields(0, fields);
    if (!command_line_parse(&CMD_WIDGET, &table, argc, argv, &options, &path, 1, &count, &exit_code)) return exit_code;
    return show(&options, path) ? 0 : command_failed();
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
