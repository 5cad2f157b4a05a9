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
static const double PANEL_EMS = 24, PIXEL_EMS = 14.5, DEMO_EMS = 7.4;
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
    trap_page_destroy(widget->trap);
    scene2d_destroy(&widget->compared);
    widget_film_destroy(&widget->film);
}

void widget_set_scene(Widget *widget, Scene2d scene) {
    bool same_canvas = scene.width == widget->scene.width && scene.height == widget->scene.height;
    scene2d_destroy(&widget->scene);
    widget->scene = scene;
    if (widget->active >= scene.count) widget->active = scene.count - 1;
    widget->drag.grip = GRIP_NONE;
    widget->is_stale = true;
    if (!same_canvas) widget_fit(widget);
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
    gui_overlay_begin("note", box, CARD, 0, false);
    gui_draw_text(GUI_BODY, box.x + em, box.y + 0.6 * em, widget->note_is_bad ? BAD : INK, "%s", widget->note);
    gui_panel_end();
}

void widget_show_page(Widget *widget, WidgetPage page) {
    if (page == PAGE_TRAP && !widget->trap) widget->trap = trap_page_create();
    widget->page = page;
    widget->drag.grip = GRIP_NONE;
}

// That a film is being made, and how long it is.
static void show_film(const Widget *widget, GuiRect stage) {
    double em = gui_em(), width = 8.5 * em;
    GuiRect box = {stage.x + stage.width - width - 0.6 * em, stage.y + 0.5 * em, width, 1.8 * em};
    gui_overlay_begin("film", box, CARD, 0, false);
    gui_draw_disc(box.x + em, box.y + 0.9 * em, 0.35 * em, BAD);
    gui_draw_text(GUI_BODY, box.x + 2 * em, box.y + 0.4 * em, INK, "film: %d", widget->film.count);
    gui_panel_end();
}

static void show_blobs(Widget *widget, GuiRect stage, GuiRect panel) {
    double pixel = fmin(PIXEL_EMS * gui_em(), stage.height / 2);
    GuiRect canvas = {stage.x, stage.y, stage.width, stage.height - pixel};
    widget_canvas(widget, canvas);
    if (!widget->hides_panel) widget_panel(widget, panel);
    widget_pixel(widget, (GuiRect){stage.x, stage.y + canvas.height, stage.width, pixel});
    show_note(widget, canvas);
}

static void show_trap(Widget *widget, GuiRect stage, GuiRect panel) {
    if (!widget->hides_panel) {
        gui_panel_begin("panel", panel, PANEL, 0.9);
        widget_page_choice(widget);
        trap_page_panel(widget->trap);
        gui_panel_end();
    }
    if (widget->trap->is_running) trap_page_advance(widget->trap, 1);
    trap_page_stage(widget->trap, stage, 1);
    show_note(widget, stage);
}

bool widget_frame(Widget *widget) {
    GuiRect whole = gui_screen();
    // What the key before did is a step of its own, though that key may still be down; but a drag stays whole.
    if (gui_key_pressed() && !gui_mouse().down[GUI_LEFT])
        history_record(&widget->history, &widget->scene, widget->active);
    if (widget->demo) widget_demo_keys(widget);
    widget_keys(widget);
    double panel = widget->hides_panel ? 0 : fmin(PANEL_EMS * gui_em(), whole.width / 2);
    double strip = widget->demo ? DEMO_EMS * gui_em() : 0;
    GuiRect stage = {0, strip, whole.width - panel, whole.height - strip};
    GuiRect side = {stage.width, 0, panel, whole.height};
    WidgetPage page = widget->page; // a button may turn it within the frame
    if (page == PAGE_BLOBS)
        show_blobs(widget, stage, side);
    else
        show_trap(widget, stage, side);
    if (widget->demo) widget_demo_strip(widget, (GuiRect){0, 0, stage.width, strip});
    if (widget->is_asking) widget_demo_question(widget, stage);
    if (widget->film.is_on) show_film(widget, stage);
    widget_help(widget);
    if (!gui_is_holding() || gui_mouse().released[GUI_LEFT])
        history_record(&widget->history, &widget->scene, widget->active);
    return widget_write_state(widget) && widget_write_places(widget);
}

// A film needs frames even where nothing happens.
static bool is_moving(Widget *widget) {
    bool walks = widget->page == PAGE_TRAP && widget->trap->is_running;
    return (widget->demo && widget_demo_plays(widget)) || walks || widget->film.is_on;
}

bool widget_loop(Widget *widget) {
    bool good = true;
    while (good && screen_begin(widget->screen, is_moving(widget))) {
        good = widget_frame(widget);
        good = screen_end(widget->screen) && good;
        if (!widget_film_keep(&widget->film, widget->screen)) widget_toggle_film(widget);
        screen_show(widget->screen);
    }
    return good;
}
