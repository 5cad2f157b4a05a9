// widget_edit.c - what buttons and keys do to the scene.
#include "lab/app/widget.h"
#include "lab/base/fail.h"

#include <math.h>
#include <string.h>

static const double NEW_SIGMA_X = 60, NEW_SIGMA_Y = 30, NEW_OPACITY = 0.9; // px, px
static const double COPY_OFFSET = 24;                                      // px, each way

// Hues that stand apart from their neighbours in the list: each new blob takes the next.
static const double HUES[][3] = {{0.95, 0.25, 0.42}, {1.00, 0.76, 0.22}, {0.08, 0.70, 0.68},
                                 {0.98, 0.48, 0.16}, {0.56, 0.44, 0.98}, {0.42, 0.80, 0.36}};
enum { HUE_COUNT = sizeof HUES / sizeof HUES[0] };

static void choose_added(Widget *widget, int index) {
    if (index < 0)
        widget_say(widget, true, "%s", fail_text());
    else
        widget->active = index;
    widget->is_stale = true;
}

static double front_depth(const Scene2d *scene) {
    double front = 1;
    for (int i = 0; i < scene->count; i++) front = fmin(front, scene->blobs[i].depth);
    return fmax(-SCENE2D_DEPTH_MAX, front - 1);
}

void widget_add(Widget *widget) {
    GuiMouse mouse = gui_mouse();
    const Canvas2d *canvas = &widget->canvas;
    double x = mouse.x - canvas->x, y = mouse.y - canvas->y;
    bool over = x >= 0 && x < canvas->width && y >= 0 && y < canvas->height;
    Blob blob = {
        .sigma_x = NEW_SIGMA_X, .sigma_y = NEW_SIGMA_Y, .opacity = NEW_OPACITY, .depth = front_depth(&widget->scene)};
    canvas2d_from_window(canvas, canvas->x + (over ? x : canvas->width / 2),
                         canvas->y + (over ? y : canvas->height / 2), blob.mean);
    memcpy(blob.rgb, HUES[widget->scene.count % HUE_COUNT], sizeof blob.rgb);
    choose_added(widget, scene2d_add(&widget->scene, &blob));
}

void widget_duplicate(Widget *widget) {
    if (widget->active < 0) return;
    int copy = scene2d_duplicate(&widget->scene, widget->active);
    for (int c = 0; copy >= 0 && c < 2; c++) widget->scene.blobs[copy].mean[c] += COPY_OFFSET;
    choose_added(widget, copy);
}

void widget_remove(Widget *widget) {
    if (widget->active < 0) return;
    scene2d_remove(&widget->scene, widget->active);
    if (widget->active >= widget->scene.count) widget->active = widget->scene.count - 1;
    widget->drag.grip = GRIP_NONE;
    widget->is_stale = true;
}

void widget_reset(Widget *widget) {
    widget_set_scene(widget, scene2d_copy(&widget->first));
    widget_fit(widget);
    widget_say(widget, false, "The scene is as it was at the start; Ctrl Z takes that back");
}

void widget_fit(Widget *widget) {
    widget->is_moved = false; // the next frame does it
    widget->is_stale = true;
}

static void travel(Widget *widget, bool found, const char *nothing) {
    if (!found) widget_say(widget, false, "%s", nothing);
    if (widget->active >= widget->scene.count) widget->active = widget->scene.count - 1;
    widget->drag.grip = GRIP_NONE;
    widget->is_stale = true;
}

// What is not yet a step (a key is still held) becomes one first, so that nothing is lost.
void widget_undo(Widget *widget) {
    history_record(&widget->history, &widget->scene, widget->active);
    travel(widget, history_undo(&widget->history, &widget->scene, &widget->active), "Nothing to undo");
}

void widget_redo(Widget *widget) {
    travel(widget, history_redo(&widget->history, &widget->scene, &widget->active), "Nothing to redo");
}

void widget_raise(Widget *widget, int steps) {
    if (widget->active < 0) return;
    scene2d_set_rank(&widget->scene, widget->active, scene2d_rank(&widget->scene, widget->active) - steps);
    widget->is_stale = true;
}

void widget_select(Widget *widget, int index) {
    if (index < widget->scene.count) widget->active = index;
}
