// psd_trap.h - why nobody optimises the raw entries of Sigma: the same descent, in two coordinates, towards the same blob.
//
// A blob is fitted to a picture of a thin one. Either its three numbers are xx, xy, yy of Sigma: then nothing keeps a step
// from leaving the cone of valid matrices,
//     xx yy - xy^2 > 0, xx > 0   <=>   with a = (xx + yy) / 2 and b = (xx - yy) / 2:   a > sqrt(b^2 + xy^2),
// a round cone round the a axis, whose wall are the matrices without area. Behind the wall an eigenvalue is negative, the
// "Gaussian" grows without bound along its axis, and the gradient points nowhere useful. Or its numbers are theta,
// ln sigma_x, ln sigma_y: then every point of R^3 is a valid Sigma, and there is no wall (Kerbl et al. 2023, section 4).
//
// Lengths are in units of the picture's half side / 3, so that one learning rate suits all the numbers.
#ifndef SPLATLAB_SPLAT2D_PSD_TRAP_H
#define SPLATLAB_SPLAT2D_PSD_TRAP_H

#include "splat2d/covariance.h"
#include "splat2d/raster2d.h"

typedef enum { PSD_RAW, PSD_FACTORED, PSD_WAY_COUNT } PsdWay;

static const double PSD_HALF_SIDE = 3;       // units: the picture is [-3, 3] x [-3, 3]
enum { PSD_GRID = 48, PSD_PATH_MAX = 2000 }; // pixels a side; steps that a walk remembers

// One descent.
typedef struct {
    PsdWay way;
    double values[3]; // xx, xy, yy (units^2), or theta (rad), ln sigma_x, ln sigma_y
    double m[3], v[3];
    int step;                      // done so far, at most PSD_PATH_MAX
    Sym2 path[PSD_PATH_MAX + 1];   // Sigma after each step, from step 0
    double loss[PSD_PATH_MAX + 1]; // of each
} PsdWalk;

typedef struct {
    Sym2 target;          // Sigma of the blob in the photograph
    double learning_rate; // of Adam, for both ways
    double opacity;
    PsdWalk walks[PSD_WAY_COUNT];
} PsdTrap;

// Both walks at a round blob; the target is thin. Large (80 KB): not for the stack of a thread.
void psd_trap_begin(PsdTrap *trap);
void psd_trap_restart(PsdTrap *trap); // both walks back to the start, same target and rate

// One step of Adam on both. A walk whose gradient is no longer finite stays where it is.
void psd_trap_step(PsdTrap *trap);

// Moves a walk by hand to three numbers of its own kind; the optimiser goes on from there as from a new start.
void psd_trap_set(PsdTrap *trap, PsdWay way, const double values[3]);

Sym2 psd_walk_covariance(const PsdWalk *walk);
double psd_trap_loss(const PsdTrap *trap, const PsdWalk *walk); // mean squared difference of the pictures

// The loss, and its gradient by the walk's three numbers.
double psd_trap_gradient(const PsdTrap *trap, const PsdWalk *walk, double gradient[3]);

// What g becomes at the offset (dx, dy) from the mean with that Sigma, valid or not; 0 where Sigma has no inverse.
double psd_trap_alpha(double opacity, Sym2 covariance, double dx, double dy);

// The point (b, xy, a) of the cone above, and how far inside it is: the smaller eigenvalue, negative outside.
void psd_cone_point(Sym2 covariance, double point[3]);
Sym2 psd_cone_covariance(const double point[3]);

#endif
