// trainer.h - training: one step is one view rendered, compared with its photograph, and every splat moved a little.
//
// The caller owns the loop: the command line calls trainer_step() until it is done, a window calls it between two frames.
// Everything heavy stays on the device; the host only sorts, and holds the model when density control changes it.
#ifndef SPLATLAB_SPLAT3D_TRAINER_H
#define SPLATLAB_SPLAT3D_TRAINER_H

#include "splat3d/dataset.h"
#include "splat3d/density.h"
#include "splat3d/opencl_loss.h"
#include "splat3d/opencl_rasterizer.h"
#include "splat3d/train_options.h"
#include "splat3d/training_state.h"

typedef struct Trainer Trainer;

// dataset: images loaded; borrowed for the trainer's life. The training views' pixels are moved to the device: their `image` is empty afterwards.
// Starts from the scene's points (or random ones), nothing trained.
bool trainer_create(Gpu *gpu, BlendKernels blend, const TrainOptions *options, Dataset *dataset, Trainer **trainer);
void trainer_destroy(Trainer *trainer); // accepts NULL

typedef struct {
    int step;         // the one just done; 1 is the first
    const char *view; // that it saw
    int shrink;       // at 1/shrink of its size: 1, 2, 4, ... (schedule_coarse_level)
    LossValues loss;  // before the step
    double psnr;      // of that view, at that size, dB
    int splats;       // after the step
    FrameCounts frame;
    DensityChange density; // zero unless density control ran
    bool opacity_reset;
    double seconds; // that it took
} StepReport;

// One step. Fails on a device error; when a gradient or a parameter is no longer finite: the message names step, view, splat and
// field, and the model keeps that splat's last good numbers; and when density control would remove every splat, or make one that is not
// finite, which it then does not.
bool trainer_step(Trainer *trainer, StepReport *report);

int trainer_steps_done(const Trainer *trainer);
int trainer_splat_count(const Trainer *trainer);
double trainer_scene_extent(const Trainer *trainer); // world units

// Everything learned so far, to be written (training_state.h) or looked at; owned by the caller.
bool trainer_get_state(const Trainer *trainer, TrainingState *state);
// Of that the model alone; owned by the caller.
bool trainer_get_model(const Trainer *trainer, Gaussians *model);
// Goes on from that state (copied). Its SH degree must be that of the options, and the scene what it was.
bool trainer_set_state(Trainer *trainer, const TrainingState *state);

Rasterizer *trainer_rasterizer(Trainer *trainer); // of the trainer's device; for evaluation between two steps

// As the model would be shown now: full SH, the run's background (black where that is random).
RenderSettings trainer_render_settings(const Trainer *trainer);

#endif
