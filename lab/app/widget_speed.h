// widget_speed.h - how many frames a second the widget makes on this machine.
#ifndef SPLATLAB_LAB_APP_WIDGET_SPEED_H
#define SPLATLAB_LAB_APP_WIDGET_SPEED_H

#include "lab/app/screen.h"
#include "splat2d/scene2d.h"

#include <stdbool.h>

enum { WIDGET_SPEED_WIDTH = 1320, WIDGET_SPEED_HEIGHT = 938 }; // points: the canvas is then 960 x 720

// Draws frames in which one blob turns, of the scene and of one of 200 random blobs: without a window (all that is the
// widget's own work), and in a window where there is a display (with the work of its graphics driver). Prints medians, as a
// table or as JSON.
bool widget_speed(const Scene2d *scene, const ScreenOptions *options, bool as_json);

#endif
