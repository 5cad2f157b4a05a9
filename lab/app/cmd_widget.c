// cmd_widget.c - `splatlab widget`: the 2-D lesson in a window.
#include "lab/app/commands.h"
#include "lab/app/widget.h"
#include "lab/app/window_options.h"
#include "lab/base/mem.h"
#include "splat2d/scene2d_json.h"

typedef struct {
    WindowOptions window;
    bool mine;
} Options;

static const OptionField OWN_FIELDS[] = {
    {.name = "mine",
     .type = OPTION_FLAG,
     .offset = offsetof(Options, mine),
     .help = "draw with your own functions, those of exercises E01, E02 and E04 that pass; V swaps them",
     .section = "Your own code"},
};
enum {
    OWN_FIELD_COUNT = sizeof OWN_FIELDS / sizeof OWN_FIELDS[0],
    FIELD_COUNT = OWN_FIELD_COUNT + WINDOW_OPTION_COUNT
};

static bool show_scene(const Options *o, Scene2d scene, const char *path, Mine *mine) {
    ScreenOptions screen_options = window_options_screen(&o->window, "splatlab - Gaussians in the plane");
    Screen *screen = screen_open(&screen_options);
    if (!screen) {
        scene2d_destroy(&scene);
        return false;
    }
    Widget *widget = mem_alloc(1, sizeof *widget);
    widget_begin(widget, screen, scene, path ? path : "scene.json");
    widget->state_path = o->window.state_file;
    widget->places_path = o->window.places_file;
    widget->mine = mine;
    widget->shows_mine = mine != NULL;
    bool good = widget_loop(widget);
    widget_end(widget);
    mem_free(widget);
    screen_close(screen);
    return good;
}

static bool show(const Options *o, const char *path) {
    Scene2d scene = {0};
    Mine *mine = NULL;
    if (!window_options_check(&o->window, "widget")) return false;
    if (!path)
        scene = scene2d_default();
    else if (!scene2d_load(path, &scene))
        return false;
    if (o->mine && !(mine = mine_open())) {
        scene2d_destroy(&scene);
        return false;
    }
    bool good = show_scene(o, scene, path, mine);
    mine_close(mine);
    return good;
}

static int cmd_widget(int argc, char **argv) {
    const Options defaults = {0};
    OptionField fields[FIELD_COUNT];
    const OptionTable table = {fields, FIELD_COUNT, &defaults};
    Options options = defaults;
    const char *path = NULL;
    int count, exit_code;
    for (int i = 0; i < OWN_FIELD_COUNT; i++) fields[i] = OWN_FIELDS[i];
    window_options_fields(offsetof(Options, window), fields + OWN_FIELD_COUNT);
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
