// train_options.h - every number that decides what training does, with its published default; the run writes them to options.json.
//
// The defaults are those of Kerbl et al. 2023 and its reference implementation's documentation. Two of them are written as shares of the run, so that
// a short run gets the whole schedule: over 30,000 iterations they are the published ones.
#ifndef SPLATLAB_SPLAT3D_TRAIN_OPTIONS_H
#define SPLATLAB_SPLAT3D_TRAIN_OPTIONS_H

#include "lab/base/options.h"

#include <stdbool.h>
#include <stdint.h>

enum { COARSE_LEVELS_MAX = 4 };

typedef struct {
    char scene[OPTION_TEXT_BYTES]; // folder of the data set
    int iterations;                // steps, one view each
    uint64_t seed;                 // of everything random
    int downscale;                 // pictures are used at 1/downscale of their size
    int coarse_levels;   // training begins with pictures at 1/2^coarse_levels of their size; 0: full size at once
    double coarse_until; // share of the run until the last halving is undone
    int coarse_least;    // px; no side of a picture is halved below this
    char background[OPTION_TEXT_BYTES]; // "white", "black", "random" or "r,g,b" in [0, 1]
    int max_splats;                     // density control stops growing there
    int sh_degree;                      // 0..3, reached by one degree every sh_every iterations
    int sh_every;                       // iterations
    int init_points;                    // random points where the scene brings none
    double init_opacity;                // (0, 1)
    double dssim_weight;                // lambda of loss.h

    double lr_mean, lr_mean_end; // x scene extent; decays log-linearly over the run
    double lr_log_scale, lr_quat, lr_opacity, lr_sh0, lr_sh_rest;
    bool sparse_adam; // a step changes only the splats that it sees

    int densify_from;        // iterations: density control begins behind this
    double densify_until;    // share of the run
    int densify_every;       // iterations
    double densify_gradient; // mean |dL/d mean2d| in NDC units at which a splat is cloned or split
    double densify_scale;    // x scene extent: larger splats are split, smaller ones cloned
    double prune_opacity;    // splats below are removed
    double prune_scale;      // x scene extent: larger splats are removed, once an opacity reset has been
    int reset_every;         // iterations between opacity resets
    double reset_opacity;    // opacities are cut to this
} TrainOptions;

TrainOptions train_options_default(void);

extern const OptionTable TRAIN_OPTIONS; // in the struct's order; `scene` is not in it: it is no option but an argument

#endif
