// widget_keys.c - the keyboard: every slider and every button has a key, so that a lecturer can do without the mouse.
#include "lab/app/widget.h"

#include <GLFW/glfw3.h>
#include <math.h>
#include <string.h>

static const double SIGMA_FACTOR = 1.05, TURN_RAD = M_PI / 36, OPACITY_STEP = 0.05, MOVE_PX = 1, MOVE_FAR_PX = 10;
static const double KEY_ZOOM = 1.25;

static double clamp(double value, double low, double high) { return fmin(high, fmax(low, value)); }

// A letter raises, Shift and the letter lowers.
static void shape_keys(Widget *widget, Blob *blob) {
    int sign = gui_shift() ? -1 : 1;
    Blob before = *blob;
    if (gui_key(GLFW_KEY_X))
        blob->sigma_x = clamp(blob->sigma_x * pow(SIGMA_FACTOR, sign), CANVAS_SIGMA_MIN, CANVAS_SIGMA_MAX);
    if (gui_key(GLFW_KEY_Y))
        blob->sigma_y = clamp(blob->sigma_y * pow(SIGMA_FACTOR, sign), CANVAS_SIGMA_MIN, CANVAS_SIGMA_MAX);
    if (gui_key(GLFW_KEY_T)) blob->theta_rad = angle_wrap(blob->theta_rad + sign * TURN_RAD);
    if (gui_key(GLFW_KEY_O)) blob->opacity = clamp(blob->opacity + sign * OPACITY_STEP, 0, 1);
    double far = gui_shift() ? MOVE_FAR_PX : MOVE_PX;
    blob->mean[0] += far * (gui_key(GLFW_KEY_RIGHT) - gui_key(GLFW_KEY_LEFT));
    blob->mean[1] += far * (gui_key(GLFW_KEY_DOWN) - gui_key(GLFW_KEY_UP));
    for (int c = 0; c < 2; c++) blob->mean[c] = clamp(blob->mean[c], -SCENE2D_MEAN_MAX, SCENE2D_MEAN_MAX);
    if (memcmp(&before, blob, sizeof before) != 0) widget->is_stale = true;
}

static void blob_keys(Widget *widget) {
    if (widget_active(widget)) shape_keys(widget, widget_active(widget));
    if (gui_key(GLFW_KEY_LEFT_BRACKET) || gui_key(GLFW_KEY_PAGE_UP)) widget_raise(widget, 1);
    if (gui_key(GLFW_KEY_RIGHT_BRACKET) || gui_key(GLFW_KEY_PAGE_DOWN)) widget_raise(widget, -1);
    if (gui_key(GLFW_KEY_N)) widget_add(widget);
    if (gui_key(GLFW_KEY_D)) widget_duplicate(widget);
    if (gui_key(GLFW_KEY_DELETE) || gui_key(GLFW_KEY_BACKSPACE)) widget_remove(widget);
    if (gui_key(GLFW_KEY_TAB) && widget->scene.count > 0)
        widget->active = (widget->active + (gui_shift() ? widget->scene.count - 1 : 1)) % widget->scene.count;
    for (int i = 0; i < 9; i++)
        if (gui_key(GLFW_KEY_1 + i)) widget_select(widget, i);
}

static void look_keys(Widget *widget) {
    const Canvas2d *c = &widget->canvas;
    bool stale = true;
    if (gui_key(GLFW_KEY_B))
        widget->settings.background_unattenuated = !widget->settings.background_unattenuated;
    else if (gui_key(GLFW_KEY_G))
        widget->settings.discs = !widget->settings.discs;
    else if (gui_key(GLFW_KEY_L))
        widget->layer = (widget->layer + 1) % (LAYER_VISITS + 1);
    else if (gui_key(GLFW_KEY_0) || gui_key(GLFW_KEY_HOME))
        canvas2d_fit(&widget->canvas, &widget->scene);
    else if (gui_key(GLFW_KEY_EQUAL) || gui_key(GLFW_KEY_KP_ADD))
        canvas2d_zoom(&widget->canvas, c->x + c->width / 2, c->y + c->height / 2, KEY_ZOOM);
    else if (gui_key(GLFW_KEY_MINUS) || gui_key(GLFW_KEY_KP_SUBTRACT))
        canvas2d_zoom(&widget->canvas, c->x + c->width / 2, c->y + c->height / 2, 1 / KEY_ZOOM);
    else
        stale = false;
    if (stale) widget->is_stale = true;
    if (gui_key(GLFW_KEY_H)) widget->shows_outlines = !widget->shows_outlines;
    if (gui_key(GLFW_KEY_P)) widget->probe_frozen = !widget->probe_frozen;
}

static void ctrl_keys(Widget *widget) {
    if (gui_key(GLFW_KEY_Z)) gui_shift() ? widget_redo(widget) : widget_undo(widget);
    if (gui_key(GLFW_KEY_Y)) widget_redo(widget);
    if (gui_key(GLFW_KEY_S)) widget_save(widget);
    if (gui_key(GLFW_KEY_O)) widget_load(widget);
    if (gui_key(GLFW_KEY_E)) widget_export(widget);
    if (gui_key(GLFW_KEY_R)) widget_reset(widget);
    if (gui_key(GLFW_KEY_EQUAL) || gui_key(GLFW_KEY_KP_ADD)) screen_zoom(widget->screen, 1);
    if (gui_key(GLFW_KEY_MINUS) || gui_key(GLFW_KEY_KP_SUBTRACT)) screen_zoom(widget->screen, -1);
    if (gui_key(GLFW_KEY_0)) screen_zoom(widget->screen, 0);
    if (gui_key(GLFW_KEY_Q)) screen_quit(widget->screen);
}

void widget_keys(Widget *widget) {
    if (gui_key(GLFW_KEY_F1)) widget->shows_help = !widget->shows_help;
    if (gui_key(GLFW_KEY_F11)) screen_toggle_full(widget->screen);
    if (gui_key(GLFW_KEY_ESCAPE)) widget->shows_help = false;
    if (widget->drag.grip != GRIP_NONE) return; // the blob under the mouse must not change
    if (gui_ctrl()) {
        ctrl_keys(widget);
        return;
    }
    blob_keys(widget);
    look_keys(widget);
}
