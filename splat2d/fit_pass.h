// fit_pass.h - one pass of a fit over the whole picture: blobs to colours, and gradients of colours to gradients of blobs.
//
// The picture is cut into bands of rows, each worked on by one thread; a band keeps sums of its own for each blob that touches
// it, and they are added in the order of the bands. So nothing depends on the number of threads.
#ifndef SPLATLAB_SPLAT2D_FIT_PASS_H
#define SPLATLAB_SPLAT2D_FIT_PASS_H

#include "splat2d/planes3.h"

enum { FIT_PARAMETERS = 9 }; // a blob's: mean x y, log sigma x y, theta, opacity's logit, r g b

typedef struct FitPass FitPass;
FitPass *fit_pass_create(int width, int height);
void fit_pass_destroy(FitPass *pass); // accepts NULL

// Draws `count` blobs, the first in front, over the background. parameters: (FIT_PARAMETERS, count), each kind for all blobs
// in a row. The rule is that of kernels/shared.h.
void fit_pass_forward(FitPass *pass, int count, const double *parameters, const double background[3], Planes3 *picture);

// After fit_pass_forward() with the same arguments, once: from d_picture, d loss / d picture with a margin of zeros, to
// d_parameters, d loss / d parameters, of the same shape.
void fit_pass_backward(FitPass *pass, const double *parameters, const Planes3 *d_picture, double *d_parameters);

#endif
