// exercise.h - what every exercise in C includes: the number type, the records, and the mark of what is not written yet.
//
// Your file is compiled twice, with REAL as float and as double. <tgmath.h> makes sqrt, exp, cos, ... follow the type of
// what they are given, so write `exp(x)` for both.
#ifndef SPLATLAB_EXERCISES_EXERCISE_H
#define SPLATLAB_EXERCISES_EXERCISE_H

#include <stddef.h>
#include <tgmath.h>

#ifndef REAL
#define REAL double
#endif

#ifndef M_PI
#define M_PI 3.14159265358979323846
#endif

// Stands in a function that is not written yet: the run ends there and shows the place. Delete the line when you begin.
#define NOT_STARTED exercise_not_started(__FILE__, __LINE__)
void exercise_not_started(const char *file, int line);

// One splat as a pixel sees it: alpha' = opacity times the Gaussian there, in [0, 1], and its colour.
typedef struct {
    REAL alpha;
    REAL rgb[3];
} Hit;

// A pinhole camera with OpenCV axes: x right, y down, z forward. p_cam = R p + t; a pixel is f x/z + c.
typedef struct {
    REAL width, height; // px
    REAL fx, fy;        // focal lengths, px, > 0
    REAL cx, cy;        // principal point, px
    REAL R[9];          // world to camera, row-major
    REAL t[3];
} Cam;

// A picture of one number a pixel; pixel (i, j) has its centre at (i + 0.5, j + 0.5).
typedef struct {
    int width, height;
    const REAL *values; // (height, width), top row first
} Img;

#endif
