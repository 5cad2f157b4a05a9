// formula.c - matrices on a panel.
#include "lab/app/formula.h"

#include "lab/app/palette.h"

#include <math.h>
#include <stdio.h>

const char *formula_number(double value, char *buffer, int size) {
    double magnitude = fabs(value);
    const char *format = magnitude == 0                         ? "%.0f"
                         : magnitude < 1e-6 || magnitude >= 1e7 ? "%.2e"
                         : magnitude < 0.1                      ? "%.6f"
                         : magnitude < 10                       ? "%.4f"
                                                                : "%.1f";
    snprintf(buffer, (size_t)size, format, magnitude == 0 ? 0.0 : value); // never -0
    return buffer;
}

static void bracket(double x, double y, double height, double serif) {
    gui_draw_line(x, y, x, y + height, INK_QUIET, 1.5);
    gui_draw_line(x, y, x + serif, y, INK_QUIET, 1.5);
    gui_draw_line(x, y + height, x + serif, y + height, INK_QUIET, 1.5);
}

void formula_matrix(const char *name, Sym2 matrix, const char *unit, GuiColour colour) {
    double em = gui_em(), row = 1.25 * gui_text_height(GUI_MONO_SMALL);
    GuiRect place = gui_take(gui_width_left(), 2 * row + 0.2 * em);
    double left = place.x + 3.4 * em, column = 5.6 * em, right = left + 2 * column + 0.6 * em;
    double middle = place.y + row - gui_text_height(GUI_BODY) / 2;
    gui_draw_text(GUI_BODY, place.x, middle, INK, "%s", name);
    gui_draw_text(GUI_BODY, left - 1.2 * em, middle, INK_QUIET, "=");
    bracket(left, place.y, 2 * row, 0.3 * em);
    bracket(right, place.y, 2 * row, -0.3 * em);
    const double entries[4] = {matrix.xx, matrix.xy, matrix.xy, matrix.yy};
    for (int i = 0; i < 4; i++) {
        char text[32];
        formula_number(entries[i], text, sizeof text);
        double end = left + (i % 2 + 1) * column - gui_text_width(GUI_MONO_SMALL, text);
        gui_draw_text(GUI_MONO_SMALL, end, place.y + (i / 2 + 0.12) * row, colour, "%s", text);
    }
    gui_draw_text(GUI_SMALL, right + 0.4 * em, middle + 0.1 * em, INK_QUIET, "%s", unit);
}
