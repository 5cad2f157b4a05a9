// cmd_scene.c - `splatlab scene`: writes a posed sample scene, so that there is something to train on.
#include "lab/app/commands.h"
#include "lab/base/fail.h"
#include "lab/base/log.h"
#include "lab/base/nearest.h"
#include "lab/io/file.h"
#include "lab/io/json_io.h"
#include "splat3d/sample_scene.h"

#include <stdio.h>
#include <string.h>

typedef struct {
    char output[OPTION_TEXT_BYTES];
    SampleSceneOptions scene;
    bool quiet, json;
} Options;

static const OptionField FIELDS[] = {
    {.name = "output",
     .letter = 'o',
     .type = OPTION_TEXT,
     .offset = offsetof(Options, output),
     .help = "folder for the scene; made when it is not there"},
    {.name = "size",
     .type = OPTION_SIZE,
     .offset = offsetof(Options, scene.size),
     .low = 32,
     .high = 8192,
     .unit = "px",
     .help = "of the pictures"},
    {.name = "views",
     .type = OPTION_INT,
     .offset = offsetof(Options, scene.views),
     .low = 3,
     .high = 10000,
     .unit = "pictures",
     .help = "how many; every 8th is held out of training"},
    {.name = "seed",
     .type = OPTION_U64,
     .offset = offsetof(Options, scene.seed),
     .low = 0,
     .high = 1.8e19,
     .help = "of layout, camera path and noise; the same seed gives the same files"},
    {OPTION_QUIET_OF(Options)},
    {OPTION_JSON_OF(Options, "the result")},
};

// "studio, fence, courtyard"
static void list_names(char *buffer, size_t size) {
    int count;
    const SampleSceneInfo *scenes = sample_scene_list(&count);
    buffer[0] = 0;
    for (int i = 0; i < count; i++) {
        size_t length = strlen(buffer);
        snprintf(buffer + length, size - length, "%s%s", i ? ", " : "", scenes[i].name);
    }
}

static bool check_name(const char *name) {
    enum { SCENES_MAX = 32 };
    const char *names[SCENES_MAX];
    char known[512];
    int count, best;
    const SampleSceneInfo *scenes = sample_scene_list(&count);
    for (int i = 0; i < count && i < SCENES_MAX; i++) {
        names[i] = scenes[i].name;
        if (strcmp(names[i], name) == 0) return true;
    }
    list_names(known, sizeof known);
    if (nearest_find(name, names, count, &best, 1))
        return fail_usage("scene: there is no scene '%s'; did you mean %s? (%s)", name, names[best], known);
    return fail_usage("scene: there is no scene '%s'; want one of %s", name, known);
}

static bool write_scene(const char *name, const Options *o) {
    char known[512];
    list_names(known, sizeof known);
    if (!name) return fail_usage("scene: which one? splatlab scene NAME -o DIR, with NAME one of %s", known);
    if (!check_name(name)) return false;
    if (!o->output[0]) return fail_usage("scene: where to? splatlab scene %s -o DIR", name);
    if (!file_make_folder(o->output) || !file_can_write_in(o->output)) return false;
    if (!sample_scene_write(name, &o->scene, o->output)) return false;
    if (o->json) {
        json_t *root =
            json_pack("{ss ss* si si si sI}", "scene", name, "folder", o->output, "views", o->scene.views, "width",
                      o->scene.size[0], "height", o->scene.size[1], "seed", (json_int_t)o->scene.seed);
        json_print(root);
        json_decref(root);
    } else {
        printf("%s: %d views of %dx%d px; train on it with: splatlab train %s -o RUN\n", o->output, o->scene.views,
               o->scene.size[0], o->scene.size[1], o->output);
    }
    return true;
}

// The help's list of scenes is that of sample_scene.h.
static const char *details_text(char *buffer, size_t size) {
    int count;
    const SampleSceneInfo *scenes = sample_scene_list(&count);
    snprintf(buffer, size, "NAME is one of:\n");
    for (int i = 0; i < count; i++) {
        size_t length = strlen(buffer);
        snprintf(buffer + length, size - length, "  %-11s %s\n", scenes[i].name, scenes[i].shows);
    }
    size_t length = strlen(buffer);
    snprintf(buffer + length, size - length, "\n%s", CMD_SCENE.details);
    return buffer;
}

static int cmd_scene(int argc, char **argv) {
    const Options defaults = {.scene = sample_scene_options_default()};
    const OptionTable table = {FIELDS, sizeof FIELDS / sizeof FIELDS[0], &defaults};
    Options options = defaults;
    char details[2048];
    Command command = CMD_SCENE;
    command.details = details_text(details, sizeof details);
    const char *name = NULL;
    int count, exit_code;
    if (!command_line_parse(&command, &table, argc, argv, &options, &name, 1, &count, &exit_code)) return exit_code;
    log_set_quiet(options.quiet);
    return write_scene(name, &options) ? 0 : command_failed();
}

const Command CMD_SCENE = {
    .name = "scene",
    .arguments = "NAME -o DIR",
    .summary = "write a sample scene: images, cameras, points and depth",
    .details = "  splatlab scene studio -o studio --size 320x240 --views 24\n"
               "  splatlab train studio -o run",
    .run = cmd_scene,
};
