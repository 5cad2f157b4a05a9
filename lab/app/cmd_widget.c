// cmd_widget.c - `splatlab widget`: the 2-D lesson in a window.
#include "lab/app/commands.h"
#include "lab/app/widget.h"
#include "lab/app/widget_speed.h"
#include "lab/app/window_options.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "splat2d/scene2d_json.h"

#include <string.h>

typedef struct {
    WindowOptions window;
    bool mine, speed, json;
} Options;

static const OptionField OWN_FIELDS[] = {
    {.name = "mine",
     .type = OPTION_FLAG,
     .offset = offsetof(Options, mine),
     .help = "draw with your own functions, those of exercises E01, E02, E04 and E05 that pass; V swaps them",
     .section = "Your own code"},
    {.name = "speed",
     .type = OPTION_FLAG,
     .offset = offsetof(Options, speed),
     .help = "instead: how many frames a second this machine makes, of the scene and of 200 blobs",
     .section = "Speed"},
    {OPTION_JSON_OF(Options, "the speeds")},
};
enum { OWN_FIELD_COUNT = sizeof OWN_FIELDS / sizeof OWN_FIELDS[0] };

static bool measure(const WindowOptions *o, const Scene2d *scene, bool as_json) {
    ScreenOptions screen_options = window_options_screen(o, "splatlab - measuring");
    return widget_speed(scene, &screen_options, as_json);
}

static bool show(const WindowOptions *o, Scene2d scene, const char *path, Mine *mine) {
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
    widget->mine = mine;
    widget->shows_mine = mine != NULL;
    bool good = widget_loop(widget);
    widget_end(widget);
    mem_free(widget);
    screen_close(screen);
    return good;
}

static bool show_mine(const WindowOptions *o, Scene2d scene, const char *path) {
    Mine *mine = mine_open();
    if (!mine) {
        scene2d_destroy(&scene);
        return false;
    }
    bool good = show(o, scene, path, mine);
    mine_close(mine);
    return good;
}

static bool run_widget(const Options *o, const char *path) {
    Scene2d scene = {0};
    if (o->mine && o->speed) return fail_usage("widget: --speed measures the rasterizer; leave --mine away");
    if (o->json && !o->speed) return fail_usage("widget: --json goes with --speed");
    if (o->speed && (o->window.frames || o->window.state_file[0] || o->window.places_file[0]))
        return fail_usage("widget: --speed draws its own frames; it goes with --size, --ui-scale and --json alone");
    if (!window_options_check(&o->window, "widget")) return false;
    if (!path)
        scene = scene2d_default();
    else if (!scene2d_load(path, &scene))
        return false;
    if (o->mine) return show_mine(&o->window, scene, path);
    if (!o->speed) return show(&o->window, scene, path, NULL);
    bool good = measure(&o->window, &scene, o->json);
    scene2d_destroy(&scene);
    return good;
}

static int cmd_widget(int argc, char **argv) {
    const Options defaults = {0};
    OptionField fields[WINDOW_OPTION_COUNT + OWN_FIELD_COUNT];
    const OptionTable table = {fields, WINDOW_OPTION_COUNT + OWN_FIELD_COUNT, &defaults};
    Options options = defaults;
    const char *path = NULL;
    int count, exit_code;
    window_options_fields(offsetof(Options, window), fields);
    memcpy(fields + WINDOW_OPTION_COUNT, OWN_FIELDS, sizeof OWN_FIELDS);
    if (!command_line_parse(&CMD_WIDGET, &table, argc, argv, &options, &path, 1, &count, &exit_code)) return exit_code;
    return run_widget(&options, path) ? 0 : command_failed();
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
