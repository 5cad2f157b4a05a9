// figure_ewa_error.c - the error of EWA over angle and size, by Monte Carlo, and one case as points.
#include "lab/app/figure.h"
#include "lab/app/figure_draw.h"
#include "lab/app/palette.h"
#include "splat3d/ewa_error.h"

#include <math.h>
#include <stdio.h>

enum {
    MAP_POINTS = 2400,
    TABLE_POINTS = 2400000,
    CLOUD_POINTS = 1800 * EWA_GROUP,
    CELL = 3,
    COLUMNS = 390 / CELL,
    ROWS = 270 / CELL,
    LEVELS = 7
};
static const double ANGLE_HIGH_DEG = 65, RATIO_HIGH = 0.3, FOCAL_PX = 130, CASE_DEG = 55, CASE_RATIO = 0.25;
static const double LEVEL_ENDS[LEVELS] = {0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 10}; // of the covariance error
static const GuiColour LEVEL_COLOURS[LEVELS] = {0x1d3b4cff, 0x1f6073ff, 0x2b8a8aff, 0x5fb37cff,
                                                0xd9c35aff, 0xe8873dff, 0xd9443fff};

static bool ball(const EwaCloud *cloud, double angle_deg, double ratio, EwaError *error) {
    return ewa_error_of_ball(cloud, angle_deg * M_PI / 180, ratio, FOCAL_PX, error);
}

static bool draw_map(const Plot *plot) {
    EwaCloud cloud = ewa_cloud_create(MAP_POINTS, 1);
    Image8 map = image8_create(COLUMNS, ROWS, 3);
    bool good = true;
    for (int i = 0; good && i < COLUMNS * ROWS; i++) {
        int column = i % COLUMNS, row = i / COLUMNS, level = 0;
        EwaError error;
        good = ball(&cloud, ANGLE_HIGH_DEG * (column + 0.5) / COLUMNS, RATIO_HIGH * (ROWS - row - 0.5) / ROWS, &error);
        while (error.covariance_error > LEVEL_ENDS[level] && level < LEVELS - 1) level++;
        for (int c = 0; c < 3; c++) map.bytes[3 * i + c] = (uint8_t)(LEVEL_COLOURS[level] >> (24 - 8 * c));
    }
    gui_picture_fill(0, &map, false);
    gui_draw_picture(0, plot->box);
    image8_destroy(&map);
    ewa_cloud_destroy(&cloud);
    return good;
}

static void draw_legend(double x, double y) {
    static const char *const names[LEVELS] = {"< 1", "< 2", "< 5", "< 10", "< 20", "< 50", "more %"};
    for (int i = 0; i < LEVELS; i++) {
        gui_draw_rect((GuiRect){x + 56 * i, y, 54, 11}, LEVEL_COLOURS[i], 2);
        figure_label(GUI_SMALL, x + 56 * i + 27, y + 14, INK_QUIET, names[i]);
    }
}

static bool draw_case(GuiRect place) {
    EwaCloud cloud = ewa_cloud_create(CLOUD_POINTS, 1);
    Camera camera;
    EwaError error;
    GaussiansD g = ewa_ball(CASE_DEG * M_PI / 180, CASE_RATIO, FOCAL_PX, &camera);
    bool good = ewa_error_measure(&cloud, &g, 0, &camera, &error);
    const double *mean = gaussiansd_at(&g, FIELD_MEAN, 0);
    double x0 = place.x + 134 - error.splat.mean_px[0], y0 = place.y + place.height / 2 - camera.cy, u, v, depth;
    for (int k = 0; k < cloud.count; k += EWA_GROUP) { // one of each group: the others are its mirror images
        Vec3 p = vec3_add(vec3(mean[0], mean[1], mean[2]), vec3_scale(cloud.points[k], CASE_RATIO));
        camera_project(&camera, p, &u, &v, &depth);
        u += x0, v += y0;
        if (u > place.x && u < place.x + place.width - 2 && v > place.y && v < place.y + place.height - 2)
            gui_draw_rect((GuiRect){u - 0.8, v - 0.8, 1.6, 1.6}, faded(ACCENT, 0.75), 0);
    }
    gui_draw_frame(place, LINE, 0, 1);
    for (int k = 1; k <= 2; k++) {
        figure_ellipse(x0 + error.splat.mean_px[0], y0 + error.splat.mean_px[1], error.splat.covariance, k, ACCENT_WARM,
                       2);
        figure_ellipse(x0 + error.mean_px[0], y0 + error.mean_px[1], error.covariance, k, GOOD, 2);
    }
    gui_draw_disc(x0 + error.splat.mean_px[0], y0 + error.splat.mean_px[1], 4, ACCENT_WARM);
    gui_draw_disc(x0 + error.mean_px[0], y0 + error.mean_px[1], 4, GOOD);
    ewa_cloud_destroy(&cloud);
    gaussiansd_destroy(&g);
    return good;
}

// The table of docs/ewa.md.
static bool add_table(json_t *numbers) {
    const double angles[] = {0, 30, 45, 60}, ratios[] = {0.05, 0.1, 0.2, 0.3};
    EwaCloud cloud = ewa_cloud_create(TABLE_POINTS, 1);
    json_t *list = json_array();
    bool good = true;
    for (int i = 0; good && i < 16; i++) {
        EwaError e;
        good = ball(&cloud, angles[i / 4], ratios[i % 4], &e);
        json_array_append_new(list, json_pack("{sf sf sf sf sf sf}", "angle_deg", angles[i / 4], "ratio", ratios[i % 4],
                                              "shift", e.shift, "predicted_shift",
                                              ratios[i % 4] * sin(angles[i / 4] * M_PI / 180), "covariance_error",
                                              e.covariance_error, "skew", e.skew));
    }
    json_object_update_new(numbers,
                           json_pack("{si sf so}", "points", cloud.count, "cut_factor", cloud.variance, "table", list));
    ewa_cloud_destroy(&cloud);
    return good;
}

static bool draw(GuiRect place, json_t *numbers) {
    const double ticks_x[] = {0, 15, 30, 45, 60}, ticks_y[] = {0.05, 0.1, 0.15, 0.2, 0.25};
    Plot plot = {.box = {place.x + 50, place.y + 66, CELL * COLUMNS, CELL * ROWS},
                 .low = {0, 0},
                 .high = {ANGLE_HIGH_DEG, RATIO_HIGH}};
    plot_frame(&plot, "Relative error of the covariance", "angle off the axis, degrees", "r = σ / z");
    plot_ticks(&plot, 0, ticks_x, 5, "%g");
    plot_ticks(&plot, 1, ticks_y, 5, "%.2f");
    if (!draw_map(&plot)) return false;
    draw_legend(plot.box.x, place.y + 388);
    gui_draw_ring(plot_x(&plot, CASE_DEG), plot_y(&plot, CASE_RATIO), 6, INK, 2);

    GuiRect right = {place.x + 478, place.y + 66, 302, 268};
    gui_draw_text(GUI_BOLD, right.x, place.y + 19, INK, "The ringed case: 55°, r = 0.25");
    gui_draw_text(GUI_SMALL, right.x, place.y + 43, INK_QUIET, "1 and 2 σ;  the axis lies to the left");
    if (!draw_case(right)) return false;
    gui_draw_text(GUI_SMALL, right.x, place.y + 342, ACCENT, "points through the true camera");
    gui_draw_text(GUI_SMALL, right.x, place.y + 363, GOOD, "their moments");
    gui_draw_text(GUI_SMALL, right.x, place.y + 384, ACCENT_WARM, "what EWA says");
    return add_table(numbers);
}

const Figure FIGURE_EWA_ERROR = {"ewa-error", "where EWA errs, by Monte Carlo over angle and size", 800, 425, draw};
