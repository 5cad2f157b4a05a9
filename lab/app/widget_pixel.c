// widget_pixel.c - the row at the bottom: the walk of one pixel through the blobs, as a table and as a plot of T.
#include "lab/app/palette.h"
#include "lab/app/widget.h"
#include "lab/base/mem.h"

#include <math.h>
#include <stdio.h>

enum { COLUMN_COUNT = 7, SHORT_LIST = 12 /* blobs: so many are all shown, of more those that the pixel blends */ };
static const char *const COLUMNS[COLUMN_COUNT] = {"blob", "depth", "g", "α′", "T before", "T α′", "so far"};
// Where each column ends, in ems from the left; numbers stand at the right of their column.
static const double COLUMN_ENDS[COLUMN_COUNT] = {3.2, 7.2, 11.4, 15.6, 20.6, 25.2, 29.4};

static void walk(Widget *widget) {
    if (widget->walk_capacity < widget->scene.count) {
        mem_free(widget->walk);
        widget->walk_capacity = 2 * widget->scene.count;
        widget->walk = mem_alloc((size_t)widget->walk_capacity, sizeof *widget->walk);
    }
    raster2d_load(&widget->raster, &widget->scene, view2d_whole());
    widget->walked = pixel_walk(&widget->raster, &widget->settings, widget->probe[0], widget->probe[1], widget->walk);
}

static bool is_shown(const Widget *widget, const WalkStep *step) {
    return widget->scene.count <= SHORT_LIST || step->kind == STEP_BLENDED;
}

// Large text in a small window leaves no room for the last column.
static int column_count(double width) {
    int count = COLUMN_COUNT;
    while (count > 1 && COLUMN_ENDS[count - 1] * gui_em() > width) count--;
    return count;
}

static void cell(GuiRect row, int column, GuiColour colour, const char *text) {
    double end = row.x + COLUMN_ENDS[column] * gui_em() - gui_text_width(GUI_MONO_SMALL, text);
    gui_draw_text(GUI_MONO_SMALL, end, row.y, colour, "%s", text);
}

static void swatch(double x, double y, const double rgb[3]) {
    double size = 0.8 * gui_em();
    gui_draw_rect((GuiRect){x, y, 1.6 * size, size}, colour_of(rgb, 1), 3);
    gui_draw_frame((GuiRect){x, y, 1.6 * size, size}, 0xffffff40, 3, 1);
}

static void step_row(const Widget *widget, const WalkStep *step, int columns) {
    double em = gui_em();
    char text[32];
    const Blob *blob = &widget->scene.blobs[step->index];
    bool counts = step->kind == STEP_BLENDED;
    GuiColour ink = counts ? INK : INK_FAINT;
    GuiRect row = gui_take(COLUMN_ENDS[columns - 1] * em, 1.08 * em);
    if (step->index == widget->active)
        gui_draw_rect((GuiRect){row.x - 0.3 * em, row.y - 0.12 * em, row.width + 0.6 * em, 1.15 * em}, 0x7aa2f72c, 3);
    gui_draw_disc(row.x + 0.45 * em, row.y + 0.45 * em, 0.38 * em, colour_of(blob->rgb, counts ? 1 : 0.4));
    snprintf(text, sizeof text, "%d", step->index + 1);
    cell(row, 0, ink, text);
    snprintf(text, sizeof text, "%.2f", step->depth);
    cell(row, 1, ink, text);
    if (step->kind == STEP_HIDDEN) {
        gui_draw_text(GUI_SMALL, row.x + COLUMN_ENDS[1] * em + 1.2 * em, row.y, INK_FAINT,
                      "not read: the pixel is opaque");
        return;
    }
    const double values[4] = {step->g, step->alpha, step->before, step->weight};
    for (int i = 0; i < 4 && 2 + i < columns; i++) {
        snprintf(text, sizeof text, "%.4f", values[i]);
        cell(row, 2 + i, i == 3 && counts ? ACCENT_WARM : ink, text);
    }
    if (counts && columns == COLUMN_COUNT) swatch(row.x + (COLUMN_ENDS[6] - 1.4) * em, row.y + 0.06 * em, step->rgb);
}

static void table(const Widget *widget, GuiRect place) {
    double em = gui_em();
    gui_panel_begin("pixel table", place, PANEL_DEEP, 0.6);
    gui_text(GUI_BOLD, INK, "Pixel (%d, %d)", (int)floor(widget->probe[0]), (int)floor(widget->probe[1]));
    gui_same_line(0.6);
    gui_text(GUI_SMALL, widget->probe_frozen ? ACCENT_WARM : INK_QUIET,
             widget->probe_frozen ? "held; P lets it follow the mouse" : "under the mouse; P holds it");
    int columns = column_count(gui_width_left());
    GuiRect head = gui_take(COLUMN_ENDS[columns - 1] * em, 1.15 * em);
    for (int i = 0; i < columns; i++) {
        double end = head.x + COLUMN_ENDS[i] * em - gui_text_width(GUI_SMALL, COLUMNS[i]);
        gui_draw_text(GUI_SMALL, end, head.y, INK_QUIET, "%s", COLUMNS[i]);
    }
    int shown = 0;
    for (int i = 0; i < widget->scene.count; i++) {
        if (!is_shown(widget, &widget->walk[i])) continue;
        step_row(widget, &widget->walk[i], columns);
        shown++;
    }
    if (shown < widget->scene.count)
        gui_text(GUI_SMALL, INK_FAINT, "%d others do not reach it, or lie behind where it is opaque",
                 widget->scene.count - shown);
    gui_panel_end();
}

// ---- the plot ----

static double level_y(GuiRect box, double t) { return box.y + (1 - t) * box.height; }

static void plot_axes(GuiRect box) {
    double em = gui_em();
    for (int i = 0; i <= 4; i++) {
        double y = level_y(box, i / 4.0);
        gui_draw_line(box.x, y, box.x + box.width, y, LINE, 1);
        if (i % 2 == 0) {
            char text[16];
            snprintf(text, sizeof text, i == 0 ? "0" : i == 4 ? "1" : "½");
            gui_draw_text(GUI_SMALL, box.x - 1.1 * em, y - 0.45 * em, INK_QUIET, "%s", text);
        }
    }
}

// One column a blob, front to back: T before it as the upper edge, the part that it takes away (its weight) in its colour.
static void plot_steps(const Widget *widget, GuiRect box) {
    int columns = 0;
    for (int i = 0; i < widget->scene.count; i++) columns += is_shown(widget, &widget->walk[i]);
    double column = box.width / (columns + 1), x = box.x, level = 1;
    for (int i = 0; i < widget->scene.count; i++) {
        const WalkStep *step = &widget->walk[i];
        if (!is_shown(widget, step)) continue;
        double after = level - step->weight, y = level_y(box, level), y_after = level_y(box, after);
        const double *rgb = widget->scene.blobs[step->index].rgb;
        gui_draw_rect((GuiRect){x + 1, y, column - 1, y_after - y}, colour_of(rgb, 0.95), 0);
        gui_draw_rect((GuiRect){x + 1, y_after, column - 1, box.y + box.height - y_after}, colour_of(rgb, 0.13), 0);
        gui_draw_line(x, y, x + column, y, INK, 1.5);
        gui_draw_line(x + column, y, x + column, y_after, INK, 1.5);
        level = after;
        x += column;
    }
    double y = level_y(box, level);
    gui_draw_rect((GuiRect){x + 1, y, box.x + box.width - x - 1, box.y + box.height - y},
                  colour_of(widget->scene.background, 1), 0);
    gui_draw_line(x, y, box.x + box.width, y, INK, 1.5);
}

static const char *shorter(GuiStyle style, double width, const char *text, const char *narrow) {
    return gui_text_width(style, text) > width ? narrow : text;
}

static void plot(const Widget *widget, GuiRect place) {
    double em = gui_em();
    gui_panel_begin("pixel plot", place, PANEL_DEEP, 0.6);
    gui_text(GUI_BOLD, INK, "%s",
             shorter(GUI_BOLD, gui_width_left(), "Transmittance T, front to back", "T, front to back"));
    GuiRect area = gui_take(gui_width_left(), place.height - 2.6 * em);
    GuiRect box = {area.x + 1.5 * em, area.y + 0.3 * em, area.width - 1.8 * em, area.height - 3.4 * em};
    plot_axes(box);
    plot_steps(widget, box);
    double y = box.y + box.height + 0.55 * em;
    char text[96], narrow[96];
    double weights = widget->walked.weights, left = widget->walked.transmittance;
    snprintf(text, sizeof text, "Σ T α′ %.4f  +  T %.4f  =  %.4f", weights, left, weights + left);
    snprintf(narrow, sizeof narrow, "Σ %.3f + T %.3f = %.3f", weights, left, weights + left);
    gui_draw_text(GUI_MONO_SMALL, box.x, y, INK, "%s", shorter(GUI_MONO_SMALL, box.width, text, narrow));
    const double *rgb = widget->walked.rgb;
    swatch(box.x, y + 1.25 * em, rgb);
    snprintf(text, sizeof text, "C = (%.3f, %.3f, %.3f)", rgb[0], rgb[1], rgb[2]);
    snprintf(narrow, sizeof narrow, "(%.2f, %.2f, %.2f)", rgb[0], rgb[1], rgb[2]);
    const char *colour = shorter(GUI_MONO_SMALL, box.width - 1.8 * em, text, narrow);
    gui_draw_text(GUI_MONO_SMALL, box.x + 1.8 * em, y + 1.25 * em, INK_QUIET, "%s", colour);
    double end = box.x + 2.6 * em + gui_text_width(GUI_MONO_SMALL, colour);
    if (widget->settings.background_unattenuated)
        gui_draw_text(GUI_SMALL, end, y + 1.25 * em, ACCENT_WARM, "+ whole background");
    gui_panel_end();
}

void widget_pixel(Widget *widget, GuiRect place) {
    double em = gui_em(), table_width = fmin((COLUMN_ENDS[COLUMN_COUNT - 1] + 2.2) * em, place.width * 0.66);
    walk(widget);
    table(widget, (GuiRect){place.x, place.y, table_width, place.height});
    plot(widget, (GuiRect){place.x + table_width, place.y, place.width - table_width, place.height});
}
