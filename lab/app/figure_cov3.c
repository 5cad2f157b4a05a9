// figure_cov3.c - Sigma in three dimensions in three steps: a ball, stretched, turned by a quaternion.
#include "lab/app/figure.h"
#include "lab/app/figure_draw.h"
#include "lab/app/figure_globe.h"
#include "lab/app/palette.h"
#include "splat3d/reference.h"

#include <math.h>

enum { SIDE = 230 };
static const double QUAT[4] = {0.85, 0.15, -0.12, 0.48}, SIGMA[3] = {1.6, 0.9, 0.45}, SCALE = 66; // SCALE: px per unit
static const double TILT[4] = {0.92, 0.30, 0.25, 0}; // of the eye, for all three

static bool draw(GuiRect place, json_t *numbers) {
    static const char *const names[3] = {"a ball", "S stretches", "R(q) turns"};
    static const double NONE[4] = {1, 0, 0, 0};
    ImageF sheet = imagef_create(3 * SIDE, SIDE, 3);
    for (int k = 0; k < SIDE * SIDE * 9; k++) sheet.values[k] = (float[3]){0x10, 0x13, 0x1a}[k % 3] / 255;
    Mat3 eye = reference_rotation_forward(TILT);
    for (int i = 0; i < 3; i++) {
        double log_scale[3];
        Mat3 shape = reference_rotation_forward(i > 1 ? QUAT : NONE);
        for (int k = 0; k < 3; k++) log_scale[k] = i > 0 ? log(SIGMA[k]) : 0;
        for (int k = 0; k < 9; k++) shape.m[k] *= exp(log_scale[k % 3]);
        Mat3 seen = mat3_multiply(&eye, &shape);
        figure_globe(&sheet, i * SIDE, 0, SIDE, &seen, SCALE, 0.45, globe_paint_axes, NULL);
        Sym3 s = reference_covariance_forward(log_scale, i > 1 ? QUAT : NONE);
        const double entries[9] = {s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz};
        double x = place.x + 55 + (i + 0.5) * SIDE;
        figure_label(GUI_BOLD, x, place.y + 12, INK, names[i]);
        figure_matrix(x - 92, place.y + 282, entries, 3, 3, "%.2f", INK);
        gui_draw_text(GUI_SMALL, x - 122, place.y + 304, INK_QUIET, "Σ =");
        json_object_set_new(numbers, names[i],
                            json_pack("{s[ffffff] sf}", "xx_xy_xz_yy_yz_zz", s.xx, s.xy, s.xz, s.yy, s.yz, s.zz,
                                      "trace", s.xx + s.yy + s.zz));
    }
    Image8 bytes = image8_from_float(&sheet);
    gui_picture_fill(0, &bytes, false);
    gui_draw_picture(0, (GuiRect){place.x + 55, place.y + 40, 3 * SIDE, SIDE});
    image8_destroy(&bytes);
    imagef_destroy(&sheet);
    return true;
}

const Figure FIGURE_COV3 = {"cov3", "a 3-D covariance in three steps: ball, stretched, turned", 800, 365, draw};
