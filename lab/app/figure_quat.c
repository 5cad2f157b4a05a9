// figure_quat.c - the gradient of a loss by a quaternion, with and without the step through the normalisation.
//
// In the plane of w and z, q turns by 2 atan2(z, w) about z. The loss is -<R(q), target>, the target a turn by 100 degrees. It
// depends on the direction of q alone, so its gradient can have no part along q.
#include "lab/app/figure.h"
#include "lab/app/figure_draw.h"
#include "lab/app/palette.h"
#include "splat3d/reference.h"

#include <math.h>

enum { TURNS = 16, RADII = 3 };
static const double UNIT = 88, TARGET_RAD = 100 * M_PI / 180; // UNIT: points

static Mat3 d_rotation(void) { // of the loss, by R
    const double half[4] = {cos(TARGET_RAD / 2), 0, 0, sin(TARGET_RAD / 2)};
    Mat3 d = reference_rotation_forward(half);
    for (int k = 0; k < 9; k++) d.m[k] *= -0.25;
    return d;
}

// What is left of the gradient when q / |q| is taken for q on the way back: the derivative of R's entries by its w and z.
static void without_normalisation(const double q[4], const Mat3 *d, double d_q[4]) {
    double length = hypot(q[0], q[3]), w = q[0] / length, z = q[3] / length;
    d_q[0] = 2 * z * (d->m[3] - d->m[1]);
    d_q[3] = 2 * w * (d->m[3] - d->m[1]) - 4 * z * (d->m[0] + d->m[4]);
}

static double draw_field(double x, double y, bool is_right) {
    const Mat3 d = d_rotation();
    double worst = 0; // |q . d_q| / |q|
    for (int i = 0; i < TURNS * RADII; i++) {
        double turn = 2 * M_PI * (i % TURNS) / TURNS, radius = 0.6 + 0.4 * (i / TURNS), d_q[4] = {0};
        const double q[4] = {radius * cos(turn), 0, 0, radius * sin(turn)};
        if (is_right)
            reference_rotation_backward(q, &d, d_q);
        else
            without_normalisation(q, &d, d_q);
        double from_x = x + UNIT * q[0], from_y = y - UNIT * q[3];
        gui_draw_disc(from_x, from_y, 2.2, INK_QUIET);
        figure_arrow(from_x, from_y, from_x - 26 * d_q[0], from_y + 26 * d_q[3], is_right ? GOOD : BAD, 2);
        worst = fmax(worst, fabs(q[0] * d_q[0] + q[3] * d_q[3]) / radius);
    }
    return worst;
}

static bool draw(GuiRect place, json_t *numbers) {
    static const char *const names[2] = {"through q / |q|: along the circle", "without it: off the circle"};
    static const char *const keys[2] = {"with_normalisation", "without"};
    for (int side = 0; side < 2; side++) {
        double x = place.x + 205 + 390 * side, y = place.y + 208;
        figure_label(GUI_BOLD, x, place.y + 12, side ? BAD : GOOD, names[side]);
        for (int k = 0; k < RADII; k++) gui_draw_ring(x, y, UNIT * (0.6 + 0.4 * k), k == 1 ? INK_QUIET : LINE, 1.5);
        gui_draw_line(x - 165, y, x + 165, y, LINE, 1);
        gui_draw_line(x, y - 160, x, y + 160, LINE, 1);
        gui_draw_text(GUI_SMALL, x + 158, y + 4, INK_QUIET, "w");
        gui_draw_text(GUI_SMALL, x + 6, y - 168, INK_QUIET, "z");
        double c = cos(TARGET_RAD / 2), s = sin(TARGET_RAD / 2);
        gui_draw_line(x - 170 * c, y + 170 * s, x + 170 * c, y - 170 * s, ACCENT_WARM, 1.5);
        double worst = draw_field(x, y, side == 0);
        json_object_set_new(numbers, keys[side], json_pack("{sf}", "largest_part_along_q", worst));
    }
    gui_draw_text(GUI_SMALL, place.x + 20, place.y + 376, ACCENT_WARM,
                  "on this line q is the wanted turn, at every length");
    gui_draw_text(GUI_SMALL, place.x + 510, place.y + 376, INK_QUIET, "arrows: where a step of descent goes");
    return true;
}

const Figure FIGURE_QUAT = {"quat", "the gradient by a quaternion, with and without the normalisation", 800, 405, draw};
