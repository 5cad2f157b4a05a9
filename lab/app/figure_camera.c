// figure_camera.c - how the pixel of a point moves when the point does: the columns of J, over the picture.
#include "lab/app/figure.h"
#include "lab/app/figure_draw.h"
#include "lab/app/palette.h"
#include "splat3d/camera.h"

#include <math.h>

enum { WIDTH = 520, HEIGHT = 340, COLUMNS = 5, ROWS = 3 };
static const double FOCAL_PX = 300, DEPTH = 4, STEP = 0.5, H = 1e-5; // world units; H: of the differences

// Column `axis` of J at p, px per world unit, by central differences of camera_project().
static void column(const Camera *camera, Vec3 p, int axis, double j[2]) {
    Vec3 h = vec3(axis == 0 ? H : 0, axis == 1 ? H : 0, axis == 2 ? H : 0);
    double a[2], b[2], depth;
    camera_project(camera, vec3_add(p, h), &a[0], &a[1], &depth);
    camera_project(camera, vec3_sub(p, h), &b[0], &b[1], &depth);
    for (int k = 0; k < 2; k++) j[k] = (a[k] - b[k]) / (2 * H);
}

static double draw_point(const Camera *camera, double x0, double y0, Vec3 p) {
    static const GuiColour COLOURS[3] = {0xff6b6bff, 0x5fd6a0ff, 0x7aa2f7ff};
    double u, v, depth, along[2] = {0, 0};
    camera_project(camera, p, &u, &v, &depth);
    for (int axis = 0; axis < 3; axis++) {
        double j[2];
        column(camera, p, axis, j);
        figure_arrow(x0 + u, y0 + v, x0 + u + STEP * j[0], y0 + v + STEP * j[1], COLOURS[axis], 2.5);
        for (int k = 0; k < 2; k++) along[k] += j[k] * (axis == 0 ? p.x : axis == 1 ? p.y : p.z);
    }
    gui_draw_disc(x0 + u, y0 + v, 3.5, INK);
    return hypot(along[0], along[1]); // |J p|
}

static bool draw(GuiRect place, json_t *numbers) {
    double x0 = place.x + 20, y0 = place.y + 44, worst = 0, left = x0 + WIDTH + 22;
    const Camera camera = {.width = WIDTH,
                           .height = HEIGHT,
                           .fx = FOCAL_PX,
                           .fy = FOCAL_PX,
                           .cx = WIDTH / 2.0,
                           .cy = HEIGHT / 2.0,
                           .rotation = {{1, 0, 0, 0, 1, 0, 0, 0, 1}}};
    gui_draw_text(GUI_BOLD, x0, place.y + 14, INK, "The columns of J, at fifteen points of depth 4");
    gui_draw_rect((GuiRect){x0, y0, WIDTH, HEIGHT}, PANEL, 0);
    gui_draw_frame((GuiRect){x0, y0, WIDTH, HEIGHT}, LINE, 0, 1);
    for (int i = 0; i < COLUMNS * ROWS; i++) {
        double x = (i % COLUMNS - (COLUMNS - 1) / 2.0) * 1.4, y = (i / COLUMNS - (ROWS - 1) / 2.0) * 1.5;
        gui_draw_line(x0 + camera.cx, y0 + camera.cy, x0 + camera.cx + FOCAL_PX * x / DEPTH,
                      y0 + camera.cy + FOCAL_PX * y / DEPTH, LINE, 1);
    }
    for (int i = 0; i < COLUMNS * ROWS; i++) {
        double x = (i % COLUMNS - (COLUMNS - 1) / 2.0) * 1.4, y = (i / COLUMNS - (ROWS - 1) / 2.0) * 1.5;
        worst = fmax(worst, draw_point(&camera, x0, y0, vec3(x, y, DEPTH)));
    }
    gui_draw_text(GUI_BODY, left, y0 + 6, BAD, "½ unit to the right, x");
    gui_draw_text(GUI_BODY, left, y0 + 34, GOOD, "½ unit down, y");
    gui_draw_text(GUI_BODY, left, y0 + 62, ACCENT, "½ unit away, z");
    gui_draw_text(GUI_SMALL, left, y0 + 112, INK_QUIET, "Away is inwards: towards");
    gui_draw_text(GUI_SMALL, left, y0 + 132, INK_QUIET, "the principal point, the more");
    gui_draw_text(GUI_SMALL, left, y0 + 152, INK_QUIET, "the farther out. In the middle");
    gui_draw_text(GUI_SMALL, left, y0 + 172, INK_QUIET, "the third column is 0: a");
    gui_draw_text(GUI_SMALL, left, y0 + 192, INK_QUIET, "camera sees no depth.");
    gui_draw_text(GUI_SMALL, left, y0 + 232, INK_QUIET, "x, y, z times the columns");
    gui_draw_text(GUI_SMALL, left, y0 + 252, INK_QUIET, "cancel: J t = 0. A point on its");
    gui_draw_text(GUI_SMALL, left, y0 + 272, INK_QUIET, "own ray stays in its pixel.");
    json_object_set_new(numbers, "largest_J_t_px", json_real(worst));
    return true;
}

const Figure FIGURE_CAMERA = {"camera", "the columns of the projection's Jacobian, over the picture", 800, 405, draw};
