// figure_sh.c - the sixteen real spherical harmonics of a splat's colour, as globes: warm is positive, cold negative.
#include "lab/app/figure.h"
#include "lab/app/figure_draw.h"
#include "lab/app/figure_globe.h"
#include "lab/app/palette.h"
#include "splat3d/reference.h"

#include <math.h>
#include <stdio.h>

enum { SIDE = 100, WIDTH = 700, DEGREE = 3 };
static const double TILT[4] = {0.86, 0.42, -0.20, 0.22}; // of the eye

static void paint(Vec3 unit, const void *context, double rgb[3]) {
    static const double WARM[3] = {0.98, 0.66, 0.22}, COLD[3] = {0.27, 0.52, 1.0}, ZERO[3] = {0.16, 0.18, 0.23};
    double basis[SH_COEFFICIENTS_MAX], size;
    const double d[3] = {unit.x, unit.y, unit.z};
    reference_sh_basis(DEGREE, d, basis);
    double value = basis[*(const int *)context];
    size = fmin(1, fabs(value) / 0.65);
    size = round(size * 8) / 8; // in steps, as on a map
    for (int c = 0; c < 3; c++) rgb[c] = ZERO[c] + size * ((value > 0 ? WARM[c] : COLD[c]) - ZERO[c]);
}

static bool draw(GuiRect place, json_t *numbers) {
    ImageF sheet = imagef_create(WIDTH, (DEGREE + 1) * SIDE, 3);
    Mat3 eye = reference_rotation_forward(TILT);
    for (int k = 0; k < WIDTH * (DEGREE + 1) * SIDE * 3; k++)
        sheet.values[k] = (float[3]){0x10, 0x13, 0x1a}[k % 3] / 255;
    for (int l = 0; l <= DEGREE; l++)
        for (int m = -l; m <= l; m++) {
            int index = l * (l + 1) + m;
            figure_globe(&sheet, WIDTH / 2 + m * SIDE - SIDE / 2, l * SIDE, SIDE, &eye, 0.46 * SIDE, 0.9, paint,
                         &index);
        }
    Image8 bytes = image8_from_float(&sheet);
    gui_picture_fill(0, &bytes, false);
    gui_draw_picture(0, (GuiRect){place.x + 90, place.y + 10, WIDTH, (DEGREE + 1) * SIDE});
    image8_destroy(&bytes);
    imagef_destroy(&sheet);
    for (int l = 0; l <= DEGREE; l++) {
        double y = place.y + 10 + (l + 0.5) * SIDE;
        gui_draw_text(GUI_BODY, place.x + 16, y - 18, INK, "l = %d", l);
        gui_draw_text(GUI_SMALL, place.x + 16, y + 4, INK_QUIET, "%d x rgb", 2 * l + 1);
    }
    gui_draw_text(GUI_SMALL, place.x + 520, place.y + 30, ACCENT_WARM, "warm: brighter");
    gui_draw_text(GUI_SMALL, place.x + 520, place.y + 52, ACCENT, "cold: darker");
    gui_draw_text(GUI_SMALL, place.x + 520, place.y + 74, INK_QUIET, "m = −l … l from left to right");
    json_object_set_new(numbers, "functions", json_integer(SH_COEFFICIENTS_MAX));
    return true;
}

const Figure FIGURE_SH = {"sh", "the sixteen spherical harmonics of a splat's colour", 800, 420, draw};
