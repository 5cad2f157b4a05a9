// fit_loss.h - the loss of loss.h made for a fit: the same photograph a thousand times, in floats, on all cores.
//
// loss.h is the text to read; this one must agree with it. What depends on the photograph alone is computed once, the rest in
// passes over rows, each shared out over threads; sums go by rows, so any number of threads gives the same bits.
#ifndef SPLATLAB_SPLAT2D_FIT_LOSS_H
#define SPLATLAB_SPLAT2D_FIT_LOSS_H

#include "splat2d/loss.h"
#include "splat2d/planes3.h"

typedef struct FitLoss FitLoss;
FitLoss *fit_loss_create(const ImageF *photo, double lambda); // 3 channels
void fit_loss_destroy(FitLoss *loss);                         // accepts NULL

// Of the picture; d_picture receives d total / d picture, with a clear margin.
Loss fit_loss_evaluate(FitLoss *loss, const Planes3 *picture, Planes3 *d_picture);

#endif
