// scene2d.h - a scene of 2-D Gaussians as data: the blobs, the canvas they lie on, and the edits that a person makes.
//
// A blob is known by its index; edits keep the order of the others. What is drawn in front is decided by depth alone,
// ties by index.
#ifndef SPLATLAB_SPLAT2D_SCENE2D_H
#define SPLATLAB_SPLAT2D_SCENE2D_H

#include "splat2d/covariance.h"

#include <stdbool.h>

// What a scene may hold.
enum { SCENE2D_BLOBS_MAX = 100000, SCENE2D_SIDE_MAX = 16384 /* px of the canvas */ };
static const double SCENE2D_MEAN_MAX = 1e6;  // px, either sign
static const double SCENE2D_SIGMA_MAX = 1e5; // px
static const double SCENE2D_THETA_MAX = 1e3; // rad, either sign
static const double SCENE2D_DEPTH_MAX = 1e6; // either sign

typedef struct {
    double mean[2];   // px of the canvas, x right, y down; the centre of pixel (i, j) is at (i + 0.5, j + 0.5)
    double sigma_x;   // px, >= 0: standard deviation along the blob's first axis
    double sigma_y;   // px, >= 0: along its second axis
    double theta_rad; // of the first axis, from +x towards +y: clockwise on the screen
    double rgb[3];    // 0..1
    double opacity;   // 0..1, at the mean
    double depth;     // smaller is in front
} Blob;

typedef struct {
    int width, height;    // px of the canvas
    double background[3]; // r g b, 0..1
    int count;
    int capacity;
    Blob *blobs; // (capacity), owned
} Scene2d;

Scene2d scene2d_create(int width, int height); // empty, on black
Scene2d scene2d_default(void);                 // the lesson's: six blobs that each have something to show
Scene2d scene2d_copy(const Scene2d *scene);
void scene2d_destroy(Scene2d *scene); // accepts a zeroed one

// Are all values in the ranges above? `where` ("scene.json") begins the message, which names blob and field.
bool scene2d_check(const Scene2d *scene, const char *where);

// Sigma of the blob.
Sym2 blob_covariance(const Blob *blob);

// Sigma^-1 straight from angle and scales, R diag(1/sx^2, 1/sy^2) R^T: it keeps the digits that the inverse of a
// computed Sigma loses at extreme aspects. False when a scale is zero: such a blob covers no area.
bool blob_conic(const Blob *blob, Sym2 *conic);

// ---- edits; an index must be that of a blob ----

// Appends; returns the new index, or -1 with a message when there are SCENE2D_BLOBS_MAX already.
int scene2d_add(Scene2d *scene, const Blob *blob);
int scene2d_duplicate(Scene2d *scene, int index); // the copy has the same depth, so it lies right behind
void scene2d_remove(Scene2d *scene, int index);   // the indices behind it move down by one

// order[0..count-1]: the indices from front to back, by depth, then by index.
void scene2d_order(const Scene2d *scene, int *order);
int scene2d_rank(const Scene2d *scene, int index); // place in that order, 0 is the front

// Brings the blob to that place (clamped to 0..count-1) by changing its depth; the others keep their order. Where there
// is no number between its new neighbours, all depths become 1, 2, 3, ... in order.
void scene2d_set_rank(Scene2d *scene, int index, int rank);

// The front blob that covers the point with its ellipse of k standard deviations; -1 when there is none.
int scene2d_pick(const Scene2d *scene, double x, double y, double k);

#endif
