// cmd_figure.c - `splatlab figure`: a figure of the lesson, drawn without a display, and the numbers that it shows.
#include "lab/app/commands.h"
#include "lab/app/figure.h"
#include "lab/app/output_path.h"
#include "lab/app/palette.h"
#include "lab/base/fail.h"
#include "lab/base/nearest.h"
#include "lab/io/image_io.h"
#include "lab/io/json_io.h"

#include <stdio.h>
#include <string.h>

// In the order of the lesson.
static const Figure *const FIGURES[] = {&FIGURE_COV2,    &FIGURE_CONIC, &FIGURE_PSD,       &FIGURE_COMPOSITE,
                                        &FIGURE_POPPING, &FIGURE_NERF,  &FIGURE_QUAT,      &FIGURE_COV3,
                                        &FIGURE_CAMERA,  &FIGURE_EWA,   &FIGURE_EWA_ERROR, &FIGURE_SH};
enum { FIGURE_COUNT = sizeof FIGURES / sizeof FIGURES[0] };

typedef struct {
    char output[OPTION_TEXT_BYTES];
    bool json;
} Options;

static const Options DEFAULTS = {0};
static const OptionField FIELDS[] = {
    {.name = "output",
     .letter = 'o',
     .type = OPTION_TEXT,
     .offset = offsetof(Options, output),
     .help = "the picture, .png"},
    {OPTION_JSON_OF(Options, "the numbers that the figure shows")},
};
static const OptionTable TABLE = {FIELDS, sizeof FIELDS / sizeof FIELDS[0], &DEFAULTS};

static const Figure *find(const char *name) {
    const char *names[FIGURE_COUNT];
    int best;
    for (int i = 0; i < FIGURE_COUNT; i++) {
        names[i] = FIGURES[i]->name;
        if (strcmp(names[i], name) == 0) return FIGURES[i];
    }
    if (nearest_find(name, names, FIGURE_COUNT, &best, 1))
        fail_usage("figure: there is no figure '%s'; did you mean %s?", name, names[best]);
    else
        fail_usage("figure: there is no figure '%s'; splatlab figure --help lists them", name);
    return NULL;
}

// One frame suffices: nothing here has a place that is known only after the frame before.
static bool draw(const Figure *figure, json_t *numbers, Image8 *image) {
    GuiRect place = {0, 0, figure->width, figure->height};
    gui_open(NULL);
    gui_set_scale(1, 1);
    gui_frame_begin(figure->width, figure->height);
    gui_panel_begin("figure", place, PANEL_DEEP, 0);
    bool good = figure->draw(place, numbers);
    gui_panel_end();
    gui_frame_end();
    *image = image8_create(figure->width, figure->height, 3);
    gui_frame_paint(image);
    gui_close();
    return good;
}

static bool run_figure(const Options *o, const char *name) {
    static const char *const ENDINGS[] = {".png", NULL};
    if (!name) return fail_usage("figure: which one? splatlab figure NAME -o FILE.png; --help lists them");
    const Figure *figure = find(name);
    if (!figure) return false;
    if (!o->output[0] && !o->json)
        return fail_usage("figure: where to? splatlab figure %s -o FILE.png, or --json for its numbers", name);
    if (o->output[0] && !output_path_check("output", o->output, ENDINGS)) return false;
    Image8 image = {0};
    json_t *numbers = json_object();
    bool good = draw(figure, numbers, &image) && (!o->output[0] || image_save8(o->output, &image));
    if (good && o->json) json_print(numbers);
    json_decref(numbers);
    image8_destroy(&image);
    return good;
}

// The help's list of figures is FIGURES.
static const char *details_text(char *buffer, size_t size) {
    int length = snprintf(buffer, size, "NAME is one of:\n");
    for (int i = 0; i < FIGURE_COUNT; i++)
        length +=
            snprintf(buffer + length, size - (size_t)length, "  %-10s %s\n", FIGURES[i]->name, FIGURES[i]->summary);
    snprintf(buffer + length, size - (size_t)length, "\n%s", CMD_FIGURE.details);
    return buffer;
}

static int cmd_figure(int argc, char **argv) {
    Options options = DEFAULTS;
    char details[2048];
    Command command = CMD_FIGURE;
    command.details = details_text(details, sizeof details);
    const char *name = NULL;
    int count, exit_code;
    if (!command_line_parse(&command, &TABLE, argc, argv, &options, &name, 1, &count, &exit_code)) return exit_code;
    return run_figure(&options, name) ? 0 : command_failed();
}

const Command CMD_FIGURE = {
    .name = "figure",
    .arguments = "NAME",
    .summary = "draw a figure of the lesson, or print the numbers behind it",
    .details = "  splatlab figure ewa-error -o ewa_error.png --json",
    .run = cmd_figure,
};
