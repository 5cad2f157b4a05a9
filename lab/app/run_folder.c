#include "lab/app/run_folder.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "lab/io/json_io.h"

#include <errno.h>
#include <stdio.h>
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

bool run_folder_begin(const RunFolder *run, bool overwrite) {
    if (!file_make_folder(run->folder) || !file_can_write_in(run->folder)) return false;
    const char *const old[] = {run->options, run->metrics, run->checkpoint, run->model};
    for (int i = 0; i < 4; i++) {
        if (!file_exists(old[i])) continue;
        if (!overwrite)
            return fail(
                "%s holds a run already (%s); go on with it by --resume %s, choose another folder, or say --overwrite",
                run->folder, strrchr(old[i], '/') + 1, run->folder);
        if (unlink(old[i]) != 0) return fail("cannot remove %s: %s", old[i], strerror(errno));
    }
    return true;
}

bool run_folder_save_options(const RunFolder *run, const TrainOptions *options) {
    json_t *root = json_from_options(&TRAIN_OPTIONS, options);
    json_object_set_new(root, "scene", json_string(options->scene));
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
    bool done = json_get_text(root, "scene", run->options, &scene);
    if (done) {
        snprintf(options->scene, sizeof options->scene, "%s", scene);
        json_object_del(root, "scene");
        done = json_to_options(root, &TRAIN_OPTIONS, run->options, options);
    }
    json_decref(root);
    return done;
}
