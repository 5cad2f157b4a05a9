// figure_nerf.c - NeRF's sum along a ray: the weights of few and of many segments, and how the error falls.
#include "lab/app/figure.h"
#include "lab/app/figure_draw.h"
#include "lab/app/palette.h"
#include "splat2d/fog.h"
#include "splat2d/volume_ray.h"

#include <math.h>
#include <stdio.h>

enum { FEW = 8, CURVE = 160, DOUBLINGS = 9 };
// Red in front, blue behind, densest in the middle; its optical depth is about 2.
static const VolumeRay FOG = {
    .near = 0,
    .far = 1,
    .count = 3,
    .bumps = {{0.3, 0.2, 1, {0.95, 0.35, 0.2}}, {0.5, 0.16, 2.4, {0.45, 0.8, 0.3}}, {0.7, 0.2, 1, {0.2, 0.4, 0.95}}}};

static void draw_ray(GuiRect place) {
    const double ticks_x[] = {0, 0.5, 1}, ticks_y[] = {0, 1, 2, 3, 4};
    Plot plot = {.box = {place.x + 44, place.y + 66, 320, 256}, .low = {0, 0}, .high = {1, 4}};
    double rgb[3], weights[FEW], xy[2 * CURVE];
    volume_ray_quadrature(&FOG, VOLUME_EXPONENTIAL, FEW, rgb, weights);
    plot_frame(&plot, "One ray, eight segments", "along the ray, t", "density σ; weight per length");
    plot_ticks(&plot, 0, ticks_x, 3, "%g");
    plot_ticks(&plot, 1, ticks_y, 5, "%g");
    for (int i = 0; i < FEW; i++) {
        double colour[3], left = plot_x(&plot, (double)i / FEW), top = plot_y(&plot, weights[i] * FEW);
        volume_ray_at(&FOG, (i + 0.5) / FEW, colour);
        gui_draw_rect((GuiRect){left + 1, top, plot.box.width / FEW - 2, plot_y(&plot, 0) - top},
                      colour_of(colour, 0.9), 2);
    }
    for (int i = 0; i < CURVE; i++) xy[2 * i] = i / (CURVE - 1.0), xy[2 * i + 1] = volume_ray_at(&FOG, xy[2 * i], rgb);
    plot_curve(&plot, xy, CURVE, INK_QUIET, 1.5);
    for (int i = 0; i < CURVE; i++) xy[2 * i + 1] *= volume_ray_transmittance(&FOG, xy[2 * i]);
    plot_curve(&plot, xy, CURVE, INK, 2.5);
    gui_draw_text(GUI_SMALL, plot_x(&plot, 0.64), plot_y(&plot, 3.45), INK_QUIET, "σ");
    gui_draw_text(GUI_SMALL, plot_x(&plot, 0.62), plot_y(&plot, 1.35), INK, "T σ");
}

static double error_of(VolumeRule rule, int n, const double exact[3]) {
    double rgb[3], worst = 0;
    volume_ray_quadrature(&FOG, rule, n, rgb, NULL);
    for (int c = 0; c < 3; c++) worst = fmax(worst, fabs(rgb[c] - exact[c]));
    return worst;
}

static bool draw(GuiRect place, json_t *numbers) {
    static const char *const names[] = {"exponential", "linear"};
    static const char *const labels[] = {"α = 1 − exp(−σδ): order %.2f", "α = σδ: order %.2f"};
    const GuiColour colours[] = {GOOD, BAD};
    const double ticks_x[] = {4, 16, 64, 256, 1024}, ticks_y[] = {1e-7, 1e-5, 1e-3, 1e-1};
    Plot plot = {
        .box = {place.x + 458, place.y + 66, 320, 256}, .low = {4, 1e-8}, .high = {1024, 1}, .is_log = {true, true}};
    double exact[3];
    draw_ray(place);
    volume_ray_integral(&FOG, exact);
    plot_frame(&plot, "The error of the colour", "segments", "largest of r, g, b");
    plot_ticks(&plot, 0, ticks_x, 5, "%g");
    plot_ticks(&plot, 1, ticks_y, 4, "%.0e");
    for (int rule = 0; rule < VOLUME_RULE_COUNT; rule++) {
        double xy[2 * DOUBLINGS];
        json_t *errors = json_array();
        for (int i = 0; i < DOUBLINGS; i++) {
            xy[2 * i] = 4 << i, xy[2 * i + 1] = error_of((VolumeRule)rule, 4 << i, exact);
            json_array_append_new(errors, json_real(xy[2 * i + 1]));
        }
        double order = log2(xy[2 * DOUBLINGS - 3] / xy[2 * DOUBLINGS - 1]);
        plot_curve(&plot, xy, DOUBLINGS, colours[rule], 2.5);
        for (int i = 0; i < DOUBLINGS; i++)
            gui_draw_disc(plot_x(&plot, xy[2 * i]), plot_y(&plot, xy[2 * i + 1]), 3.5, colours[rule]);
        char text[64];
        snprintf(text, sizeof text, labels[rule], order);
        gui_draw_text(GUI_SMALL, plot.box.x + (rule ? 120 : 14), plot.box.y + (rule ? 40 : 226), colours[rule], "%s",
                      text);
        json_object_set_new(numbers, names[rule],
                            json_pack("{sf so}", "order", order, "error_from_4_segments", errors));
    }
    json_t *gaps = json_array(), *floats = json_array();
    for (int i = 0; i < 4; i++) {
        const double opacities[] = {0.1, 0.5, 0.95, 0.99};
        double g, gap = splat_fog_gap_largest(opacities[i], &g);
        json_array_append_new(gaps, json_pack("{sf sf sf}", "opacity", opacities[i], "largest_gap", gap, "at_g", g));
    }
    for (int i = 2; i <= 6; i++) { // the worst of 1000 arguments between 10^-i and twice that
        double worst[2] = {0, 0};
        for (int k = 0; k < 1000; k++) {
            float x = (float)(pow(10, -i) * (1 + k / 1000.0));
            double is = -expm1(-(double)x);
            worst[0] = fmax(worst[0], fabs((double)fog_alpha_float_naive(x, 1) / is - 1));
            worst[1] = fmax(worst[1], fabs((double)fog_alpha_float(x, 1) / is - 1));
        }
        json_array_append_new(floats,
                              json_pack("{sf sf sf}", "alpha", pow(10, -i), "naive", worst[0], "expm1", worst[1]));
    }
    json_object_set_new(numbers, "splat_against_fog", gaps);
    json_object_set_new(numbers, "relative_error_in_float", floats);
    return true;
}

const Figure FIGURE_NERF = {"nerf", "NeRF's weights along a ray, and how its error falls with the segments", 800, 380,
                            draw};
