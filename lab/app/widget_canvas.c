// widget_canvas.c - the canvas: picture, outlines, handles, and what the mouse does there.
#include "lab/app/palette.h"
#include "lab/app/widget.h"

#include <math.h>
#include <stdio.h>

enum { ELLIPSE_POINTS = 96 };
static const double ARM_EMS = 1.7, REACH_EMS = 0.55; // of the turning handle; how near a handle is taken
static const double PICK_SIGMAS = 2;
static const double WHEEL_ZOOM = 1.15;

// ---- mouse ----

static void take_hold(Widget *widget, const GuiMouse *mouse) {
    double point[2];
    Grip grip = GRIP_NONE;
    Blob *blob = widget_active(widget);
    double arm = ARM_EMS * gui_em(), reach = REACH_EMS * gui_em();
    canvas2d_from_window(&widget->canvas, mouse->x, mouse->y, point);
    if (blob) grip = canvas2d_grip_at(&widget->canvas, blob, mouse->x, mouse->y, arm, reach);
    if (grip == GRIP_NONE || grip == GRIP_BODY) {
        int picked = scene2d_pick(&widget->scene, point[0], point[1], PICK_SIGMAS);
        if (picked >= 0 && grip == GRIP_NONE) widget_select(widget, picked);
        grip = picked >= 0 ? GRIP_BODY : GRIP_NONE;
        blob = widget_active(widget);
    }
    if (grip != GRIP_NONE) widget->drag = (Drag2d){grip, mouse->x, mouse->y, *blob};
}

static void go_on_dragging(Widget *widget, const GuiMouse *mouse) {
    Blob *blob = widget_active(widget);
    bool moved = mouse->x != widget->drag.x || mouse->y != widget->drag.y;
    if (blob && moved) {
        *blob = drag2d_blob(&widget->drag, &widget->canvas, mouse->x, mouse->y, gui_shift());
        widget->is_stale = true;
    }
    if (!mouse->down[GUI_LEFT]) widget->drag.grip = GRIP_NONE;
}

static void use_wheel(Widget *widget, const GuiMouse *mouse) {
    if (mouse->wheel == 0) return;
    if (gui_ctrl()) {
        canvas2d_zoom(&widget->canvas, mouse->x, mouse->y, pow(WHEEL_ZOOM, mouse->wheel));
        widget->is_moved = widget->is_stale = true;
    } else {
        widget_raise(widget, mouse->wheel > 0 ? 1 : -1);
    }
}

static void use_mouse(Widget *widget, GuiArea area) {
    GuiMouse mouse = gui_mouse();
    if (widget->drag.grip != GRIP_NONE) go_on_dragging(widget, &mouse);
    if (area.hovered && mouse.pressed[GUI_LEFT]) take_hold(widget, &mouse);
    if (area.hovered) use_wheel(widget, &mouse);
    if (area.held && (mouse.down[GUI_MIDDLE] || mouse.down[GUI_RIGHT]) && (mouse.moved_x != 0 || mouse.moved_y != 0)) {
        canvas2d_pan(&widget->canvas, mouse.moved_x, mouse.moved_y);
        widget->is_moved = widget->is_stale = true;
    }
    bool probes = area.hovered && !widget->probe_frozen && widget->drag.grip == GRIP_NONE;
    if (probes) {
        double point[2];
        canvas2d_from_window(&widget->canvas, mouse.x, mouse.y, point);
        for (int c = 0; c < 2; c++) widget->probe[c] = floor(point[c]) + 0.5;
    }
}

// ---- overlays ----

static void draw_canvas_edge(const Widget *widget) {
    double low[2], high[2];
    canvas2d_to_window(&widget->canvas, (double[2]){0, 0}, low);
    canvas2d_to_window(&widget->canvas, (double[2]){widget->scene.width, widget->scene.height}, high);
    gui_draw_frame((GuiRect){low[0], low[1], high[0] - low[0], high[1] - low[1]}, 0xffffff22, 0, 1);
}

static void draw_outline(const Widget *widget, const Blob *blob, double k, GuiColour colour, double width) {
    double xy[2 * ELLIPSE_POINTS];
    canvas2d_ellipse(&widget->canvas, blob, k, ELLIPSE_POINTS, xy);
    if (widget->layer == LAYER_TRANSMITTANCE) // it is white where there is no blob
        gui_draw_curve(xy, ELLIPSE_POINTS, true, faded(0x000000ff, 0.5 * (colour & 255) / 255), width + 2);
    gui_draw_curve(xy, ELLIPSE_POINTS, true, colour, width);
}

static void draw_grip(double x, double y, bool is_hot, bool is_round) {
    double size = gui_em() * (is_hot ? 0.34 : 0.27);
    if (is_round) {
        gui_draw_disc(x, y, size, is_hot ? ACCENT_WARM : 0xffffffff);
        gui_draw_ring(x, y, size, 0x10131aff, 1.5);
        return;
    }
    GuiRect box = {x - size, y - size, 2 * size, 2 * size};
    gui_draw_rect(box, is_hot ? ACCENT_WARM : 0xffffffff, 2);
    gui_draw_frame(box, 0x10131aff, 2, 1.5);
}

static void draw_handles(const Widget *widget, const Blob *blob, bool hovered) {
    double arm = ARM_EMS * gui_em(), mean[2], at[2];
    GuiMouse mouse = gui_mouse();
    Grip hot = widget->drag.grip;
    if (hot == GRIP_NONE && hovered)
        hot = canvas2d_grip_at(&widget->canvas, blob, mouse.x, mouse.y, arm, REACH_EMS * gui_em());
    canvas2d_to_window(&widget->canvas, blob->mean, mean);
    canvas2d_grip(&widget->canvas, blob, GRIP_TURN, arm, at);
    gui_draw_line(mean[0], mean[1], at[0], at[1], 0xffffffb0, 1.5);
    canvas2d_grip(&widget->canvas, blob, GRIP_Y, arm, at);
    gui_draw_line(mean[0], mean[1], at[0], at[1], 0xffffffb0, 1.5);
    gui_draw_disc(mean[0], mean[1], 3, 0xffffffff);
    for (Grip grip = GRIP_X; grip <= GRIP_TURN; grip++) {
        canvas2d_grip(&widget->canvas, blob, grip, arm, at);
        draw_grip(at[0], at[1], grip == hot, grip == GRIP_TURN);
    }
    static const struct {
        Grip grip;
        const char *name;
    } axes[] = {{GRIP_X, "σx"}, {GRIP_Y, "σy"}};
    for (int i = 0; i < 2; i++) { // beside the middle of the axis, away from handles
        canvas2d_grip(&widget->canvas, blob, axes[i].grip, arm, at);
        double x = (mean[0] + at[0]) / 2, y = (mean[1] + at[1]) / 2;
        gui_draw_text(GUI_SMALL, x + 0.3 * gui_em(), y + 0.2 * gui_em(), 0xffffffe0, "%s", axes[i].name);
    }
}

static void draw_probe(const Widget *widget) {
    double at[2], size = 0.55 * gui_em();
    canvas2d_to_window(&widget->canvas, widget->probe, at);
    GuiColour colour = widget->probe_frozen ? ACCENT_WARM : 0xffffffc0;
    gui_draw_ring(at[0], at[1], size, 0x000000a0, 3.5);
    gui_draw_ring(at[0], at[1], size, colour, 1.5);
    for (int side = -1; side <= 1; side += 2) {
        gui_draw_line(at[0] + side * size, at[1], at[0] + side * 1.7 * size, at[1], colour, 1.5);
        gui_draw_line(at[0], at[1] + side * size, at[0], at[1] + side * 1.7 * size, colour, 1.5);
    }
}

static void draw_overlays(Widget *widget, GuiArea area) {
    Blob *active = widget_active(widget);
    draw_canvas_edge(widget);
    for (int i = 0; widget->shows_outlines && i < widget->scene.count; i++)
        if (i != widget->active) draw_outline(widget, &widget->scene.blobs[i], 1, 0xffffff66, 1);
    if (active && widget->shows_outlines) {
        draw_outline(widget, active, 2, 0xffffff50, 1);
        draw_outline(widget, active, 1, 0xffffffff, 2);
        draw_handles(widget, active, area.hovered);
    }
    draw_probe(widget);
}

static void draw_times(const Widget *widget, GuiRect place) {
    double em = gui_em();
    char text[128];
    snprintf(text, sizeof text, "%d × %d px   raster %.1f ms   frame %.1f ms", widget->picture.width,
             widget->picture.height, widget->raster_ms, screen_work_ms(widget->screen));
    if (!screen_is_window(widget->screen)) return; // a time would make each headless picture another one
    gui_draw_rect(
        (GuiRect){place.x + 0.4 * em, place.y + 0.4 * em, gui_text_width(GUI_SMALL, text) + 0.8 * em, 1.3 * em},
        0x0a0c1290, 0.3 * em);
    gui_draw_text(GUI_SMALL, place.x + 0.8 * em, place.y + 0.6 * em, 0xffffff90, "%s", text);
    const char *hint = "F1 help";
    gui_draw_text(GUI_SMALL, place.x + place.width - gui_text_width(GUI_SMALL, hint) - 0.8 * em, place.y + 0.6 * em,
                  0xffffff90, "%s", hint);
}

// What the colours of the heat map mean.
static void draw_legend(const Widget *widget, GuiRect place) {
    enum { TONES = 48 };
    if (widget->layer != LAYER_VISITS) return;
    double em = gui_em(), x = place.x + 0.9 * em, y = place.y + place.height - 1.9 * em, width = 0.22 * em;
    gui_draw_text(GUI_SMALL, x, y - 1.2 * em, 0xffffffc0, "blobs read");
    for (int i = 0; i < TONES; i++) {
        double rgb[3];
        widget_heat((double)i / (TONES - 1), rgb);
        gui_draw_rect((GuiRect){x + i * width, y, width + 1, 0.6 * em}, colour_of(rgb, 1), 0);
    }
    gui_draw_text(GUI_SMALL, x, y + 0.75 * em, 0xffffffc0, "0");
    char most[16];
    snprintf(most, sizeof most, "%d", widget->scene.count);
    gui_draw_text(GUI_SMALL, x + TONES * width - gui_text_width(GUI_SMALL, most), y + 0.75 * em, 0xffffffc0, "%s",
                  most);
}

void widget_canvas(Widget *widget, GuiRect place) {
    gui_panel_begin("canvas panel", place, PANEL_DEEP, 0);
    if (widget->is_moved) {
        canvas2d_place(&widget->canvas, place.x, place.y, place.width, place.height);
    } else {
        widget->canvas = (Canvas2d){.x = place.x, .y = place.y, .width = place.width, .height = place.height};
        canvas2d_fit(&widget->canvas, &widget->scene);
    }
    GuiArea area = gui_area("canvas", place.width, place.height);
    use_mouse(widget, area);
    double density = gui_density();
    int width = (int)fmax(1, place.width * density), height = (int)fmax(1, place.height * density);
    widget_picture(widget, width, height);
    gui_draw_picture(0, (GuiRect){place.x, place.y, width / density, height / density});
    draw_overlays(widget, area);
    draw_legend(widget, place);
    draw_times(widget, place);
    gui_panel_end();
}
