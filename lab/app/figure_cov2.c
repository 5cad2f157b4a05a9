// figure_cov2.c - Sigma in three steps: a round cloud, stretched, turned.
#include "lab/app/figure.h"
#include "lab/app/figure_draw.h"
#include "lab/app/palette.h"
#include "lab/base/rng.h"

#include <math.h>

enum { POINTS = 200 };
static const double UNIT = 33, SIGMA_X = 2.4, SIGMA_Y = 0.8, ANGLE_RAD = 35 * M_PI / 180; // UNIT: points

// The image of (u, v) after the first `steps` of: stretch, turn.
static void map(int steps, double u, double v, double to[2]) {
    if (steps > 0) u *= SIGMA_X, v *= SIGMA_Y;
    double c = steps > 1 ? cos(ANGLE_RAD) : 1, s = steps > 1 ? sin(ANGLE_RAD) : 0;
    to[0] = UNIT * (c * u - s * v), to[1] = UNIT * (s * u + c * v);
}

static void draw_cloud(int steps, double x, double y) {
    Rng rng = rng_at(2, RNG_FIGURE, 0, 0);
    double to[2];
    for (int i = 0; i < POINTS; i++) {
        double u = rng_normal(&rng), v = rng_normal(&rng), turn = atan2(v, u);
        const double rgb[3] = {0.55 + 0.4 * cos(turn), 0.62 + 0.3 * cos(turn - 2.1), 0.7 + 0.3 * cos(turn - 4.2)};
        map(steps, u, v, to);
        gui_draw_disc(x + to[0], y + to[1], 2, colour_of(rgb, 0.85));
    }
}

static void draw_axes(int steps, double x, double y) {
    double to[2];
    map(steps, 1, 0, to);
    figure_arrow(x, y, x + to[0], y + to[1], ACCENT_WARM, 2.5);
    map(steps, 0, 1, to);
    figure_arrow(x, y, x + to[0], y + to[1], GOOD, 2.5);
}

static bool draw(GuiRect place, json_t *numbers) {
    static const char *const names[3] = {"a round cloud", "S stretches", "R turns"};
    static const char *const formulas[3] = {"I", "S Sᵀ", "R S Sᵀ Rᵀ"};
    for (int i = 0; i < 3; i++) {
        double x = place.x + place.width * (i == 0 ? 0.155 : i == 1 ? 0.47 : 0.81), y = place.y + 165;
        Sym2 s = covariance_from_angle(i > 1 ? ANGLE_RAD : 0, i ? SIGMA_X : 1, i ? SIGMA_Y : 1);
        Sym2 points2 = {s.xx * UNIT * UNIT, s.xy * UNIT * UNIT, s.yy * UNIT * UNIT};
        figure_label(GUI_BOLD, x, place.y + 12, INK, names[i]);
        draw_cloud(i, x, y);
        figure_ellipse(x, y, points2, 1, INK, 2);
        figure_ellipse(x, y, points2, 2, INK_FAINT, 1.5);
        draw_axes(i, x, y);
        const double entries[4] = {s.xx, s.xy, s.xy, s.yy};
        double left = x - 98;
        double wide = gui_text_width(GUI_SMALL, formulas[i]);
        gui_draw_text(GUI_SMALL, left + 78 - wide, place.y + 318, INK_QUIET, "%s =", formulas[i]);
        figure_matrix(left + 108, place.y + 306, entries, 2, 2, "%.2f", INK);
        Eigen2 e = sym2_eigen(s);
        json_object_set_new(numbers, formulas[i],
                            json_pack("{s[fff] s[ff]}", "xx_xy_yy", s.xx, s.xy, s.yy, "eigenvalues", e.major, e.minor));
    }
    return true;
}

const Figure FIGURE_COV2 = {"cov2", "a 2-D covariance in three steps: round, stretched, turned", 800, 360, draw};
