// canvas2d.c - window and canvas coordinates, handles and drags.
#include "lab/app/canvas2d.h"

#include <math.h>

static const double PICK_SIGMAS = 2;
static const double SNAP_RAD = M_PI / 12;

static double clamp(double value, double low, double high) { return fmin(high, fmax(low, value)); }

double angle_wrap(double angle_rad) {
    double wrapped = remainder(angle_rad, 2 * M_PI);
    return wrapped <= -M_PI ? M_PI : wrapped;
}

// ---- view ----

void canvas2d_fit(Canvas2d *canvas, const Scene2d *scene) {
    double zoom = fmin(canvas->width / scene->width, canvas->height / scene->height);
    zoom = clamp(zoom, CANVAS_ZOOM_MIN, CANVAS_ZOOM_MAX);
    canvas->view = (View2d){.left = (scene->width - canvas->width / zoom) / 2,
                            .top = (scene->height - canvas->height / zoom) / 2,
                            .zoom = zoom};
}

void canvas2d_pan(Canvas2d *canvas, double moved_x, double moved_y) {
    canvas->view.left -= moved_x / canvas->view.zoom;
    canvas->view.top -= moved_y / canvas->view.zoom;
}

void canvas2d_zoom(Canvas2d *canvas, double x, double y, double factor) {
    double fixed[2];
    canvas2d_from_window(canvas, x, y, fixed);
    canvas->view.zoom = clamp(canvas->view.zoom * factor, CANVAS_ZOOM_MIN, CANVAS_ZOOM_MAX);
    canvas->view.left = fixed[0] - (x - canvas->x) / canvas->view.zoom;
    canvas->view.top = fixed[1] - (y - canvas->y) / canvas->view.zoom;
}

void canvas2d_place(Canvas2d *canvas, double x, double y, double width, double height) {
    canvas->view.left += (canvas->width - width) / 2 / canvas->view.zoom;
    canvas->view.top += (canvas->height - height) / 2 / canvas->view.zoom;
    canvas->x = x, canvas->y = y, canvas->width = width, canvas->height = height;
}

void canvas2d_from_window(const Canvas2d *canvas, double x, double y, double point[2]) {
    point[0] = canvas->view.left + (x - canvas->x) / canvas->view.zoom;
    point[1] = canvas->view.top + (y - canvas->y) / canvas->view.zoom;
}

void canvas2d_to_window(const Canvas2d *canvas, const double point[2], double window[2]) {
    window[0] = canvas->x + (point[0] - canvas->view.left) * canvas->view.zoom;
    window[1] = canvas->y + (point[1] - canvas->view.top) * canvas->view.zoom;
}

// ---- ellipse and handles ----

// The canvas point mean + u axis_x + v axis_y, in the window.
static void from_axes(const Canvas2d *canvas, const Blob *blob, double u, double v, double window[2]) {
    double c = cos(blob->theta_rad), s = sin(blob->theta_rad);
    double point[2] = {blob->mean[0] + u * c - v * s, blob->mean[1] + u * s + v * c};
    canvas2d_to_window(canvas, point, window);
}

void canvas2d_ellipse(const Canvas2d *canvas, const Blob *blob, double k, int count, double *xy) {
    for (int i = 0; i < count; i++) {
        double t = 2 * M_PI * i / count;
        from_axes(canvas, blob, k * blob->sigma_x * cos(t), k * blob->sigma_y * sin(t), &xy[2 * i]);
    }
}

void canvas2d_grip(const Canvas2d *canvas, const Blob *blob, Grip grip, double arm, double window[2]) {
    double u = 0, v = 0;
    if (grip == GRIP_X) u = blob->sigma_x;
    if (grip == GRIP_X_BACK) u = -blob->sigma_x;
    if (grip == GRIP_Y) v = blob->sigma_y;
    if (grip == GRIP_Y_BACK) v = -blob->sigma_y;
    if (grip == GRIP_TURN) u = blob->sigma_x + arm / canvas->view.zoom;
    from_axes(canvas, blob, u, v, window);
}

Grip canvas2d_grip_at(const Canvas2d *canvas, const Blob *blob, double x, double y, double arm, double reach) {
    Grip best = GRIP_NONE;
    double best_distance = reach;
    for (Grip grip = GRIP_X; grip <= GRIP_TURN; grip++) {
        double at[2];
        canvas2d_grip(canvas, blob, grip, arm, at);
        double distance = hypot(x - at[0], y - at[1]);
        if (distance <= best_distance) best = grip, best_distance = distance;
    }
    if (best != GRIP_NONE) return best;
    double point[2];
    Sym2 conic;
    canvas2d_from_window(canvas, x, y, point);
    bool inside = blob_conic(blob, &conic) && conic_mahalanobis2(conic, point[0] - blob->mean[0],
                                                                 point[1] - blob->mean[1]) <= PICK_SIGMAS * PICK_SIGMAS;
    return inside ? GRIP_BODY : GRIP_NONE;
}

// ---- drags ----

static double turned_by(const Drag2d *drag, const Canvas2d *canvas, double x, double y) {
    double mean[2];
    canvas2d_to_window(canvas, drag->blob.mean, mean);
    return atan2(y - mean[1], x - mean[0]) - atan2(drag->y - mean[1], drag->x - mean[0]);
}

Blob drag2d_blob(const Drag2d *drag, const Canvas2d *canvas, double x, double y, bool snap) {
    Blob blob = drag->blob;
    double dx = (x - drag->x) / canvas->view.zoom, dy = (y - drag->y) / canvas->view.zoom;
    double c = cos(blob.theta_rad), s = sin(blob.theta_rad);
    double along = dx * c + dy * s, across = dy * c - dx * s;
    if (drag->grip == GRIP_X_BACK) along = -along;
    if (drag->grip == GRIP_Y_BACK) across = -across;
    switch (drag->grip) {
    case GRIP_BODY:
        blob.mean[0] = clamp(blob.mean[0] + dx, -SCENE2D_MEAN_MAX, SCENE2D_MEAN_MAX);
        blob.mean[1] = clamp(blob.mean[1] + dy, -SCENE2D_MEAN_MAX, SCENE2D_MEAN_MAX);
        break;
    case GRIP_X:
    case GRIP_X_BACK:
        blob.sigma_x = clamp(blob.sigma_x + along, CANVAS_SIGMA_MIN, CANVAS_SIGMA_MAX);
        break;
    case GRIP_Y:
    case GRIP_Y_BACK:
        blob.sigma_y = clamp(blob.sigma_y + across, CANVAS_SIGMA_MIN, CANVAS_SIGMA_MAX);
        break;
    case GRIP_TURN:
        blob.theta_rad = angle_wrap(blob.theta_rad + turned_by(drag, canvas, x, y));
        if (snap) blob.theta_rad = angle_wrap(round(blob.theta_rad / SNAP_RAD) * SNAP_RAD);
        break;
    default:
        break;
    }
    return blob;
}
