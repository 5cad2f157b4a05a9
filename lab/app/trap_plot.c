// trap_plot.c - the smaller eigenvalue of both walks over the steps: below zero there is no Gaussian.
#include "lab/app/palette.h"
#include "lab/app/trap_page.h"

#include <math.h>

static const double LAMBDA_HIGH = 1.6, LAMBDA_LOW = -1.9; // units^2
enum { STEPS_SHOWN_MIN = 100 };

static double y_of(GuiRect box, double lambda) {
    double t = (fmin(LAMBDA_HIGH, fmax(LAMBDA_LOW, lambda)) - LAMBDA_LOW) / (LAMBDA_HIGH - LAMBDA_LOW);
    return box.y + (1 - t) * box.height;
}

static void draw_walk(GuiRect box, const PsdWalk *walk, double steps, GuiColour inside) {
    for (int i = 1; i <= walk->step; i++) {
        double before = sym2_eigen(walk->path[i - 1]).minor, after = sym2_eigen(walk->path[i]).minor;
        gui_draw_line(box.x + box.width * (i - 1) / steps, y_of(box, before), box.x + box.width * i / steps,
                      y_of(box, after), after > 0 ? inside : BAD, 2.5);
    }
}

void trap_plot(const TrapPage *page, GuiRect place) {
    double em = gui_em();
    GuiRect box = {place.x + 2.2 * em, place.y + 2.2 * em, place.width - 2.6 * em, place.height - 4.2 * em};
    double zero = y_of(box, 0), steps = STEPS_SHOWN_MIN;
    for (int way = 0; way < PSD_WAY_COUNT; way++) steps = fmax(steps, page->trap.walks[way].step);
    gui_draw_text(GUI_BOLD, place.x, place.y, INK, "Smaller eigenvalue λ₂");
    gui_draw_rect((GuiRect){box.x, zero, box.width, box.y + box.height - zero}, 0xff6b6b14, 0);
    for (int level = -1; level <= 1; level++) {
        double y = y_of(box, level);
        gui_draw_line(box.x, y, box.x + box.width, y, level == 0 ? INK_QUIET : LINE, level == 0 ? 1.5 : 1);
        gui_draw_text(GUI_SMALL, box.x - 1.6 * em, y - 0.45 * em, INK_QUIET, "%d", level);
    }
    double label = gui_text_width(GUI_SMALL, "indefinite") + 0.5 * em; // on the right, where no walk crosses the line
    gui_draw_text(GUI_SMALL, box.x + box.width - label, zero + 0.3 * em, BAD, "indefinite");
    draw_walk(box, &page->trap.walks[PSD_FACTORED], steps, GOOD);
    draw_walk(box, &page->trap.walks[PSD_RAW], steps, ACCENT_WARM);
    gui_draw_text(GUI_SMALL, box.x, box.y + box.height + 0.4 * em, INK_QUIET, "0");
    gui_draw_text(GUI_SMALL, box.x + box.width - 3.5 * em, box.y + box.height + 0.4 * em, INK_QUIET, "%.0f steps",
                  steps);
}
