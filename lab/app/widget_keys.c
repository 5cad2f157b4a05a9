// widget_keys.c - the keyboard: every slider and every button has a key, so that a lecturer can do without the mouse.
#include "lab/app/widget.h"
#include "lab/app/window_keys.h"

#include <GLFW/glfw3.h>
#include <math.h>
#include <string.h>

static const double SIGMA_FACTOR = 1.05, TURN_RAD = M_PI / 36, OPACITY_STEP = 0.05, MOVE_PX = 1, MOVE_FAR_PX = 10;
static const double KEY_ZOOM = 1.25, STOP_FACTOR = 1.5, STOP_MIN = 1e-4, STOP_MAX = 0.5;

static double clamp(double value, double low, double high) { return fmin(high, fmax(low, value)); }

// A letter raises, Shift and the letter lowers: the sum of both in this frame.
static int steps_of(int key) { return gui_key(key, GUI_PLAIN) - gui_key(key, GUI_SHIFT); }

// Arrows: 1 px, with Shift 10.
static double moved_by(int key) { return MOVE_PX * gui_key(key, GUI_PLAIN) + MOVE_FAR_PX * gui_key(key, GUI_SHIFT); }

static double scaled(double sigma, int steps) {
    return clamp(sigma * pow(SIGMA_FACTOR, steps), CANVAS_SIGMA_MIN, CANVAS_SIGMA_MAX);
}

static void shape_keys(Widget *widget, Blob *blob) {
    Blob before = *blob;
    int sigma_x = steps_of(GLFW_KEY_X), sigma_y = steps_of(GLFW_KEY_Y), theta = steps_of(GLFW_KEY_T);
    if (sigma_x) blob->sigma_x = scaled(blob->sigma_x, sigma_x);
    if (sigma_y) blob->sigma_y = scaled(blob->sigma_y, sigma_y);
    if (theta) blob->theta_rad = angle_wrap(blob->theta_rad + theta * TURN_RAD);
    blob->opacity = clamp(blob->opacity + steps_of(GLFW_KEY_O) * OPACITY_STEP, 0, 1);
    if (!widget->demo) blob->mean[0] += moved_by(GLFW_KEY_RIGHT) - moved_by(GLFW_KEY_LEFT); // there they step
    blob->mean[1] += moved_by(GLFW_KEY_DOWN) - moved_by(GLFW_KEY_UP);
    for (int c = 0; c < 2; c++) blob->mean[c] = clamp(blob->mean[c], -SCENE2D_MEAN_MAX, SCENE2D_MEAN_MAX);
    if (memcmp(&before, blob, sizeof before) != 0) widget->is_stale = true;
}

static void blob_keys(Widget *widget) {
    if (widget_active(widget)) shape_keys(widget, widget_active(widget));
    int forward = gui_key(GLFW_KEY_LEFT_BRACKET, GUI_PLAIN) + gui_key(GLFW_KEY_PAGE_UP, GUI_PLAIN);
    int back = gui_key(GLFW_KEY_RIGHT_BRACKET, GUI_PLAIN) + gui_key(GLFW_KEY_PAGE_DOWN, GUI_PLAIN);
    if (forward != back) widget_raise(widget, forward - back);
    if (gui_key(GLFW_KEY_N, GUI_PLAIN)) widget_add(widget);
    if (gui_key(GLFW_KEY_D, GUI_PLAIN)) widget_duplicate(widget);
    if (gui_key(GLFW_KEY_DELETE, GUI_PLAIN) || gui_key(GLFW_KEY_BACKSPACE, GUI_PLAIN)) widget_remove(widget);
    int count = widget->scene.count, next = steps_of(GLFW_KEY_TAB);
    if (next && count > 0) widget->active = ((widget->active + next) % count + count) % count;
    for (int i = 0; i < 9 && !widget->demo; i++) // there they choose the demo
        if (gui_key(GLFW_KEY_1 + i, GUI_PLAIN)) widget_select(widget, i);
}

static void look_keys(Widget *widget) {
    const Canvas2d *c = &widget->canvas;
    int unattenuated = gui_key(GLFW_KEY_U, GUI_PLAIN), discs = gui_key(GLFW_KEY_E, GUI_PLAIN);
    int layers = gui_key(GLFW_KEY_L, GUI_PLAIN), zooms = window_keys_plus(GUI_CTRL) - window_keys_minus(GUI_CTRL);
    if (unattenuated % 2) widget->settings.background_unattenuated = !widget->settings.background_unattenuated;
    if (discs % 2) widget->settings.discs = !widget->settings.discs;
    widget->layer = (widget->layer + (unsigned)layers) % (LAYER_VISITS + 1);
    if (zooms) {
        canvas2d_zoom(&widget->canvas, c->x + c->width / 2, c->y + c->height / 2, pow(KEY_ZOOM, zooms));
        widget->is_moved = true;
    }
    if (gui_key(GLFW_KEY_0, GUI_PLAIN) + gui_key(GLFW_KEY_HOME, GUI_PLAIN)) widget_fit(widget);
    int stops = steps_of(GLFW_KEY_S);
    double *stop = &widget->settings.rule.stop;
    if (stops) *stop = clamp(*stop * pow(STOP_FACTOR, stops), STOP_MIN, STOP_MAX);
    if (unattenuated || discs || layers || zooms || stops) widget->is_stale = true;
    if (gui_key(GLFW_KEY_H, GUI_PLAIN) % 2) widget->shows_outlines = !widget->shows_outlines;
    if (gui_key(GLFW_KEY_P, GUI_PLAIN) % 2) widget->probe_frozen = !widget->probe_frozen;
}

static void ctrl_keys(Widget *widget) {
    for (int i = gui_key(GLFW_KEY_Z, GUI_CTRL); i > 0; i--) widget_undo(widget);
    for (int i = gui_key(GLFW_KEY_Y, GUI_CTRL) + gui_key(GLFW_KEY_Z, GUI_CTRL | GUI_SHIFT); i > 0; i--)
        widget_redo(widget);
    if (gui_key(GLFW_KEY_S, GUI_CTRL)) widget_save(widget);
    if (gui_key(GLFW_KEY_O, GUI_CTRL)) widget_load(widget);
    if (gui_key(GLFW_KEY_E, GUI_CTRL)) widget_export(widget);
    if (gui_key(GLFW_KEY_R, GUI_CTRL)) widget_reset(widget);
}

void widget_keys(Widget *widget) {
    window_keys(widget->screen);
    if (widget->drag.grip != GRIP_NONE) return; // the blob under the mouse must not change
    ctrl_keys(widget);
    if (gui_key(GLFW_KEY_G, GUI_PLAIN) % 2) widget_toggle_film(widget);
    if (gui_key(GLFW_KEY_B, GUI_PLAIN) % 2) widget->hides_panel = !widget->hides_panel;
    if (gui_key(GLFW_KEY_M, GUI_PLAIN) % 2)
        widget_show_page(widget, widget->page == PAGE_BLOBS ? PAGE_TRAP : PAGE_BLOBS);
    if (widget->page == PAGE_TRAP) {
        trap_page_keys(widget->trap);
        return;
    }
    blob_keys(widget);
    look_keys(widget);
    widget_mine_keys(widget);
}
