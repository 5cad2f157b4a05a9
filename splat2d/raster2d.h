// raster2d.h - the picture of a 2-D scene, in plain C: every pixel walks the blobs from front to back.
//
// Per pixel and blob: m^2 = d^T Sigma^-1 d, g = exp(-m^2 / 2), alpha' = opacity g, then compositing.h. pixel_walk.h says the
// same for one pixel in plain doubles; read that first. This is the version for a window: a row visits a blob only on the
// span where alpha' >= alpha_min, four pixels at a time, and threads share the rows. No pixel depends on another: the
// picture is the same with any number of threads.
//
//     Raster2d raster = {0};
//     raster2d_load(&raster, &scene, view2d_whole());      after each edit
//     raster2d_draw(&raster, &settings, &picture, NULL);   neither allocates once the largest scene was seen
//     raster2d_destroy(&raster);
#ifndef SPLATLAB_SPLAT2D_RASTER2D_H
#define SPLATLAB_SPLAT2D_RASTER2D_H

#include "lab/base/image.h"
#include "splat2d/compositing.h"
#include "splat2d/scene2d.h"

// Which part of the canvas a picture shows: its left top corner, and how many picture pixels a canvas pixel gets.
typedef struct {
    double left, top; // px of the canvas
    double zoom;      // > 0
} View2d;

View2d view2d_whole(void); // one to one, from the canvas's corner

// The largest view that shows the whole canvas in a picture of that size, centred.
View2d view2d_fit(const Scene2d *scene, int width, int height);

// What three numbers xx, xy, yy are as a covariance. Only the first is the Sigma of a Gaussian.
typedef enum {
    SHAPE_VALID,      // both eigenvalues > 0: g falls off in all directions
    SHAPE_FLAT,       // determinant 0, or not finite: there is no inverse, nothing is drawn
    SHAPE_INDEFINITE, // one eigenvalue < 0: along its axis g grows without bound
    SHAPE_NEGATIVE,   // both < 0: g grows in all directions
} Shape;

Shape shape_of(Sym2 covariance);

// A blob as the picture sees it. With d the offset from the mean,
//     m^2 = sign_u (axis_u . d)^2 + sign_v (axis_v . d)^2,
// the squares along the two axes of Sigma, in units of sigma: both signs are 1 where Sigma is valid.
typedef struct {
    int index;      // in the scene
    double mean[2]; // px of the picture
    Shape shape;
    double axis_u[2], axis_v[2]; // 1 / px
    double sign_u, sign_v;       // 1 or -1
    double rgb[3];
    double opacity;
    double depth;
    double reach2; // it is visited where m^2 <= reach2; set by raster2d_draw()
} RasterBlob;

typedef struct {
    double background[3];
    double zoom;       // of the view
    int count;         // blobs
    RasterBlob *blobs; // (capacity), front to back; owned
    int *order;        // (capacity), owned
    int capacity;
    double *row_sums; // (row_capacity) of 1 - T_end, owned
    int row_capacity;
} Raster2d;

void raster2d_load(Raster2d *raster, const Scene2d *scene, View2d view);
void raster2d_destroy(Raster2d *raster); // accepts a zeroed one

// Puts three raw entries of Sigma (canvas px^2), valid or not, in place of one blob's angle and scales: what an optimiser
// that moves these three does to the picture. Lasts until the next raster2d_load(). Returns what they are.
Shape raster2d_set_covariance(Raster2d *raster, int index, Sym2 covariance);

typedef struct {
    CompositeRule rule;
    // Starts each sum with the background instead of ending it with T_end background. The weights then sum to more than
    // 1, and a bright background shines through what is opaque.
    bool background_unattenuated;
    // alpha' = opacity inside the ellipse of one standard deviation and 0 outside: shows where the blobs lie.
    bool discs;
} RasterSettings;

RasterSettings raster_settings_default(void); // the rule of kernels/shared.h
RasterSettings raster_settings_lesson(void);  // the lesson's script: ends at T < 0.003, no skip, unattenuated

// Maps that raster2d_draw() can fill besides, each (height, width) or NULL.
typedef struct {
    float *transmittance; // T_end
    int *visits;          // blobs whose reach it lies in, until it is opaque
} RasterMaps;

// Fills picture (3 channels, any size); values may leave [0, 1] where a shape is invalid or the background unattenuated.
// maps may be NULL. Returns the mean accumulated opacity, that of 1 - T_end over all pixels.
double raster2d_draw(Raster2d *raster, const RasterSettings *settings, ImageF *picture, const RasterMaps *maps);

// m^2 at (x, y) px of the picture; negative where an invalid Sigma makes it so.
double raster_blob_mahalanobis2(const RasterBlob *blob, double x, double y);

#endif
