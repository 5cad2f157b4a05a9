// orbit.h - a camera that circles round what the photographs of a scene look at.
#ifndef SPLATLAB_LAB_APP_ORBIT_H
#define SPLATLAB_LAB_APP_ORBIT_H

#include "splat3d/dataset.h"

typedef struct {
    Vec3 focus;           // the world point in the middle of the picture
    Vec3 up;              // unit; mean of the cameras' up
    Vec3 along, across;   // unit, perpendicular to up and to each other: the plane of the circle
    double radius;        // of the circle, world units
    double height;        // of the circle above the focus, along up
    double fov_x_rad;     // full horizontal angle, as the first camera has it
    int width, height_px; // of the pictures
} Orbit;

// From the scene's cameras: the focus is the point nearest to all their optical axes, radius and height are their means.
Orbit orbit_of_scene(const Dataset *dataset);

// Frame 0..frames-1 of one full turn.
Camera orbit_camera(const Orbit *orbit, int frame, int frames);

#endif
