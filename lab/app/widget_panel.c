// widget_panel.c - the column on the right: which blob, its sliders, what follows from them, and the scene's switches.
#include "lab/app/palette.h"
#include "lab/app/readout.h"
#include "lab/app/widget.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double DEGREE = M_PI / 180;
static const double SLIDER_SIGMA_MIN = 1, SLIDER_SIGMA_MAX = 400; // px

static void heading(const char *text) {
    gui_gap(0.15);
    gui_text(GUI_SMALL, INK_QUIET, "%s", text);
}

// A row of coloured discs, in depth order; a click chooses.
static void blob_row(Widget *widget) {
    enum { SHOWN_MAX = 10 };
    double em = gui_em();
    int count = widget->scene.count < SHOWN_MAX ? widget->scene.count : SHOWN_MAX;
    for (int i = 0; i < count; i++) {
        char name[32];
        if (i) gui_same_line(0.15);
        snprintf(name, sizeof name, "blob %d", i + 1);
        GuiArea area = gui_area(name, 1.6 * em, 1.9 * em);
        double x = area.place.x + 0.8 * em, y = area.place.y + 0.8 * em;
        gui_draw_disc(x, y, (area.hovered ? 0.68 : 0.6) * em, colour_of(widget->scene.blobs[i].rgb, 1));
        if (i == widget->active) gui_draw_ring(x, y, 0.76 * em, 0xffffffff, 2);
        if (area.hovered && gui_mouse().pressed[GUI_LEFT]) widget_select(widget, i);
    }
    if (widget->scene.count > SHOWN_MAX) {
        gui_same_line(0.3);
        gui_text(GUI_SMALL, INK_QUIET, "+ %d", widget->scene.count - SHOWN_MAX);
    }
}

static void depth_slider(Widget *widget, Blob *blob) {
    double low = 0, high = 1;
    for (int i = 0; i < widget->scene.count; i++) {
        low = fmin(low, widget->scene.blobs[i].depth);
        high = fmax(high, widget->scene.blobs[i].depth);
    }
    double depth = blob->depth;
    if (!gui_slider("depth", &depth, low - 1, high + 1, "%.2f", false)) return;
    blob->depth = fmin(SCENE2D_DEPTH_MAX, fmax(-SCENE2D_DEPTH_MAX, depth));
}

static void sliders(Widget *widget, Blob *blob) {
    double theta = blob->theta_rad / DEGREE;
    gui_slider("σx", &blob->sigma_x, SLIDER_SIGMA_MIN, SLIDER_SIGMA_MAX, "%.1f px", true);
    gui_hint("Standard deviation along the first axis.  X, Shift X");
    gui_slider("σy", &blob->sigma_y, SLIDER_SIGMA_MIN, SLIDER_SIGMA_MAX, "%.1f px", true);
    gui_hint("Standard deviation along the second axis.  Y, Shift Y");
    if (gui_slider("θ", &theta, -180, 180, "%.1f°", false)) blob->theta_rad = theta * DEGREE;
    gui_hint("Angle of the first axis, clockwise on the screen (y points down).  T, Shift T");
    depth_slider(widget, blob);
    gui_hint("Smaller is in front. The wheel, [ and ] move it past its neighbours one by one.");
    gui_slider("opacity", &blob->opacity, 0, 1, "%.3f", false);
    gui_hint("α at the mean; α′ = α g elsewhere.  O, Shift O");
    gui_colour("colour", blob->rgb);
    // What is typed into a slider may be any number.
    blob->sigma_x = fmin(CANVAS_SIGMA_MAX, fmax(CANVAS_SIGMA_MIN, blob->sigma_x));
    blob->sigma_y = fmin(CANVAS_SIGMA_MAX, fmax(CANVAS_SIGMA_MIN, blob->sigma_y));
    blob->theta_rad = fabs(blob->theta_rad) > 2 * M_PI ? angle_wrap(blob->theta_rad) : blob->theta_rad;
    blob->opacity = fmin(1, fmax(0, blob->opacity));
}

static void readouts(Widget *widget, const Blob *blob) {
    readout("Gaussians", INK, "%d", widget->scene.count);
    if (blob) {
        readout("Active axis lengths (1σ)", INK, "%.1f × %.1f px", blob->sigma_x, blob->sigma_y);
        readout("Active depth rank", INK, "%d of %d from the front", scene2d_rank(&widget->scene, widget->active) + 1,
                widget->scene.count);
    }
    readout("Mean accumulated opacity", INK, "%.4f", widget->mean_opacity);
}

static void list_buttons(Widget *widget) {
    double third = (gui_width_left() - 0.5 * gui_em()) / 3;
    if (gui_button("Add", third)) widget_add(widget);
    gui_hint("N");
    gui_same_line(0.25);
    if (gui_button("Duplicate", third)) widget_duplicate(widget);
    gui_hint("D");
    gui_same_line(0.25);
    if (gui_button("Delete", third)) widget_remove(widget);
    gui_hint("Delete");
    if (gui_button("Undo", third)) widget_undo(widget);
    gui_hint("Ctrl Z");
    gui_same_line(0.25);
    if (gui_button("Redo", third)) widget_redo(widget);
    gui_hint("Ctrl Y");
    gui_same_line(0.25);
    if (gui_button("Reset", third)) widget_reset(widget);
    gui_hint("Ctrl R: the scene as it was at the start");
}

static void switches(Widget *widget) {
    static const char *const layers[] = {"Colour", "T", "Blobs read"};
    int layer = (int)widget->layer;
    bool stale = gui_choice("layer", &layer, layers, 3);
    widget->layer = (WidgetLayer)layer;
    gui_switch("Outlines", &widget->shows_outlines);
    gui_hint("H");
    gui_same_line(1);
    stale |= gui_switch("Discs", &widget->settings.discs);
    gui_hint("E: each blob as its flat 1σ ellipse, so that one sees where they lie");
    stale |= gui_switch("Background unattenuated", &widget->settings.background_unattenuated);
    gui_hint(
        "U: as the lesson's own script does it. Its sum starts with the background and never multiplies it by what "
        "the blobs let through, so the weights add up to more than 1: opaque blobs become brighter by the "
        "background's colour. Correct is to add T · background at the end.");
    if (widget->settings.background_unattenuated)
        gui_paragraph(
            GUI_SMALL, ACCENT_WARM,
            "C = b + Σ T α′ c: the background b counts fully behind opaque blobs. Correct: C = Σ T α′ c + T b.");
    stale |= gui_slider("stop at T <", &widget->settings.rule.stop, 1e-4, 0.5, "%.4f", true);
    gui_hint("S, Shift S: early stop. A pixel whose transmittance is below this counts as opaque, and nothing behind "
             "it is read.");
    widget->settings.rule.stop = fmin(1, fmax(0, widget->settings.rule.stop));
    if (stale) widget->is_stale = true;
}

static void background(Widget *widget) {
    double before[3] = {widget->scene.background[0], widget->scene.background[1], widget->scene.background[2]};
    gui_colour("background", widget->scene.background);
    for (int c = 0; c < 3; c++)
        if (before[c] != widget->scene.background[c]) widget->is_stale = true;
}

static void files(Widget *widget) {
    double third = (gui_width_left() - 0.5 * gui_em()) / 3;
    gui_text_field("file", widget->path, WIDGET_PATH_BYTES);
    if (gui_button("Save", third)) widget_save(widget);
    gui_hint("Ctrl S");
    gui_same_line(0.25);
    if (gui_button("Load", third)) widget_load(widget);
    gui_hint("Ctrl O");
    gui_same_line(0.25);
    if (gui_button("PNG", third)) widget_export(widget);
    gui_hint("Ctrl E: the canvas as a picture, beside the scene's file");
}

void widget_page_choice(Widget *widget) {
    static const char *const pages[] = {"Gaussians", "PSD trap"};
    int page = (int)widget->page;
    if (gui_choice("page", &page, pages, 2)) widget_show_page(widget, (WidgetPage)page);
}

void widget_panel(Widget *widget, GuiRect place) {
    gui_panel_begin("panel", place, PANEL, 0.9);
    widget_page_choice(widget);
    blob_row(widget);
    Blob *blob = widget_active(widget);
    if (blob) {
        Blob before = *blob;
        sliders(widget, blob);
        if (memcmp(&before, blob, sizeof before) != 0) widget->is_stale = true;
    } else {
        gui_paragraph(GUI_BODY, INK_QUIET, "No blob is chosen. Click one, or press N for a new one.");
    }
    list_buttons(widget);
    gui_rule();
    readouts(widget, widget_active(widget));
    gui_rule();
    if (widget_active(widget)) {
        widget_maths(widget_active(widget));
        gui_rule();
    }
    widget_mine_panel(widget);
    heading("The picture");
    switches(widget);
    background(widget);
    heading("The file");
    files(widget);
    gui_panel_end();
}
