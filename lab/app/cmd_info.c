// cmd_info.c - `splatlab info`: what a scene, a model, a cloud of points or a run consists of.
#include "lab/app/commands.h"
#include "lab/app/facts.h"
#include "lab/app/model_source.h"
#include "lab/base/fail.h"
#include "lab/base/log.h"
#include "lab/io/file.h"
#include "lab/io/json_io.h"
#include "splat3d/ply.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

typedef struct {
    int downscale;
    bool memory;
    int splats;
    bool quiet, json;
} Options;

static const OptionField FIELDS[] = {
    {.name = "downscale",
     .type = OPTION_INT,
     .offset = offsetof(Options, downscale),
     .low = 1,
     .high = 64,
     .unit = "times",
     .help = "look at a scene as it is trained on with this option"},
    {.name = "memory",
     .type = OPTION_FLAG,
     .offset = offsetof(Options, memory),
     .help = "break the expected memory of training down"},
    {.name = "splats",
     .type = OPTION_INT,
     .offset = offsetof(Options, splats),
     .low = 1,
     .high = 20000000,
     .unit = "splats",
     .help = "expect so many; a model is taken as it is"},
    {.name = "quiet",
     .letter = 'q',
     .type = OPTION_FLAG,
     .offset = offsetof(Options, quiet),
     .help = "only warnings and errors on stderr"},
    {OPTION_JSON_OF(Options, "the facts")},
};

// Adds what training takes: the whole table with --memory, else only the sum.
static void add_memory(json_t *facts, const Options *o, int splats, int sh_degree, const Dataset *dataset) {
    json_t *memory = facts_of_memory(splats, sh_degree, dataset);
    if (o->memory) json_object_set(facts, "training_memory", memory);
    json_object_set(facts, "training_memory_bytes", json_object_get(memory, "total_bytes"));
    json_decref(memory);
}

static bool info_scene(const char *path, const Options *o, json_t **facts) {
    Dataset dataset = {0};
    bool good = dataset_open(path, o->downscale, &dataset);
    if (good) {
        *facts = facts_of_scene(&dataset);
        add_memory(*facts, o, o->splats, SH_DEGREE_MAX, &dataset);
    }
    dataset_destroy(&dataset);
    return good;
}

static size_t size_of_file(const char *path) {
    struct stat info;
    return stat(path, &info) == 0 ? (size_t)info.st_size : 0;
}

static bool info_splats(const char *path, const Options *o, json_t **facts) {
    Gaussians model;
    if (!ply_load(path, &model)) return false;
    *facts = facts_of_model(&model, size_of_file(path));
    add_memory(*facts, o, model.count, model.sh_degree, NULL);
    gaussians_destroy(&model);
    return true;
}

static bool info_points(const char *path, json_t **facts) {
    Points points;
    if (!ply_load_points(path, &points)) return false;
    *facts = facts_of_points(&points, size_of_file(path));
    points_destroy(&points);
    return true;
}

static bool info_ply(const char *path, const Options *o, json_t **facts) {
    bool is_splats;
    if (!ply_is_splats(path, &is_splats)) return false;
    return is_splats ? info_splats(path, o, facts) : info_points(path, facts);
}

static bool info_run(const char *path, const Options *o, json_t **facts) {
    ModelSource source;
    bool good = model_source_find(path, &source) && info_splats(source.path, o, facts);
    if (good) {
        json_t *options = json_from_options(&TRAIN_OPTIONS, &source.options);
        json_object_set_new(*facts, "kind", json_string("run"));
        json_object_set_new(*facts, "scene", json_text(source.options.scene));
        json_object_set_new(*facts, "options", options);
    }
    model_source_forget(&source);
    return good;
}

// A PLY file begins with "ply" and the end of a line.
static bool looks_like_ply(const char *path) {
    char start[4] = "";
    FILE *file = fopen(path, "rb");
    size_t length = file ? fread(start, 1, sizeof start, file) : 0;
    if (file) fclose(file);
    return length == sizeof start && memcmp(start, "ply", 3) == 0 && (start[3] == '\n' || start[3] == '\r');
}

static bool find_facts(const char *path, const Options *o, json_t **facts) {
    if (!file_exists(path)) return fail("there is no %s; give a scene's folder, a .ply file or a run's folder", path);
    if (model_source_is_run(path)) return info_run(path, o, facts);
    if (file_is_folder(path)) return info_scene(path, o, facts);
    if (looks_like_ply(path)) return info_ply(path, o, facts);
    return fail(
        "%s is no PLY file (it does not begin with \"ply\"); give a scene's folder, a .ply file or a run's folder",
        path);
}

static int cmd_info(int argc, char **argv) {
    const Options defaults = {.downscale = 1, .splats = train_options_default().max_splats};
    const OptionTable table = {FIELDS, sizeof FIELDS / sizeof FIELDS[0], &defaults};
    Options options = defaults;
    const char *path = NULL;
    int count, exit_code;
    if (!command_line_parse(&CMD_INFO, &table, argc, argv, &options, &path, 1, &count, &exit_code)) return exit_code;
    log_set_quiet(options.quiet);
    if (count == 0) {
        fail_usage("info: of what? splatlab info SCENE|MODEL.ply|RUN");
        return command_failed();
    }
    json_t *found = NULL;
    if (!find_facts(path, &options, &found)) return command_failed();
    json_t *facts = json_pack("{so}", "path", json_text(path));
    json_object_update(facts, found);
    json_decref(found);
    if (options.json)
        json_print(facts);
    else
        facts_print(facts);
    json_decref(facts);
    return 0;
}

const Command CMD_INFO = {
    .name = "info",
    .arguments = "SCENE|MODEL.ply|RUN",
    .summary = "say what a scene, a model, a cloud of points or a run consists of",
    .details = "  splatlab info photos --downscale 2 --memory --splats 200000\n"
               "  splatlab info model.ply\n"
               "  splatlab info run --json",
    .run = cmd_info,
};
