// schedule.h - what is due at which step: learning rates, SH degree, density control, which view.
//
// Pure functions of the options and the step number, so that a resumed run does what an uninterrupted one would. Steps count from 1.
#ifndef SPLATLAB_SPLAT3D_SCHEDULE_H
#define SPLATLAB_SPLAT3D_SCHEDULE_H

#include "splat3d/gaussians.h"
#include "splat3d/train_options.h"

// Learning rate of each field at that step. scene_extent: world units.
void schedule_learning_rates(const TrainOptions *options, int step, double scene_extent, float rate[FIELD_COUNT]);

// In how many sizes training uses a picture of width x height px: as it is, halved, ... at most coarse_levels times.
int schedule_sizes(const TrainOptions *options, int width, int height);

// How many times the pictures of that step are halved: coarse_levels at first, 0 from coarse_until of the run on.
int schedule_coarse_level(const TrainOptions *options, int step);

int schedule_sh_degree(const TrainOptions *options, int step); // active degree

bool schedule_density_is_on(const TrainOptions *options, int step);  // its statistics are gathered
bool schedule_density_is_due(const TrainOptions *options, int step); // after this step: clone, split, prune
bool schedule_prunes_large(const TrainOptions *options, int step);   // density control removes huge splats as well

// After this step opacities are cut. white_background: one more reset at densify_from, because splats in front of white
// grow opaque white where there is nothing.
bool schedule_reset_is_due(const TrainOptions *options, int step, bool white_background);

// Which of `count` training views this step sees: every epoch of `count` steps is a fresh permutation.
// `order` (count) and *epoch (-1 before the first call) keep the current one.
int schedule_view(const TrainOptions *options, int step, int count, int *order, int *epoch);

#endif
