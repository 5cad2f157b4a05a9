// model_source.c - a path that a person gave, resolved to a model file and the options it was made with.
#include "lab/app/model_source.h"

#include "lab/app/run_folder.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"

bool model_source_is_run(const char *path) {
    RunFolder run = run_folder_name(path);
    bool is_run = file_is_folder(path) && file_exists(run.options);
    run_folder_forget(&run);
    return is_run;
}

static bool find_in_run(const char *folder, ModelSource *source) {
    RunFolder run = run_folder_name(folder);
    bool good = run_folder_load_options(&run, &source->options);
    if (good && !file_exists(run.model))
        good = fail("run %s has no model.ply yet; finish it with: splatlab train --resume %s", folder, folder);
    source->path = mem_text(run.model);
    source->is_run = true;
    run_folder_forget(&run);
    return good;
}

bool model_source_find(const char *path, ModelSource *source) {
    *source = (ModelSource){.options = train_options_default()};
    if (!file_exists(path))
        return fail("there is no %s; give a model (.ply) or the folder of a run (splatlab train SCENE -o RUN)", path);
    if (model_source_is_run(path)) return find_in_run(path, source);
    if (file_is_folder(path))
        return fail("%s is no run: it has no options.json; give a model (.ply) or the folder that "
                    "splatlab train -o has written",
                    path);
    source->path = mem_text(path);
    return true;
}

void model_source_forget(ModelSource *source) {
    mem_free(source->path);
    *source = (ModelSource){0};
}
