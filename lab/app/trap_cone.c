// trap_cone.c - the valid matrices as the cone they are, with both walks in it.
//
// A symmetric matrix is a point (b, xy, a) with a = (xx + yy) / 2, b = (xx - yy) / 2; its eigenvalues are
// a +- sqrt(b^2 + xy^2), so the valid ones lie above the cone a = sqrt(b^2 + xy^2).
#include "lab/app/palette.h"
#include "lab/app/trap_page.h"

#include <math.h>

enum { RIM_POINTS = 72, RIBS = 24 };
static const double RIM_HEIGHT = 2.3, FLOOR = -1.7; // units^2; of the cone's rim, and the lowest point shown
static const double TILT = 0.32;                    // rad, how far the eye looks down on it

typedef struct {
    double x, y, scale; // the apex in the window; points per unit^2
    double turn_rad;
} ConeView;

static void project(const ConeView *view, const double point[3], double at[2]) {
    double c = cos(view->turn_rad), s = sin(view->turn_rad);
    double right = c * point[0] - s * point[1], away = s * point[0] + c * point[1];
    at[0] = view->x + view->scale * right;
    at[1] = view->y - view->scale * (cos(TILT) * point[2] + sin(TILT) * away);
}

static void rim_point(const ConeView *view, double height, double t, double at[2]) {
    project(view, (double[3]){height * cos(t), height * sin(t), height}, at);
}

static void draw_wall(const ConeView *view) {
    double rim[2 * RIM_POINTS], apex[2];
    project(view, (double[3]){0, 0, 0}, apex);
    for (int i = 0; i < RIM_POINTS; i++) rim_point(view, RIM_HEIGHT, 2 * M_PI * i / RIM_POINTS, &rim[2 * i]);
    for (int i = 0; i < RIM_POINTS; i++) {
        const double *p = &rim[2 * i], *q = &rim[2 * ((i + 1) % RIM_POINTS)];
        gui_draw_shape((double[6]){apex[0], apex[1], p[0], p[1], q[0], q[1]}, 3, 0x7aa2f712);
    }
    for (int i = 0; i < RIBS; i++) {
        double at[2];
        rim_point(view, RIM_HEIGHT, 2 * M_PI * i / RIBS, at);
        gui_draw_line(apex[0], apex[1], at[0], at[1], 0x7aa2f730, 1);
    }
    for (int ring = 1; ring <= 3; ring++) {
        double xy[2 * RIM_POINTS];
        for (int i = 0; i < RIM_POINTS; i++)
            rim_point(view, RIM_HEIGHT * ring / 3, 2 * M_PI * i / RIM_POINTS, &xy[2 * i]);
        gui_draw_curve(xy, RIM_POINTS, true, ring == 3 ? ACCENT : 0x7aa2f750, ring == 3 ? 2 : 1);
    }
}

static void draw_axis(const ConeView *view) {
    double low[2], high[2];
    project(view, (double[3]){0, 0, FLOOR}, low);
    project(view, (double[3]){0, 0, RIM_HEIGHT * 1.12}, high);
    gui_draw_line(low[0], low[1], high[0], high[1], INK_FAINT, 1);
    gui_draw_text(GUI_SMALL, high[0] + 6, high[1] - 4, INK_QUIET, "(xx + yy) / 2");
}

static void draw_walk(const ConeView *view, const PsdWalk *walk, GuiColour inside) {
    double before[2], at[2] = {0, 0}, point[3];
    bool valid = true;
    for (int i = 0; i <= walk->step; i++) {
        psd_cone_point(walk->path[i], point);
        valid = sym2_eigen(walk->path[i]).minor > 0;
        before[0] = at[0], before[1] = at[1];
        project(view, point, at);
        if (i > 0) gui_draw_line(before[0], before[1], at[0], at[1], valid ? inside : BAD, 2.5);
    }
    gui_draw_disc(at[0], at[1], 0.36 * gui_em(), valid ? inside : BAD);
    gui_draw_ring(at[0], at[1], 0.36 * gui_em(), 0x10131aff, 1.5);
}

void trap_cone(TrapPage *page, GuiRect place) {
    double em = gui_em(), at[2], point[3];
    ConeView view = {.scale = place.height / (RIM_HEIGHT * 1.45 - FLOOR), .turn_rad = page->turn_rad};
    view.x = place.x + place.width / 2;
    view.y = place.y + place.height + FLOOR * view.scale;
    draw_wall(&view);
    draw_axis(&view);
    draw_walk(&view, &page->trap.walks[PSD_FACTORED], GOOD);
    draw_walk(&view, &page->trap.walks[PSD_RAW], ACCENT_WARM);
    psd_cone_point(page->trap.target, point);
    project(&view, point, at);
    gui_draw_ring(at[0], at[1], 0.5 * em, 0xffffffff, 2);
    gui_draw_text(GUI_SMALL, at[0] + 0.7 * em, at[1] - 0.4 * em, INK, "photograph");
    gui_draw_text(GUI_BOLD, place.x, place.y, INK, "The cone of valid Σ");
    gui_draw_text(GUI_SMALL, place.x, place.y + 1.3 * em, ACCENT_WARM, "raw entries");
    gui_draw_text(GUI_SMALL, place.x, place.y + 2.4 * em, GOOD, "factored");
    gui_draw_text(GUI_SMALL, place.x, place.y + 3.5 * em, BAD, "outside");
    GuiMouse mouse = gui_mouse();
    bool over =
        mouse.x >= place.x && mouse.x < place.x + place.width && mouse.y >= place.y && mouse.y < place.y + place.height;
    if (over && mouse.down[GUI_LEFT]) page->turn_rad += mouse.moved_x * 0.01;
}
