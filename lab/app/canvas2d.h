// canvas2d.h - where the canvas of a 2-D scene lies in the window, and what the mouse does to a blob on it.
//
// Window coordinates are points, canvas coordinates are px of the scene. No window is needed: all is arithmetic.
#ifndef SPLATLAB_LAB_APP_CANVAS2D_H
#define SPLATLAB_LAB_APP_CANVAS2D_H

#include "splat2d/raster2d.h"
#include "splat2d/scene2d.h"

static const double CANVAS_ZOOM_MIN = 0.05, CANVAS_ZOOM_MAX = 64;
static const double CANVAS_SIGMA_MIN = 0.5, CANVAS_SIGMA_MAX = 2000; // px; what handles and keys may reach

typedef struct {
    double x, y, width, height; // of the picture in the window
    View2d view;                // what of the canvas is seen there; zoom is points per canvas px
} Canvas2d;

void canvas2d_fit(Canvas2d *canvas, const Scene2d *scene);           // all of the scene's canvas, centred
void canvas2d_pan(Canvas2d *canvas, double moved_x, double moved_y); // points
// The canvas point under (x, y) of the window stays where it is.
void canvas2d_zoom(Canvas2d *canvas, double x, double y, double factor);
// After the place in the window changed: what was in the middle stays in the middle.
void canvas2d_place(Canvas2d *canvas, double x, double y, double width, double height);

void canvas2d_from_window(const Canvas2d *canvas, double x, double y, double point[2]);
void canvas2d_to_window(const Canvas2d *canvas, const double point[2], double window[2]);

// `count` points of the blob's ellipse of k standard deviations, in the window; xy is (count, 2).
void canvas2d_ellipse(const Canvas2d *canvas, const Blob *blob, double k, int count, double *xy);

// The handles of a blob: two on each axis, one standard deviation from the mean, and one to turn it, `arm` points beyond
// the end of the first axis.
typedef enum { GRIP_NONE, GRIP_BODY, GRIP_X, GRIP_X_BACK, GRIP_Y, GRIP_Y_BACK, GRIP_TURN, GRIP_COUNT } Grip;

void canvas2d_grip(const Canvas2d *canvas, const Blob *blob, Grip grip, double arm, double window[2]);

// The handle within `reach` points of (x, y), else the body when the point is inside the ellipse of 2 sigma.
Grip canvas2d_grip_at(const Canvas2d *canvas, const Blob *blob, double x, double y, double arm, double reach);

// A drag: what was taken hold of, where, and what the blob was then.
typedef struct {
    Grip grip;
    double x, y; // window
    Blob blob;
} Drag2d;

// The blob when the mouse has come to (x, y). It moves by what the mouse moved; a sigma changes by what the mouse moved
// along its axis; it turns by the angle that the mouse went round the mean. snap: turns in steps of 15 degrees.
Blob drag2d_blob(const Drag2d *drag, const Canvas2d *canvas, double x, double y, bool snap);

// The same direction in (-pi, pi].
double angle_wrap(double angle_rad);

#endif
