// figure_ewa.c - equal balls in a row, as points through the true camera, and the ellipses that EWA makes of them.
#include "lab/app/figure.h"
#include "lab/app/figure_draw.h"
#include "lab/app/palette.h"
#include "splat3d/ewa_error.h"

#include <math.h>
#include <stdio.h>

enum { POINTS = 420 * EWA_GROUP, BALLS = 7 };
static const double ANGLES_DEG[BALLS] = {-60, -45, -25, 0, 25, 45, 60}, RATIO = 0.1, FOCAL_PX = 178;

static bool draw(GuiRect place, json_t *numbers) {
    EwaCloud cloud = ewa_cloud_create(POINTS, 1);
    double x0 = place.x + place.width / 2, y0 = place.y + 150;
    json_t *list = json_array();
    bool good = true;
    gui_draw_text(GUI_BOLD, place.x + 20, place.y + 12, INK,
                  "Seven equal balls at one depth, σ = z / 10, seen by a wide lens");
    gui_draw_line(place.x + 20, y0, place.x + place.width - 20, y0, LINE, 1);
    for (int i = 0; good && i < BALLS; i++) {
        EwaError error;
        Camera camera;
        GaussiansD g = ewa_ball(ANGLES_DEG[i] * M_PI / 180, RATIO, FOCAL_PX, &camera);
        good = ewa_error_measure(&cloud, &g, 0, &camera, &error);
        for (int k = 0; k < cloud.count; k += EWA_GROUP) { // one of each group: the others are its mirror images
            const double *mean = gaussiansd_at(&g, FIELD_MEAN, 0);
            double u, v, depth;
            Vec3 p = vec3_add(vec3(mean[0], mean[1], mean[2]), vec3_scale(cloud.points[k], RATIO));
            camera_project(&camera, p, &u, &v, &depth);
            gui_draw_rect((GuiRect){x0 + u - camera.cx - 0.8, y0 + v - camera.cy - 0.8, 1.6, 1.6}, faded(ACCENT, 0.7),
                          0);
        }
        double x = x0 + error.splat.mean_px[0] - camera.cx;
        for (int k = 1; k <= 2; k++) figure_ellipse(x, y0, error.splat.covariance, k, ACCENT_WARM, k == 2 ? 2.2 : 1.4);
        gui_draw_ring(x, y0, 2 * FOCAL_PX * RATIO, faded(BAD, 0.9), 1.2);
        char text[32];
        snprintf(text, sizeof text, "%.0f°", ANGLES_DEG[i]);
        figure_label(GUI_SMALL, x, place.y + 232, INK, text);
        snprintf(text, sizeof text, "%.1f", sqrt(error.splat.covariance.xx));
        figure_label(GUI_SMALL, x, place.y + 254, ACCENT_WARM, text);
        json_array_append_new(list, json_pack("{sf sf sf sf}", "angle_deg", ANGLES_DEG[i], "radial_px",
                                              sqrt(error.splat.covariance.xx), "tangential_px",
                                              sqrt(error.splat.covariance.yy), "shift", error.shift));
        gaussiansd_destroy(&g);
    }
    gui_draw_text(GUI_SMALL, place.x + 20, place.y + 284, ACCENT, "points of the ball, projected");
    gui_draw_text(GUI_SMALL, place.x + 262, place.y + 284, ACCENT_WARM,
                  "EWA: 1 and 2 σ; its radial σ in px = f σ / (z cos θ)");
    gui_draw_text(GUI_SMALL, place.x + 668, place.y + 284, BAD, "a circle, 2 σ");
    json_object_set_new(numbers, "balls", list);
    ewa_cloud_destroy(&cloud);
    return good;
}

const Figure FIGURE_EWA = {"ewa", "equal balls through a wide lens: true points and EWA's ellipses", 800, 315, draw};
