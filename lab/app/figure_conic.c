// figure_conic.c - lines of equal Mahalanobis distance, and two boxes round the ellipse of 3 sigma.
#include "lab/app/figure.h"
#include "lab/app/figure_draw.h"
#include "lab/app/palette.h"

#include <math.h>
#include <stdio.h>

static const double SIGMA_X = 62, SIGMA_Y = 15, ANGLE_RAD = -0.5, K = 3; // px

static void draw_probe(double x, double y, Sym2 conic, double dx, double dy, GuiColour colour) {
    double m = sqrt(conic_mahalanobis2(conic, dx, dy));
    gui_draw_disc(x + dx, y + dy, 5, colour);
    gui_draw_ring(x + dx, y + dy, 5, PANEL_DEEP, 1.5);
    gui_draw_rect((GuiRect){x + dx + 8, y + dy - 10, 102, 21}, faded(PANEL_DEEP, 0.75), 4);
    gui_draw_text(GUI_SMALL, x + dx + 12, y + dy - 9, colour, "%.0f px, m = %.1f", hypot(dx, dy), m);
}

static bool draw(GuiRect place, json_t *numbers) {
    double x = place.x + 235, y = place.y + 205, half[2];
    Sym2 s = covariance_from_angle(ANGLE_RAD, SIGMA_X, SIGMA_Y), conic;
    if (!covariance_conic(s, &conic)) return false;
    covariance_box(s, K, &half[0], &half[1]);
    double radius = K * sqrt(sym2_eigen(s).major), exact = 4 * half[0] * half[1], square = 4 * radius * radius;
    figure_blob(x, y, s, 0x4f7fd6ff, 0.95);
    gui_draw_frame((GuiRect){x - radius, y - radius, 2 * radius, 2 * radius}, faded(BAD, 0.8), 0, 1.5);
    gui_draw_ring(x, y, radius, faded(BAD, 0.5), 1.5);
    gui_draw_frame((GuiRect){x - half[0], y - half[1], 2 * half[0], 2 * half[1]}, GOOD, 0, 2.5);
    for (int k = 1; k <= 3; k++) figure_ellipse(x, y, s, k, k == 3 ? ACCENT_WARM : INK, k == 3 ? 2.5 : 1.5);
    draw_probe(x, y, conic, 62 * cos(ANGLE_RAD), 62 * sin(ANGLE_RAD), INK);
    draw_probe(x, y, conic, -62 * sin(ANGLE_RAD), 62 * cos(ANGLE_RAD), ACCENT_WARM);

    double left = place.x + 490, top = place.y + 26;
    const double sigma[4] = {s.xx, s.xy, s.xy, s.yy}, inverse[4] = {conic.xx, conic.xy, conic.xy, conic.yy};
    gui_draw_text(GUI_BODY, left, top + 10, INK, "Σ =");
    figure_matrix(left + 50, top, sigma, 2, 2, "%.1f", INK);
    gui_draw_text(GUI_SMALL, left + 240, top + 12, INK_QUIET, "px²");
    gui_draw_text(GUI_BODY, left, top + 74, INK, "Σ⁻¹ =");
    figure_matrix(left + 62, top + 64, inverse, 2, 2, "%.5f", INK);
    gui_draw_text(GUI_SMALL, left, top + 138, INK_QUIET, "Two points, both 62 px away: one is");
    gui_draw_text(GUI_SMALL, left, top + 158, INK_QUIET, "at m = 1, the other far outside.");
    gui_draw_text(GUI_BOLD, left, top + 205, GOOD, "exact box: ±3 √xx, ±3 √yy");
    gui_draw_text(GUI_SMALL, left, top + 230, INK, "%.0f x %.0f = %.0f px²", 2 * half[0], 2 * half[1], exact);
    gui_draw_text(GUI_BOLD, left, top + 270, BAD, "circle: ±3 √λ₁ on every side");
    gui_draw_text(GUI_SMALL, left, top + 295, INK, "%.0f x %.0f = %.0f px², %.1f times as many", 2 * radius, 2 * radius,
                  square, square / exact);
    json_object_update_new(numbers, json_pack("{s[fff] s[fff] sf sf}", "covariance", s.xx, s.xy, s.yy, "conic",
                                              conic.xx, conic.xy, conic.yy, "box_px2", exact, "square_px2", square));
    return true;
}

const Figure FIGURE_CONIC = {"conic", "equal Mahalanobis distance, and two boxes round it", 800, 410, draw};
