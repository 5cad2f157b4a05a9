// evaluate.h - how well a model shows views that it was not trained on: PSNR and SSIM, with the protocol beside the figures.
#ifndef SPLATLAB_SPLAT3D_EVALUATE_H
#define SPLATLAB_SPLAT3D_EVALUATE_H

#include "splat3d/dataset.h"
#include "splat3d/rasterizer.h"

typedef struct {
    const char *name;  // borrowed from the dataset
    double psnr, ssim; // picture clipped to [0, 1], not rounded
    double psnr8;      // picture rounded to 8 bit first, as from a PNG
} ViewScore;

typedef struct {
    ViewScore *views; // owned
    int count;
    double psnr, ssim, psnr8; // means over the views
} Evaluation;

// Renders every held-out view (all views when none is held out) and compares. A photograph that is not in memory is
// read for as long as it is needed, so a dataset without images will do. Photographs with alpha are laid over
// settings->background. show_progress: draw the line.
bool evaluate_model(Rasterizer *rasterizer, const Gaussians *model, const Dataset *dataset,
                    const RenderSettings *settings, bool show_progress, Evaluation *evaluation);
// How many views it reads and compares at the same time, one a thread; and the memory for one pixel of one of them.
int evaluate_views_at_once(const Dataset *dataset);
enum { EVALUATE_BYTES_PER_PIXEL = 8 * 8 + 3 * 3 * 4 + 4 }; // SSIM's planes; photograph, render, rounded; bytes
void evaluation_destroy(Evaluation *evaluation);

extern const char *const EVALUATION_PROTOCOL; // one sentence

// Rows of (photo, render, error x 4) for up to max_rows held-out views spread over the set, as one picture. *sheet is
// owned by the caller.
bool evaluate_contact_sheet(Rasterizer *rasterizer, const Gaussians *model, const Dataset *dataset,
                            const RenderSettings *settings, int max_rows, ImageF *sheet);

#endif
