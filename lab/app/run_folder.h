// run_folder.h - where a training run lives: its options, its metrics, its checkpoint and its model.
#ifndef SPLATLAB_LAB_APP_RUN_FOLDER_H
#define SPLATLAB_LAB_APP_RUN_FOLDER_H

#include "splat3d/train_options.h"

#include <stdbool.h>

typedef struct {
    char *folder;
    char *options;    // options.json: what the run was told
    char *metrics;    // metrics.jsonl: one JSON object a line
    char *checkpoint; // checkpoint.bin: training_state.h
    char *model;      // model.ply
} RunFolder;

RunFolder run_folder_name(const char *folder);
void run_folder_forget(RunFolder *run); // frees the names, touches no file; accepts a zeroed one

// The scene's absolute path, so that the run can be resumed from anywhere. Fails where options.json could not hold it.
bool run_folder_take_scene(const char *scene, TrainOptions *options);

// Can a new run begin there? Makes the folder; refuses one in which nothing can be written, and one that holds a run already,
// unless `overwrite`. Removes nothing: what is still to be checked may fail.
bool run_folder_check(const RunFolder *run, bool overwrite);

// Begins a new run: removes the files of an old one and writes options.json.
bool run_folder_begin(const RunFolder *run, const TrainOptions *options);

bool run_folder_load_options(const RunFolder *run, TrainOptions *options);

#endif
