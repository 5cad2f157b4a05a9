// cmd_demo.c - `splatlab demo`: a lecture's demo, in a window or as one picture a step.
#include "lab/app/commands.h"
#include "lab/app/widget.h"
#include "lab/app/window_options.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "lab/io/json_io.h"

#include <stdio.h>

typedef struct {
    WindowOptions window;
    int step;
    bool headless, json;
    char output[OPTION_TEXT_BYTES];
} Options;

static const OptionField OWN_FIELDS[] = {
    {.name = "headless",
     .type = OPTION_FLAG,
     .offset = offsetof(Options, headless),
     .help = "no window: each step is written as a picture, with the numbers in steps.json",
     .section = "Without a display"},
    {.name = "output",
     .letter = 'o',
     .type = OPTION_TEXT,
     .offset = offsetof(Options, output),
     .help = "folder for the pictures; made when it is not there"},
    {.name = "json",
     .type = OPTION_FLAG,
     .offset = offsetof(Options, json),
     .help = "what steps.json holds, on stdout"},
    {.name = "step",
     .type = OPTION_INT,
     .offset = offsetof(Options, step),
     .low = 1,
     .high = DEMO_STEPS_MAX,
     .help = "the step that a window begins with",
     .section = "Window"},
};
enum {
    OWN_FIELD_COUNT = sizeof OWN_FIELDS / sizeof OWN_FIELDS[0],
    FIELD_COUNT = OWN_FIELD_COUNT + WINDOW_OPTION_COUNT,
    HEADLESS_WIDTH = 1600,
    HEADLESS_HEIGHT = 1000,
    SETTLING_FRAMES = 3, // of a step before its picture: controls know their places from the frame before
};

// ---- headless ----

static json_t *walk_numbers(const PsdWalk *walk) {
    Sym2 covariance = psd_walk_covariance(walk);
    Eigen2 eigen = sym2_eigen(covariance);
    return json_pack("{si sf sf sf s[fff]}", "steps", walk->step, "loss", walk->loss[walk->step], "eigenvalue_major",
                     eigen.major, "eigenvalue_minor", eigen.minor, "covariance", covariance.xx, covariance.xy,
                     covariance.yy);
}

static double mean_visits(const Widget *widget) {
    double sum = 0;
    int pixels = widget->picture.width * widget->picture.height;
    for (int i = 0; i < pixels; i++) sum += widget->maps.visits[i];
    return pixels > 0 ? sum / pixels : 0;
}

// What the step shows, in numbers.
static json_t *step_numbers(const Widget *widget, const char *picture) {
    const WalkResult *walked = &widget->walked;
    json_t *numbers = json_pack("{ss ss}", "picture", picture, "caption", widget->demo->steps[widget->step].caption);
    if (widget->page == PAGE_TRAP) {
        json_object_set_new(numbers, "raw", walk_numbers(&widget->trap->trap.walks[PSD_RAW]));
        json_object_set_new(numbers, "factored", walk_numbers(&widget->trap->trap.walks[PSD_FACTORED]));
        return numbers;
    }
    json_object_update_new(numbers, json_pack("{si s[ff] s[fff] sf sf si sf sf}", "gaussians", widget->scene.count,
                                              "probe", widget->probe[0], widget->probe[1], "rgb", walked->rgb[0],
                                              walked->rgb[1], walked->rgb[2], "transmittance", walked->transmittance,
                                              "weights", walked->weights, "blended", walked->blended, "mean_opacity",
                                              widget->mean_opacity, "mean_blobs_read", mean_visits(widget)));
    if (widget->demo->steps[widget->step].compare_to >= 0)
        json_object_set_new(numbers, "psnr", json_real(widget->psnr));
    return numbers;
}

static bool write_step(Widget *widget, int step, const char *folder, json_t *list) {
    char *name = mem_format("step_%02d.png", step + 1), *path = file_join(folder, name);
    bool good = true;
    widget_show_step(widget, step);
    for (int i = 0; good && i < SETTLING_FRAMES; i++) {
        screen_begin(widget->screen, true);
        good = widget_frame(widget) && screen_end(widget->screen);
    }
    good = good && screen_save(widget->screen, path);
    json_array_append_new(list, step_numbers(widget, name));
    mem_free(name);
    mem_free(path);
    return good;
}

static bool write_steps(Widget *widget, const char *folder, bool print) {
    if (!file_make_folder(folder) || !file_can_write_in(folder)) return false;
    json_t *list = json_array();
    bool good = true;
    for (int step = 0; good && step < widget->demo->count; step++) good = write_step(widget, step, folder, list);
    json_t *root = json_pack("{ss so}", "title", widget->demo->title, "steps", list);
    char *path = file_join(folder, "steps.json");
    good = good && json_write(path, root);
    if (good && print) json_print(root);
    json_decref(root);
    mem_free(path);
    return good;
}

// ---- both ----

static bool show(const Options *o, Demo *demo) {
    ScreenOptions screen_options = window_options_screen(&o->window, "splatlab - demo");
    screen_options.headless = o->headless;
    if (o->headless && screen_options.size[0] == 0)
        screen_options.size[0] = HEADLESS_WIDTH, screen_options.size[1] = HEADLESS_HEIGHT;
    Screen *screen = screen_open(&screen_options);
    if (!screen) return false;
    Widget *widget = mem_alloc(1, sizeof *widget);
    widget_begin(widget, screen, scene2d_copy(&demo->steps[0].scene), "scene.json");
    widget->demo = demo;
    widget->state_path = o->window.state_file;
    widget->places_path = o->window.places_file;
    widget_show_step(widget, o->step <= demo->count ? o->step - 1 : demo->count - 1);
    bool good = o->headless ? write_steps(widget, o->output, o->json) : widget_loop(widget);
    widget_end(widget);
    mem_free(widget);
    screen_close(screen);
    return good;
}

static bool run_demo(const Options *o, const char *name) {
    Demo demo;
    if (!name)
        return fail_usage(
            "demo: which one? popping, anisotropy, psd, opacity, transmittance, early-stop, or a .json file");
    if (o->headless && !o->output[0]) return fail_usage("demo: where to? splatlab demo %s --headless -o DIR", name);
    if (!o->headless && o->output[0]) return fail_usage("demo: -o DIR goes with --headless");
    if (o->headless && o->window.frames)
        return fail_usage("demo: --headless writes each step; --frames is for windows");
    if (!window_options_check(&o->window, "demo") || !demo_load(name, &demo)) return false;
    bool good = show(o, &demo);
    demo_free(&demo);
    return good;
}

static int cmd_demo(int argc, char **argv) {
    const Options defaults = {.step = 1};
    OptionField fields[FIELD_COUNT];
    const OptionTable table = {fields, FIELD_COUNT, &defaults};
    Options options = defaults;
    const char *name = NULL;
    int count, exit_code;
    for (int i = 0; i < OWN_FIELD_COUNT; i++) fields[i] = OWN_FIELDS[i];
    window_options_fields(offsetof(Options, window), fields + OWN_FIELD_COUNT);
    if (!command_line_parse(&CMD_DEMO, &table, argc, argv, &options, &name, 1, &count, &exit_code)) return exit_code;
    return run_demo(&options, name) ? 0 : command_failed();
}

const Command CMD_DEMO = {
    .name = "demo",
    .arguments = "NAME",
    .summary = "a lecture's demo, step by step: question first, then the answer",
    .details =
        "NAME is popping, anisotropy, psd, opacity, transmittance, early-stop, or your own .json file.\n"
        "In the window: Right and Left step, digits choose another demo, R shows the step anew, A asks the audience\n"
        "before it shows the answer, B hides the panel, + and - size the text, G begins and ends a film (demo.gif),\n"
        "Space plays and freezes, F1 helps.\n"
        "  splatlab demo popping\n"
        "  splatlab demo popping --headless -o pictures",
    .run = cmd_demo,
};
