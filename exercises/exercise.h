// exercise.h - what every exercise in C includes: the number type, the records, and the mark of what is not written yet.
//
// Your file is compiled twice, with REAL as float and as double. <tgmath.h> makes sqrt, exp, cos, ... follow the type of
// what they are given, so write `exp(x)` for both.
#ifndef SPLATLAB_EXERCISES_EXERCISE_H
#define SPLATLAB_EXERCISES_EXERCISE_H

#include <stddef.h>
#include <stdint.h>
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

// The i-th draw of a seed: three independent normal numbers, mean 0 and standard deviation 1. The same for everybody, in
// float and in double, and no draw knows of another: draw i can be asked for at any time.
static inline void draw_normals(unsigned long seed, unsigned long i, REAL z[3]) {
    double u[4]; // in (0, 1)
    for (uint64_t k = 0; k < 4; k++) {
        // A counter, scrambled (SplitMix64: Steele, Lea and Flood 2014, "Fast splittable pseudorandom number generators").
        uint64_t x = ((uint64_t)seed << 32) + 4 * (uint64_t)i + k + 1;
        x *= UINT64_C(0x9e3779b97f4a7c15);
        x = (x ^ (x >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
        x = (x ^ (x >> 27)) * UINT64_C(0x94d049bb133111eb);
        u[k] = ((double)((x ^ (x >> 31)) >> 12) + 0.5) / 4503599627370496.0; // 2^52
    }
    double near = sqrt(-2 * log(u[0])), far = sqrt(-2 * log(u[2])); // Box and Muller 1958
    z[0] = (REAL)(near * cos(2 * M_PI * u[1]));
    z[1] = (REAL)(near * sin(2 * M_PI * u[1]));
    z[2] = (REAL)(far * cos(2 * M_PI * u[3]));
}

#endif
