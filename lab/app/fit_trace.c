// fit_trace.c - points by step, and a plot of them.
#include "lab/app/fit_trace.h"

#include "lab/app/palette.h"

#include <math.h>
#include <stdio.h>

static const struct {
    const char *name, *format;
    GuiColour colour;
    bool from_zero;
} CURVES[FIT_CURVE_COUNT] = {
    {"Loss", "%.4f", ACCENT_WARM, true}, {"PSNR, dB", "%.2f", GOOD, false}, {"Gaussians", "%.0f", ACCENT, true}};

void fit_trace_add(FitTrace *trace, int step, const double value[FIT_CURVE_COUNT]) {
    if (trace->count == FIT_TRACE_POINTS) {
        trace->count = FIT_TRACE_POINTS / 2;
        for (int i = 0; i < trace->count; i++) {
            trace->step[i] = trace->step[2 * i];
            for (int c = 0; c < FIT_CURVE_COUNT; c++) trace->value[c][i] = trace->value[c][2 * i];
        }
    }
    trace->step[trace->count] = step;
    for (int c = 0; c < FIT_CURVE_COUNT; c++) trace->value[c][trace->count] = value[c];
    trace->count++;
}

// The distance of the lines of a grid: 1, 2 or 5 times a power of ten, so that there are about three of them.
static double grid_step(double range) {
    double power = pow(10, floor(log10(range / 3))), times = range / 3 / power;
    return power * (times >= 5 ? 5 : times >= 2 ? 2 : 1);
}

// What the vertical axis shows: whole steps of the grid.
static void find_range(const FitTrace *trace, FitCurve curve, double *low, double *high, double *grid) {
    *low = CURVES[curve].from_zero ? 0 : INFINITY;
    *high = -INFINITY;
    for (int i = 0; i < trace->count; i++) {
        *low = fmin(*low, trace->value[curve][i]);
        *high = fmax(*high, trace->value[curve][i]);
    }
    if (!(*high - *low > 1e-6 * fabs(*high))) *high = *low + 1; // nothing yet, or all the same
    *grid = grid_step(*high - *low);
    *low = *grid * floor(*low / *grid);
    *high = *grid * ceil(*high / *grid);
}

static void draw_grid(GuiRect box, double low, double high, double grid) {
    double em = gui_em();
    for (int i = 0; low + i * grid <= high + grid / 2; i++) {
        char text[32];
        double y = box.y + box.height * (1 - i * grid / (high - low));
        gui_draw_line(box.x, y, box.x + box.width, y, i == 0 ? INK_FAINT : LINE, 1);
        snprintf(text, sizeof text, "%.4g", low + i * grid);
        gui_draw_text(GUI_SMALL, box.x - gui_text_width(GUI_SMALL, text) - 0.5 * em, y - 0.45 * em, INK_QUIET, "%s",
                      text);
    }
}

void fit_trace_plot(const FitTrace *trace, FitCurve curve, int total, GuiRect place) {
    double em = gui_em(), xy[2 * FIT_TRACE_POINTS], low, high, grid;
    GuiRect box = {place.x + 3 * em, place.y + 1.9 * em, place.width - 3.6 * em, place.height - 3.6 * em};
    gui_draw_text(GUI_BOLD, place.x, place.y, INK, "%s", CURVES[curve].name);
    if (trace->count == 0 || box.height < em || box.width < em) return;
    char text[32];
    snprintf(text, sizeof text, CURVES[curve].format, trace->value[curve][trace->count - 1]);
    gui_draw_text(GUI_BOLD, box.x + box.width - gui_text_width(GUI_BOLD, text), place.y, CURVES[curve].colour, "%s",
                  text);
    find_range(trace, curve, &low, &high, &grid);
    draw_grid(box, low, high, grid);
    for (int i = 0; i < trace->count; i++) {
        xy[2 * i] = box.x + box.width * trace->step[i] / fmax(1, total);
        xy[2 * i + 1] = box.y + box.height * (high - trace->value[curve][i]) / (high - low);
    }
    gui_draw_curve(xy, trace->count, false, CURVES[curve].colour, 2);
    gui_draw_disc(xy[2 * trace->count - 2], xy[2 * trace->count - 1], 0.2 * em, CURVES[curve].colour);
    snprintf(text, sizeof text, "%d steps", total);
    gui_draw_text(GUI_SMALL, box.x, box.y + box.height + 0.35 * em, INK_QUIET, "0");
    gui_draw_text(GUI_SMALL, box.x + box.width - gui_text_width(GUI_SMALL, text), box.y + box.height + 0.35 * em,
                  INK_QUIET, "%s", text);
}
