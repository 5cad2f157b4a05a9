// density.h - adaptive density control: where the model is too coarse it grows, where it adds nothing it shrinks.
//
// Kerbl et al. 2023, section 5.2. A splat whose position on the screen is pulled hard (a large mean gradient) covers something that
// it cannot show alone. If it is small, the place is under-reconstructed: it is cloned, and the optimiser moves the two apart. If it is
// large, it is over-reconstructed: two smaller children are drawn from it and take its place. Faint and huge splats are removed.
//
//      clone:   (o)  ->  (o)(o)           split:  (    o    )  ->  ( o )( o )           prune:  ( . )  ->
#ifndef SPLATLAB_SPLAT3D_DENSITY_H
#define SPLATLAB_SPLAT3D_DENSITY_H

#include "splat3d/train_options.h"
#include "splat3d/training_state.h"

enum { SPLIT_CHILDREN = 2 };
static const double SPLIT_SHRINK = 1.6; // children are smaller by this (0.8 x SPLIT_CHILDREN)

typedef struct {
    int cloned, split, pruned;
} DensityChange;

// One round after step `step`. The model comes out in Morton order (morton_order.h) of where its splats come from. Kept splats keep
// their ids and moments; a clone comes behind its original, with zero moments, as children have. The statistics start anew. When the
// model would exceed max_splats, those with the largest gradients grow. prune_large: also remove splats wider than prune_scale.
// scene_extent: world units.
DensityChange density_control(const TrainOptions *options, int step, double scene_extent, bool prune_large,
                              TrainingState *state);

// Cuts all opacities to options->reset_opacity and forgets their moments, so that what the views do not ask for can fade away.
void density_reset_opacity(const TrainOptions *options, TrainingState *state);

#endif
