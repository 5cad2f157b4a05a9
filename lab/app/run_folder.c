#include "lab/app/run_folder.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "lab/io/json_io.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

RunFolder run_folder_name(const char *folder) {
    return (RunFolder){.folder = mem_text(folder),
                       .options = file_join(folder, "options.json"),
                       .metrics = file_join(folder, "metrics.jsonl"),
                       .checkpoint = file_join(folder, "checkpoint.bin"),
                       .model = file_join(folder, "model.ply")};
}

void run_folder_forget(RunFolder *run) {
    mem_free(run->folder);
    mem_free(run->options);
    mem_free(run->metrics);
    mem_free(run->checkpoint);
    mem_free(run->model);
    *run = (RunFolder){0};
}

bool run_folder_take_scene(const char *scene, TrainOptions *options) {
    char *full = realpath(scene, NULL);
    if (!full) return fail("there is no %s; a scene is a folder with images and cameras", scene);
    size_t length = strlen(full);
    json_t *text = json_string(full);
    bool fits = length < sizeof options->scene, taken = fits && text;
    if (taken)
        memcpy(options->scene, full, length + 1);
    else if (!fits)
        fail("the path %s has %zu bytes, want less than %zu; move the scene, or give it a shorter name", full, length,
             sizeof options->scene);
    else
        fail("the path %s is no UTF-8, so that options.json cannot hold it; rename the folder", full);
    json_decref(text);
    free(full);
    return taken;
}

enum { FILES = 4 };

// Those of a run's files that are there; returns how many.
static int list_old(const RunFolder *run, const char *old[FILES]) {
    const char *const all[FILES] = {run->options, run->metrics, run->checkpoint, run->model};
    int count = 0;
    for (int i = 0; i < FILES; i++)
        if (file_exists(all[i])) old[count++] = all[i];
    return count;
}

bool run_folder_check(const RunFolder *run, bool overwrite) {
    const char *old[FILES];
    if (!file_make_folder(run->folder) || !file_can_write_in(run->folder)) return false;
    if (overwrite || list_old(run, old) == 0) return true;
    return fail("%s holds a run already (%s); go on with it by --resume %s, choose another folder, or say --overwrite",
                run->folder, strrchr(old[0], '/') + 1, run->folder);
}

bool run_folder_begin(const RunFolder *run, const TrainOptions *options) {
    const char *old[FILES];
    int count = list_old(run, old);
    for (int i = 0; i < count; i++)
        if (unlink(old[i]) != 0) return fail("cannot remove %s: %s; check its permissions", old[i], strerror(errno));
    json_t *root = json_from_options(&TRAIN_OPTIONS, options);
    json_object_set_new(root, "scene", json_text(options->scene));
    bool done = json_write(run->options, root);
    json_decref(root);
    return done;
}

bool run_folder_load_options(const RunFolder *run, TrainOptions *options) {
    json_t *root;
    const char *scene;
    if (!file_exists(run->options))
        return fail("%s holds no run: there is no options.json; begin one with: splatlab train SCENE -o %s",
                    run->folder, run->folder);
    if (!json_read(run->options, &root)) return false;
    *options = train_options_default();
    options->coarse_levels = 0; // a file that does not say is of a run from before pictures could be halved
    bool done = json_get_text(root, "scene", run->options, &scene);
    if (done) {
        snprintf(options->scene, sizeof options->scene, "%s", scene);
        json_object_del(root, "scene");
        done = json_to_options(root, &TRAIN_OPTIONS, run->options, options);
    }
    json_decref(root);
    return done;
}
