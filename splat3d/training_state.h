// training_state.h - everything that training has learned so far, as one object that can be written and read back.
//
// With the options and the data set this is all there is: every random number and every choice of the schedule is a function of (seed, step, index),
// so training that goes on from a state read back makes the same bytes as training that never stopped.
#ifndef SPLATLAB_SPLAT3D_TRAINING_STATE_H
#define SPLATLAB_SPLAT3D_TRAINING_STATE_H

#include "splat3d/gaussians.h"

#include <stdint.h>

typedef struct {
    int steps_done;
    uint64_t scene;  // dataset_fingerprint() of what it was trained on
    double seconds;  // spent on them, all runs together
    Gaussians model; // N splats
    Gaussians m, v;  // Adam's first and second moments, the same shape
    uint32_t *id;    // (N) a splat's name for life; a clone or a child gets a new one
    uint32_t next_id;
    float *gradient_sum; // (N) density statistics since the last density control: sum of |dL/d mean2d|, NDC units
    int *seen;           // (N) and the number of views that saw the splat
} TrainingState;

// Takes the model over; moments and statistics are zero, ids 0..N-1.
TrainingState training_state_from_model(Gaussians model);
void training_state_destroy(TrainingState *state); // accepts a zeroed one

// A checkpoint file: header, arrays, CRC-32 of all before it. Written atomically; a damaged one is refused.
bool training_state_save(const TrainingState *state, const char *path);
bool training_state_load(const char *path, TrainingState *state);

#endif
