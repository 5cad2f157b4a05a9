// figure_composite.c - one pixel's walk: the transmittance falls in steps, and the steps are the weights.
#include "lab/app/figure.h"
#include "lab/app/figure_draw.h"
#include "lab/app/palette.h"
#include "splat2d/compositing.h"

#include <stdio.h>

enum { HITS = 5 };
static const double ALPHAS[HITS] = {0.25, 0.45, 0.30, 0.70, 0.50};
static const double COLOURS[HITS][3] = {
    {0.36, 0.62, 0.97}, {0.37, 0.84, 0.63}, {0.95, 0.72, 0.29}, {0.97, 0.42, 0.42}, {0.72, 0.52, 0.95}};
static const double BACKGROUND[3] = {0.42, 0.44, 0.48};

// One step: the part of T that this splat takes away, in its colour, and T behind it.
static void draw_step(const Plot *plot, int i, double before, double after) {
    double x = plot_x(plot, i + 0.5), next = plot_x(plot, i + 1.5), top = plot_y(plot, before);
    double bottom = plot_y(plot, after), right = plot->box.x + plot->box.width;
    gui_draw_rect((GuiRect){x, top, right - x, bottom - top}, colour_of(COLOURS[i], 0.22), 0);
    gui_draw_rect((GuiRect){x - 7, top, 14, bottom - top}, colour_of(COLOURS[i], 1), 0);
    gui_draw_line(plot_x(plot, i - 0.5 < 0 ? 0 : i - 0.5), top, x, top, INK, 2.5);
    gui_draw_line(x, bottom, i == HITS - 1 ? right : next, bottom, INK, 2.5);
    gui_draw_text(GUI_SMALL, x + 12, (top + bottom) / 2 - 9, INK, "%.3f", before - after);
}

static void draw_bar(GuiRect bar, const double *weights, double left) {
    double y = bar.y;
    for (int i = 0; i <= HITS; i++) {
        double height = bar.height * (i < HITS ? weights[i] : left);
        gui_draw_rect((GuiRect){bar.x, y, bar.width, height}, colour_of(i < HITS ? COLOURS[i] : BACKGROUND, 1), 0);
        y += height;
    }
    gui_draw_frame(bar, INK_QUIET, 0, 1);
}

static bool draw(GuiRect place, json_t *numbers) {
    const CompositeRule rule = composite_rule_default();
    const double levels[] = {0, 0.25, 0.5, 0.75, 1};
    Plot plot = {.box = {place.x + 62, place.y + 66, 470, 250}, .low = {0, 0}, .high = {HITS + 0.4, 1}};
    Composite pixel = composite_begin();
    double weights[HITS];
    plot_frame(&plot, "What gets through, from front to back", "splats in the order of their depth →", "T");
    plot_ticks(&plot, 1, levels, 5, "%.2f");
    json_t *list = json_array();
    for (int i = 0; i < HITS; i++) {
        double before = pixel.transmittance;
        weights[i] = composite_blend(&pixel, &rule, ALPHAS[i], COLOURS[i]);
        draw_step(&plot, i, before, pixel.transmittance);
        char text[32];
        snprintf(text, sizeof text, "α=%.2f", ALPHAS[i]);
        figure_label(GUI_SMALL, plot_x(&plot, i + 0.5), plot.box.y + plot.box.height + 5, colour_of(COLOURS[i], 1),
                     text);
        json_array_append_new(list, json_real(weights[i]));
    }
    composite_end(&pixel, BACKGROUND);
    GuiRect bar = {place.x + 582, plot.box.y, 46, plot.box.height};
    draw_bar(bar, weights, pixel.transmittance);
    figure_label(GUI_SMALL, bar.x + 23, bar.y - 22, INK_QUIET, "weights + T = 1");
    gui_draw_text(GUI_SMALL, bar.x + 54, bar.y + bar.height * (1 - pixel.transmittance / 2) - 9, INK_QUIET, "T %.3f",
                  pixel.transmittance);
    GuiRect swatch = {place.x + 682, plot.box.y, 92, 92};
    gui_draw_rect(swatch, colour_of(pixel.rgb, 1), 8);
    figure_label(GUI_SMALL, swatch.x + 46, swatch.y - 22, INK_QUIET, "the pixel");
    for (int c = 0; c < 3; c++)
        gui_draw_text(GUI_MONO_SMALL, swatch.x + 8, swatch.y + 104 + 20 * c, INK, "%c %.3f", "rgb"[c], pixel.rgb[c]);
    json_object_update_new(numbers, json_pack("{so sf s[fff]}", "weights", list, "transmittance", pixel.transmittance,
                                              "rgb", pixel.rgb[0], pixel.rgb[1], pixel.rgb[2]));
    return true;
}

const Figure FIGURE_COMPOSITE = {"composite", "the staircase of transmittance, and the weights that are its steps", 800,
                                 370, draw};
