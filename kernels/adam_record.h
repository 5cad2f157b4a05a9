// adam_record.h - arguments of kernels/adam.cl and of the step in kernels/project_backward.cl, shared with splat3d/opencl_adam.c.
#ifndef SPLATLAB_KERNELS_ADAM_RECORD_H
#define SPLATLAB_KERNELS_ADAM_RECORD_H

#include "shared.h"

#define ADAM_LANES      SPLAT_GROUP // numbers that one work-item does: one of each splat of a group
#define ADAM_FIELD_BITS 3 // of the word that says which number was not finite: splat << ADAM_FIELD_BITS | field
#define ADAM_ALL_FINITE 0xffffffffu // that word when there is none

// A kernel argument by value. Every constant is computed in double precision and rounded once.
typedef struct {
    int splats;            // N
    int width;             // numbers of one splat
    int field;             // GaussianFieldId
    int only_in_view;      // of the frame: the others stay as they are, their moments too
    float beta1, beta2;    // 0.9, 0.999
    float one_minus_beta1; // of the exact betas, not of the rounded ones
    float one_minus_beta2;
    float rate;             // learning rate / (1 - beta1^step)
    float over_root_v_part; // 1 / sqrt(1 - beta2^step)
    float epsilon;          // 1e-15
} AdamRecord;

// The fields of a splat, as GaussianFieldId numbers them.
#define ADAM_MEAN          0
#define ADAM_LOG_SCALE     1
#define ADAM_QUAT          2
#define ADAM_OPACITY_LOGIT 3
#define ADAM_SH0           4
#define ADAM_SH1           5
#define ADAM_SH2           6
#define ADAM_SH3           7
#define ADAM_FIELDS        8

// One step of all fields (project_backward.cl).
typedef struct {
    AdamRecord rule; // what all fields have in common; splats, width, field and rate are filled in for each
    float rate[ADAM_FIELDS];
} AdamStepRecord;

#endif
