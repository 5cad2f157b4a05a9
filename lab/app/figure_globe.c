// figure_globe.c - a ray (x, y, *) meets the ellipsoid where |A^-1 p| = 1.
#include "lab/app/figure_globe.h"

#include <math.h>

enum { SAMPLES = 3 }; // a side, in each pixel

// The columns of A^-1 are the gradients of u by x, y and z.
static Mat3 inverse(const Mat3 *a) {
    const double *m = a->m;
    Vec3 r0 = vec3(m[0], m[1], m[2]), r1 = vec3(m[3], m[4], m[5]), r2 = vec3(m[6], m[7], m[8]);
    Vec3 c0 = vec3_cross(r1, r2), c1 = vec3_cross(r2, r0), c2 = vec3_cross(r0, r1);
    double d = vec3_dot(r0, c0);
    return (Mat3){{c0.x / d, c1.x / d, c2.x / d, c0.y / d, c1.y / d, c2.y / d, c0.z / d, c1.z / d, c2.z / d}};
}

// u = near + t along on the unit ball, the smaller t. False when the ray passes by.
static bool hit(const Mat3 *to_unit, double x, double y, Vec3 *unit) {
    Vec3 from = mat3_apply(to_unit, vec3(x, y, 0)), along = mat3_apply(to_unit, vec3(0, 0, 1));
    double a = vec3_dot(along, along), b = vec3_dot(from, along), c = vec3_dot(from, from) - 1;
    double inside = b * b - a * c;
    if (inside < 0) return false;
    *unit = vec3_add(from, vec3_scale(along, (-b - sqrt(inside)) / a));
    return true;
}

static bool shade(const Mat3 *to_unit, double x, double y, double ambient, GlobePaint paint, const void *context,
                  double rgb[3]) {
    static const Vec3 LIGHT = {-0.45, -0.65, -0.61};
    Vec3 unit;
    if (!hit(to_unit, x, y, &unit)) return false;
    Mat3 transposed = mat3_transpose(to_unit);
    Vec3 normal = vec3_normalize(mat3_apply(&transposed, unit));
    double light = ambient + (1 - ambient) * fmax(0, vec3_dot(normal, LIGHT));
    paint(unit, context, rgb);
    for (int c = 0; c < 3; c++) rgb[c] *= light;
    return true;
}

void figure_globe(ImageF *image, int x, int y, int side, const Mat3 *from_unit, double scale, double ambient,
                  GlobePaint paint, const void *context) {
    Mat3 to_unit = inverse(from_unit);
    for (int i = 0; i < side * side; i++) {
        float *pixel = image->values + 3 * ((y + i / side) * image->width + x + i % side);
        for (int k = 0; k < SAMPLES * SAMPLES; k++) {
            double px = i % side + (k % SAMPLES + 0.5) / SAMPLES, py = i / side + (k / SAMPLES + 0.5) / SAMPLES, rgb[3];
            if (!shade(&to_unit, (px - side / 2.0) / scale, (py - side / 2.0) / scale, ambient, paint, context, rgb))
                continue;
            for (int c = 0; c < 3; c++) pixel[c] += (float)((rgb[c] - (double)pixel[c]) / (SAMPLES * SAMPLES - k));
        }
    }
}

void globe_paint_axes(Vec3 unit, const void *context, double rgb[3]) {
    static const double COLOURS[3][3] = {{0.95, 0.72, 0.29}, {0.37, 0.84, 0.63}, {0.48, 0.64, 0.97}};
    const double u[3] = {unit.x, unit.y, unit.z};
    (void)context;
    for (int c = 0; c < 3; c++) rgb[c] = 0.62 + 0.05 * (c == 2);
    for (int axis = 0; axis < 3; axis++) {
        bool cap = fabs(u[axis]) > 0.93, belt = fabs(u[axis]) < 0.03;
        for (int c = 0; c < 3 && (cap || belt); c++) rgb[c] = COLOURS[axis][c];
    }
}
