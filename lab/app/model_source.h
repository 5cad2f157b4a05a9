// model_source.h - which model a command works on: a .ply file, or a run folder with its model.ply and its options.
#ifndef SPLATLAB_LAB_APP_MODEL_SOURCE_H
#define SPLATLAB_LAB_APP_MODEL_SOURCE_H

#include "splat3d/train_options.h"

#include <stdbool.h>

typedef struct {
    char *path;           // of the .ply
    bool is_run;          // a run folder: `options` are those it was trained with
    TrainOptions options; // else the defaults
} ModelSource;

// Is it a run folder, that is, one with an options.json?
bool model_source_is_run(const char *path);

// path: a .ply file or a run folder. Reads no splats. Fails when there is no model, saying what there is instead.
bool model_source_find(const char *path, ModelSource *source);
void model_source_forget(ModelSource *source); // accepts a zeroed one

#endif
