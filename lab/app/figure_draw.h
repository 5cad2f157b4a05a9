// figure_draw.h - what several figures draw: axes with curves, ellipses, arrows, matrices.
#ifndef SPLATLAB_LAB_APP_FIGURE_DRAW_H
#define SPLATLAB_LAB_APP_FIGURE_DRAW_H

#include "lab/app/gui.h"
#include "splat2d/covariance.h"

#include <stdbool.h>

// A pair of axes: values to points. With is_log an axis shows log10 of its values.
typedef struct {
    GuiRect box; // of the curves; labels stand outside
    double low[2], high[2];
    bool is_log[2];
} Plot;

double plot_x(const Plot *plot, double value);
double plot_y(const Plot *plot, double value);
void plot_frame(const Plot *plot, const char *title, const char *label_x, const char *label_y);
// Lines and numbers of one axis (0: x, 1: y).
void plot_ticks(const Plot *plot, int axis, const double *values, int count, const char *format);
void plot_curve(const Plot *plot, const double *xy, int count, GuiColour colour, double width); // xy: (count, 2) values

// The ellipse m = k of a covariance in points^2.
void figure_ellipse(double x, double y, Sym2 covariance, double k, GuiColour colour, double width);
void figure_ellipse_filled(double x, double y, Sym2 covariance, double k, GuiColour colour);
// A blob in the colour, as soft as g, in steps; opacity: at its centre.
void figure_blob(double x, double y, Sym2 covariance, GuiColour colour, double opacity);

void figure_arrow(double x0, double y0, double x1, double y1, GuiColour colour, double width);

// Text with its middle at x.
void figure_label(GuiStyle style, double x, double y, GuiColour colour, const char *text);

// Rows of numbers in brackets, its left upper corner at (x, y); values: (rows, columns). Returns its width.
double figure_matrix(double x, double y, const double *values, int rows, int columns, const char *format,
                     GuiColour colour);

#endif
