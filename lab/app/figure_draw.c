// figure_draw.c - axes, ellipses, arrows, matrices, by gui.h.
#include "lab/app/figure_draw.h"

#include "lab/app/palette.h"

#include <math.h>
#include <stdio.h>

enum { ELLIPSE_POINTS = 96, BLOB_STEPS = 18 };

// ---- axes ----

static double along(const Plot *plot, int axis, double value) {
    double low = plot->low[axis], high = plot->high[axis];
    if (plot->is_log[axis]) low = log10(low), high = log10(high), value = log10(value);
    return (value - low) / (high - low);
}

double plot_x(const Plot *plot, double value) { return plot->box.x + plot->box.width * along(plot, 0, value); }
double plot_y(const Plot *plot, double value) { return plot->box.y + plot->box.height * (1 - along(plot, 1, value)); }

void plot_frame(const Plot *plot, const char *title, const char *label_x, const char *label_y) {
    GuiRect b = plot->box;
    double em = gui_em();
    gui_draw_rect(b, PANEL, 0);
    gui_draw_frame(b, LINE, 0, 1);
    gui_draw_text(GUI_BOLD, b.x, b.y - 2.6 * em, INK, "%s", title);
    gui_draw_text(GUI_SMALL, b.x, b.y - 1.2 * em, INK_QUIET, "%s", label_y);
    gui_draw_text(GUI_SMALL, b.x + b.width - gui_text_width(GUI_SMALL, label_x), b.y + b.height + 1.4 * em, INK_QUIET,
                  "%s", label_x);
}

void plot_ticks(const Plot *plot, int axis, const double *values, int count, const char *format) {
    GuiRect b = plot->box;
    char text[32];
    for (int i = 0; i < count; i++) {
        snprintf(text, sizeof text, format, values[i]);
        double width = gui_text_width(GUI_SMALL, text), x = plot_x(plot, values[i]), y = plot_y(plot, values[i]);
        if (axis == 0) {
            gui_draw_line(x, b.y, x, b.y + b.height, LINE, 1);
            gui_draw_text(GUI_SMALL, x - width / 2, b.y + b.height + 0.25 * gui_em(), INK_QUIET, "%s", text);
        } else {
            gui_draw_line(b.x, y, b.x + b.width, y, LINE, 1);
            gui_draw_text(GUI_SMALL, b.x - width - 0.4 * gui_em(), y - 0.45 * gui_em(), INK_QUIET, "%s", text);
        }
    }
}

void plot_curve(const Plot *plot, const double *xy, int count, GuiColour colour, double width) {
    for (int i = 1; i < count; i++)
        gui_draw_line(plot_x(plot, xy[2 * i - 2]), plot_y(plot, xy[2 * i - 1]), plot_x(plot, xy[2 * i]),
                      plot_y(plot, xy[2 * i + 1]), colour, width);
}

// ---- ellipses ----

static void ellipse_points(double x, double y, Sym2 covariance, double k, double *xy) {
    Eigen2 e = sym2_eigen(covariance);
    double c = cos(e.angle_rad), s = sin(e.angle_rad), a = k * sqrt(e.major), b = k * sqrt(e.minor);
    for (int i = 0; i < ELLIPSE_POINTS; i++) {
        double t = 2 * M_PI * i / ELLIPSE_POINTS, u = a * cos(t), v = b * sin(t);
        xy[2 * i] = x + c * u - s * v;
        xy[2 * i + 1] = y + s * u + c * v;
    }
}

void figure_ellipse(double x, double y, Sym2 covariance, double k, GuiColour colour, double width) {
    double xy[2 * ELLIPSE_POINTS];
    ellipse_points(x, y, covariance, k, xy);
    gui_draw_curve(xy, ELLIPSE_POINTS, true, colour, width);
}

void figure_ellipse_filled(double x, double y, Sym2 covariance, double k, GuiColour colour) {
    double xy[2 * ELLIPSE_POINTS];
    ellipse_points(x, y, covariance, k, xy);
    gui_draw_shape(xy, ELLIPSE_POINTS, colour);
}

// Each ring over those outside it: alphas a_1 .. a_j leave prod (1 - a) of the ground, and that shall be 1 - opacity g.
void figure_blob(double x, double y, Sym2 covariance, GuiColour colour, double opacity) {
    double left = 1;
    for (int i = 0; i < BLOB_STEPS; i++) {
        double k = 3.0 * (BLOB_STEPS - i) / BLOB_STEPS, inside = k - 1.5 / BLOB_STEPS;
        double wanted = 1 - opacity * exp(-inside * inside / 2), alpha = 1 - wanted / left;
        figure_ellipse_filled(x, y, covariance, k, faded(colour, alpha));
        left = wanted;
    }
}

// ---- the rest ----

void figure_arrow(double x0, double y0, double x1, double y1, GuiColour colour, double width) {
    double dx = x1 - x0, dy = y1 - y0, length = hypot(dx, dy), head = fmin(4 + 2.5 * width, 0.6 * length);
    if (length < 0.5) return;
    dx /= length, dy /= length;
    double bx = x1 - head * dx, by = y1 - head * dy, half = 0.45 * head;
    gui_draw_line(x0, y0, bx, by, colour, width);
    gui_draw_shape((double[6]){x1, y1, bx - half * dy, by + half * dx, bx + half * dy, by - half * dx}, 3, colour);
}

void figure_label(GuiStyle style, double x, double y, GuiColour colour, const char *text) {
    gui_draw_text(style, x - gui_text_width(style, text) / 2, y, colour, "%s", text);
}

double figure_matrix(double x, double y, const double *values, int rows, int columns, const char *format,
                     GuiColour colour) {
    double em = gui_em(), row = 1.2 * gui_text_height(GUI_MONO_SMALL), column = 0;
    char text[32];
    for (int i = 0; i < rows * columns; i++) {
        snprintf(text, sizeof text, format, values[i]);
        column = fmax(column, gui_text_width(GUI_MONO_SMALL, text) + 0.7 * em);
    }
    double width = columns * column + 0.6 * em, height = rows * row;
    for (int side = 0; side < 2; side++) {
        double at = side ? x + width : x, serif = side ? -0.3 * em : 0.3 * em;
        gui_draw_line(at, y, at, y + height, INK_QUIET, 1.5);
        gui_draw_line(at, y, at + serif, y, INK_QUIET, 1.5);
        gui_draw_line(at, y + height, at + serif, y + height, INK_QUIET, 1.5);
    }
    for (int i = 0; i < rows * columns; i++) {
        snprintf(text, sizeof text, format, values[i]);
        double end = x + (i % columns + 1) * column;
        gui_draw_text(GUI_MONO_SMALL, end - gui_text_width(GUI_MONO_SMALL, text), y + i / columns * row + 0.1 * em,
                      colour, "%s", text);
    }
    return width;
}
