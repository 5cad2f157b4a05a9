// widget.c - the life of the widget, and the layout of a frame.
#include "lab/app/widget.h"

#include "lab/app/palette.h"
#include "lab/base/clock.h"
#include "lab/base/mem.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

// Ems of the columns and rows of the layout.
static const double PANEL_EMS = 24, PIXEL_EMS = 14.5;
static const double NOTE_S = 4;

void widget_begin(Widget *widget, Screen *screen, Scene2d scene, const char *path) {
    *widget = (Widget){.screen = screen,
                       .scene = scene,
                       .first = scene2d_copy(&scene),
                       .active = scene.count > 0 ? 0 : -1,
                       .settings = raster_settings_default(),
                       .is_stale = true,
                       .shows_outlines = true,
                       .state_path = "",
                       .places_path = ""};
    snprintf(widget->path, sizeof widget->path, "%s", path);
    widget->probe[0] = scene.width / 2.0 + 0.5;
    widget->probe[1] = scene.height / 2.0 + 0.5;
    history_begin(&widget->history, &scene, widget->active);
}

void widget_end(Widget *widget) {
    scene2d_destroy(&widget->scene);
    scene2d_destroy(&widget->first);
    scene2d_destroy(&widget->written);
    history_end(&widget->history);
    raster2d_destroy(&widget->raster);
    imagef_destroy(&widget->picture);
    image8_destroy(&widget->picture8);
    mem_free(widget->maps.transmittance);
    mem_free(widget->maps.visits);
    mem_free(widget->walk);
    mem_free(widget->places);
}

void widget_set_scene(Widget *widget, Scene2d scene) {
    bool same_canvas = scene.width == widget->scene.width && scene.height == widget->scene.height;
    scene2d_destroy(&widget->scene);
    widget->scene = scene;
    if (widget->active >= scene.count) widget->active = scene.count - 1;
    widget->drag.grip = GRIP_NONE;
    widget->is_stale = true;
    if (!same_canvas) canvas2d_fit(&widget->canvas, &widget->scene);
}

void widget_say(Widget *widget, bool is_bad, const char *format, ...) {
    va_list values;
    va_start(values, format);
    vsnprintf(widget->note, sizeof widget->note, format, values);
    va_end(values);
    widget->note_is_bad = is_bad;
    widget->note_until_s = clock_seconds() + NOTE_S;
}

Blob *widget_active(Widget *widget) { return widget->active >= 0 ? &widget->scene.blobs[widget->active] : NULL; }

static void show_note(Widget *widget, GuiRect canvas) {
    if (!widget->note[0] || clock_seconds() > widget->note_until_s) return;
    double em = gui_em(), width = gui_text_width(GUI_BODY, widget->note) + 2 * em;
    GuiRect box = {canvas.x + (canvas.width - width) / 2, canvas.y + canvas.height - 3.2 * em, width, 2.2 * em};
    gui_panel_begin("note", box, CARD, 0);
    gui_draw_text(GUI_BODY, box.x + em, box.y + 0.6 * em, widget->note_is_bad ? BAD : INK, "%s", widget->note);
    gui_panel_end();
}

bool widget_frame(Widget *widget) {
    GuiRect whole = gui_screen();
    double panel = fmin(PANEL_EMS * gui_em(), whole.width / 2), pixel = fmin(PIXEL_EMS * gui_em(), whole.height / 2);
    GuiRect canvas = {0, 0, whole.width - panel, whole.height - pixel};
    widget_keys(widget);
    widget_canvas(widget, canvas);
    widget_panel(widget, (GuiRect){canvas.width, 0, panel, whole.height});
    widget_pixel(widget, (GuiRect){0, canvas.height, canvas.width, pixel});
    show_note(widget, canvas);
    if (widget->shows_help) widget_help(widget);
    if (!gui_is_holding()) history_record(&widget->history, &widget->scene, widget->active);
    return widget_write_state(widget) && widget_write_places(widget);
}
