// fit2d.h - fitting a picture with N 2-D Gaussians by gradient descent: the trainer's loop without a camera.
//
// Draw the blobs, compare with the photograph (L1 + D-SSIM), go back to the gradient of every number, let Adam move it, and
// again. A blob is mean, two log-scales, angle, opacity's logit and colour: any numbers give a valid Gaussian. The order in
// depth is not learned; blobs that start small start in front.
//
// Deterministic: photo, options and step number decide every bit, whatever the number of threads.
#ifndef SPLATLAB_SPLAT2D_FIT2D_H
#define SPLATLAB_SPLAT2D_FIT2D_H

#include "lab/base/image.h"
#include "lab/base/options.h"
#include "splat2d/loss.h"
#include "splat2d/scene2d.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct {
    int gaussians;  // N, at the end
    int iterations; // for the schedule of learning rates and growth
    uint64_t seed;
    bool isotropic; // both scales equal, no angle: round blobs
    bool grow;      // from N / 8 on, the others are added where the error is largest, until half of the iterations
    double lambda;  // share of D-SSIM in the loss
    double rate;    // factor on all learning rates
} Fit2dOptions;

Fit2dOptions fit2d_options_default(void);
extern const OptionTable FIT2D_OPTIONS; // the fields above, for a command line or sliders

typedef struct Fit2d Fit2d;
Fit2d *fit2d_create(const ImageF *photo, const Fit2dOptions *options); // 3 channels, any size; copied
void fit2d_destroy(Fit2d *fit);                                        // accepts NULL

// One step; after options.iterations of them it goes on at the last learning rate. Returns the loss before it.
Loss fit2d_step(Fit2d *fit);

int fit2d_steps_done(const Fit2d *fit);
int fit2d_count(const Fit2d *fit); // blobs now

// The picture of the blobs as they are now, into a picture of the photograph's size.
void fit2d_picture(Fit2d *fit, ImageF *picture);

// The blobs as a scene, the first in front (depth 0, 1, 2, ...); owned by the caller.
Scene2d fit2d_scene(const Fit2d *fit);

#endif
